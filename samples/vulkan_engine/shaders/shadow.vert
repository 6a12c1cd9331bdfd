#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
#include "frame.glsl"

layout(location = 0) in vec3 position; // world space [m]
layout(location = 2) in vec4 textureCoordinates; // .xy of the base colour
layout(location = 3) in vec4 vertexColor;
layout(location = 0) out vec2 coordinate;
layout(location = 1) out vec4 color;

void main() {
    coordinate = textureCoordinates.xy;
    color = vertexColor;
    gl_Position = frame.shadowMatrix * vec4(position, 1.0);
}
