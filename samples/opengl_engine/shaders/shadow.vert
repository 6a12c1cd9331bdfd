#version 430
// SPDX-License-Identifier: MIT
#include "frame.glsl"

layout(location = 0) in vec3 position; // world space [m]
layout(location = 2) in vec2 textureCoordinate;
out vec2 coordinate;

void main() {
    coordinate = textureCoordinate;
    gl_Position = frame.shadowMatrix * vec4(position, 1.0);
}
