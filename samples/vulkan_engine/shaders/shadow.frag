#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
#include "material.glsl"

layout(location = 0) in vec2 coordinate;

void main() {
    baseColorAt(coordinate); // discards where there is a hole
}
