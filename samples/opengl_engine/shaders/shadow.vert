#version 430
// SPDX-License-Identifier: MIT
#include "frame.glsl"

layout(location = 0) in vec3 position; // world space [m]
layout(location = 2) in vec4 textureCoordinates; // .xy of the base colour
layout(location = 3) in vec4 vertexColor;
layout(location = 2) uniform vec4 offset; // .xyz of a mesh that moves [m]
out vec2 coordinate;
out vec4 color;

void main() {
    coordinate = textureCoordinates.xy;
    color = vertexColor;
    gl_Position = frame.shadowMatrix * vec4(position + offset.xyz, 1.0);
}
