#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Direct light: albedo * E / pi + emission. A light that casts no shadow here shines through walls.
#include "frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// GpuLight in lights.hpp is its twin.
struct Light {
    vec4 position;  // .xyz [m], .w kind
    vec4 direction; // .xyz the way light travels, or a surface's normal; .w the cosine of a spot's outer cone
    vec4 intensity; // .rgb [W m^-2], [W sr^-1]; .w the cosine of a spot's inner cone, or a surface's area over pi [m^2]
};
const int directional = 0, point = 1, spot = 2, surface = 3, twoSidedSurface = 4;

layout(set = 1, binding = 0) uniform sampler2D depthImage;
layout(set = 1, binding = 1) uniform sampler2D normalImage;
layout(set = 1, binding = 2) uniform sampler2D albedoImage;
layout(set = 1, binding = 3) uniform sampler2D emissionImage;
layout(set = 1, binding = 4) uniform sampler2D shadowMap;
layout(set = 1, binding = 5, rgba16f) writeonly uniform image2D litImage;
layout(set = 1, binding = 6, std430) readonly buffer Lights { Light lights[]; };

// The share of 3 x 3 texels that the shadowed light reaches. The receiver is moved off its surface by the texels' width,
// so that a surface does not shadow itself.
float visibility(vec3 position, vec3 normal) {
    float distance = frame.shadow.y > 0.0 ? (frame.shadowMatrix * vec4(position, 1.0)).w : 1.0;
    vec4 clip = frame.shadowMatrix * vec4(position + normal * (3.0 * frame.shadow.x * distance), 1.0);
    vec3 at = clip.xyz / clip.w;
    ivec2 size = textureSize(shadowMap, 0);
    ivec2 texel = ivec2(floor((at.xy * 0.5 + 0.5) * vec2(size)));
    bool inside = clip.w > 0.0 && all(lessThan(abs(at.xy), vec2(1.0))) && at.z < 1.0;
    if (!inside) return 1.0;
    float lit = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            lit += texelFetch(shadowMap, clamp(texel + ivec2(x, y), ivec2(0), size - 1), 0).r >= at.z ? 1.0 : 0.0;
    return lit / 9.0;
}

vec3 irradiance(Light light, vec3 position, vec3 normal) {
    int kind = int(light.position.w);
    if (kind == directional) return light.intensity.rgb * max(dot(normal, -light.direction.xyz), 0.0);
    vec3 towards = light.position.xyz - position;
    float squared = max(dot(towards, towards), 1e-12);
    vec3 direction = towards * inversesqrt(squared);
    float cosine = max(dot(normal, direction), 0.0), emitted = -dot(direction, light.direction.xyz);
    if (kind == point) return light.intensity.rgb * (cosine / squared);
    if (kind == spot) { // KHR_lights_punctual: the square of a ramp
        float width = light.intensity.w - light.direction.w;
        float ramp = width > 0.0 ? clamp((emitted - light.direction.w) / width, 0.0, 1.0) : step(light.direction.w, emitted);
        return light.intensity.rgb * (cosine * ramp * ramp / squared);
    }
    // A part of a surface as a disc: bounded where it is near.
    emitted = kind == surface ? max(emitted, 0.0) : abs(emitted);
    return light.intensity.rgb * (cosine * emitted / (squared + light.intensity.w));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.counts.zw))) return;
    float depth = texelFetch(depthImage, pixel, 0).r;
    vec3 lit = vec3(0.0);
    if (depth > 0.0) { // reversed: 0 is the far plane
        vec2 screen = (vec2(pixel) + 0.5) / vec2(frame.counts.zw) * 2.0 - 1.0;
        vec4 world = frame.inverseViewProjection * vec4(screen, depth, 1.0);
        vec3 position = world.xyz / world.w, normal = texelFetch(normalImage, pixel, 0).xyz, sum = vec3(0.0);
        for (int i = 0; i < frame.counts.y; ++i) sum += irradiance(lights[i], position, normal);
        if (sum != vec3(0.0)) sum *= visibility(position, normal);
        for (int i = frame.counts.y; i < frame.counts.x; ++i) sum += irradiance(lights[i], position, normal);
        lit = texelFetch(albedoImage, pixel, 0).rgb * sum / 3.14159265 + texelFetch(emissionImage, pixel, 0).rgb;
    }
    imageStore(litImage, pixel, vec4(min(lit, vec3(65504.0)), 1.0));
}
