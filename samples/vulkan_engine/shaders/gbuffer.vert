#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
#include "frame.glsl"

layout(location = 0) in vec3 position; // world space [m]
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 textureCoordinates; // .xy of the base colour, .zw of the emission
layout(location = 3) in vec4 vertexColor;
layout(push_constant) uniform Object {
    layout(offset = 32) vec4 offset; // .xyz of a mesh that moves [m]; ObjectConstants in engine/scene_data.hpp is its twin
    vec4 previousOffset;             // in the frame before
} object;
layout(location = 0) out vec3 worldPosition;
layout(location = 1) out vec3 worldNormal;
layout(location = 2) out vec4 coordinates;
layout(location = 3) out vec4 color;
layout(location = 4) out vec4 clip;
layout(location = 5) out vec4 previousClip;

void main() {
    worldPosition = position + object.offset.xyz;
    worldNormal = normal;
    coordinates = textureCoordinates;
    color = vertexColor;
    clip = frame.viewProjection * vec4(worldPosition, 1.0);
    previousClip = frame.previousViewProjection * vec4(position + object.previousOffset.xyz, 1.0);
    gl_Position = clip;
}
