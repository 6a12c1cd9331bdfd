#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
#include "material.glsl"

layout(location = 0) in vec2 coordinate;
layout(location = 1) in vec4 color;

void main() {
    baseColorAt(coordinate, color); // discards where there is a hole
}
