#version 430
// SPDX-License-Identifier: MIT
#include "frame.glsl"

layout(location = 0) in vec3 position; // world space [m]
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 textureCoordinate;
out vec3 worldPosition;
out vec3 worldNormal;
out vec2 coordinate;

void main() {
    worldPosition = position;
    worldNormal = normal;
    coordinate = textureCoordinate;
    gl_Position = frame.viewProjection * vec4(position, 1.0);
}
