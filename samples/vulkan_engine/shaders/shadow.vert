#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
#include "frame.glsl"

layout(location = 0) in vec3 position; // world space [m]
layout(location = 2) in vec4 textureCoordinates; // .xy of the base colour
layout(location = 3) in vec4 vertexColor;
layout(push_constant) uniform Object {
    layout(offset = 32) vec4 offset; // .xyz of a mesh that moves [m]; ObjectConstants in engine/scene_data.hpp is its twin
    vec4 previousOffset;             // in the frame before
} object;
layout(location = 0) out vec2 coordinate;
layout(location = 1) out vec4 color;

void main() {
    coordinate = textureCoordinates.xy;
    color = vertexColor;
    gl_Position = frame.shadowMatrix * vec4(position + object.offset.xyz, 1.0);
}
