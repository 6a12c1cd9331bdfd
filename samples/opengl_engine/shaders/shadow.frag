#version 430
// SPDX-License-Identifier: MIT
#include "material.glsl"

in vec2 coordinate;
in vec4 color;

void main() {
    baseColorAt(coordinate, color); // discards where there is a hole
}
