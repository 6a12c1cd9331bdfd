#version 430
// SPDX-License-Identifier: MIT
#include "material.glsl"

in vec2 coordinate;

void main() {
    baseColorAt(coordinate); // discards where there is a hole
}
