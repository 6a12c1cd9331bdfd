#version 430
// SPDX-License-Identifier: MIT
#include "frame.glsl"
#include "material.glsl"

in vec3 worldPosition;
in vec3 worldNormal;
in vec4 coordinates; // .xy of the base colour, .zw of the emission
in vec4 color;
layout(location = 0) out vec4 outNormal;   // world space, unit, towards the camera
layout(location = 1) out vec4 outAlbedo;
layout(location = 2) out vec4 outEmission; // [W m^-2 sr^-1]

void main() {
    vec3 towardsEye = frame.eye.xyz - worldPosition * frame.eye.w;
    vec3 normal = normalize(worldNormal);
    outAlbedo = vec4(baseColorAt(coordinates.xy, color).rgb, 1.0);
    outNormal = vec4(dot(normal, towardsEye) < 0.0 ? -normal : normal, 0.0);
    outEmission = vec4(min(emission.rgb * texture(emissionTexture, coordinates.zw).rgb, vec3(65504.0)), 0.0);
}
