#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
#include "frame.glsl"
#include "material.glsl"

layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
layout(location = 2) in vec4 coordinates; // .xy of the base colour, .zw of the emission
layout(location = 3) in vec4 color;
layout(location = 4) in vec4 clip;
layout(location = 5) in vec4 previousClip;
layout(location = 0) out vec4 outNormal;   // world space, unit, towards the camera
layout(location = 1) out vec4 outAlbedo;
layout(location = 2) out vec4 outEmission; // [W m^-2 sr^-1]
layout(location = 3) out vec2 outMotion;   // from here to where this was in the frame before [texture coordinates]

void main() {
    vec3 towardsEye = frame.eye.xyz - worldPosition * frame.eye.w;
    vec3 normal = normalize(worldNormal);
    outAlbedo = vec4(baseColorAt(coordinates.xy, color).rgb, 1.0);
    outNormal = vec4(dot(normal, towardsEye) < 0.0 ? -normal : normal, 0.0);
    outEmission = vec4(min(material.emission.rgb * texture(emissionTexture, coordinates.zw).rgb, vec3(65504.0)), 0.0);
    outMotion = 0.5 * (previousClip.xy / previousClip.w - clip.xy / clip.w);
}
