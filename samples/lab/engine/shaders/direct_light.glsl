// SPDX-License-Identifier: MIT
// Light on surfaces. Whoever includes it has the frame, shadowMap, and storedDepth(): what a depth texture holds for a
// normalised device depth.

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
    float depth = storedDepth(at.z), lit = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            lit += texelFetch(shadowMap, clamp(texel + ivec2(x, y), ivec2(0), size - 1), 0).r >= depth ? 1.0 : 0.0;
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
