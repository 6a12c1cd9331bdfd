#version 430
// SPDX-License-Identifier: MIT
// Direct light: albedo * E / pi + emission; and of it what surfaces send to others: without the emission where emissive
// surfaces are lights, as it would arrive twice. A light that casts no shadow here shines through walls.
#include "frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#include "light.glsl"

layout(binding = 0) uniform sampler2D depthImage;
layout(binding = 1) uniform sampler2D normalImage;
layout(binding = 2) uniform sampler2D albedoImage;
layout(binding = 3) uniform sampler2D emissionImage;
layout(binding = 4) uniform sampler2D shadowMap;
layout(binding = 0, rgba16f) writeonly uniform image2D litImage;
layout(binding = 1, rgba16f) writeonly uniform image2D radianceImage;
layout(binding = 0, std430) readonly buffer Lights { Light lights[]; };

float storedDepth(float deviceDepth) { return deviceDepth * 0.5 + 0.5; } // -1 to 1

#include "direct_light.glsl"

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.counts.zw))) return;
    float depth = texelFetch(depthImage, pixel, 0).r;
    vec3 reflected = vec3(0.0), emitted = vec3(0.0);
    if (depth < 1.0) { // 1 is the far plane
        vec2 screen = (vec2(pixel) + 0.5) / vec2(frame.counts.zw);
        vec4 world = frame.inverseViewProjection * vec4(vec3(screen, depth) * 2.0 - 1.0, 1.0);
        vec3 position = world.xyz / world.w, normal = texelFetch(normalImage, pixel, 0).xyz, sum = vec3(0.0);
        for (int i = 0; i < frame.counts.y; ++i) sum += irradiance(lights[i], position, normal);
        if (sum != vec3(0.0)) sum *= visibility(position, normal);
        for (int i = frame.counts.y; i < frame.counts.x; ++i) sum += irradiance(lights[i], position, normal);
        reflected = texelFetch(albedoImage, pixel, 0).rgb * sum / 3.14159265;
        emitted = texelFetch(emissionImage, pixel, 0).rgb;
    }
    vec3 sent = reflected + emitted * (1.0 - frame.shadow.z);
    imageStore(litImage, pixel, vec4(min(reflected + emitted, vec3(65504.0)), 1.0));
    imageStore(radianceImage, pixel, vec4(min(sent, vec3(65504.0)), 1.0));
}
