#version 430
// SPDX-License-Identifier: MIT
#include "frame.glsl"

layout(location = 0) in vec3 position; // world space [m]
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 textureCoordinates; // .xy of the base colour, .zw of the emission
layout(location = 3) in vec4 vertexColor;
layout(location = 2) uniform vec4 offset; // .xyz of a mesh that moves [m]
out vec3 worldPosition;
out vec3 worldNormal;
out vec4 coordinates;
out vec4 color;

void main() {
    worldPosition = position + offset.xyz;
    worldNormal = normal;
    coordinates = textureCoordinates;
    color = vertexColor;
    gl_Position = frame.viewProjection * vec4(worldPosition, 1.0);
}
