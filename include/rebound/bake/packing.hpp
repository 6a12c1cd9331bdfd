// SPDX-License-Identifier: MIT
// How a bake's sections hold normals and colours: see BakeSection.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rebound {

// A unit vector on the octahedron |x| + |y| + |z| = 1, its lower half (z < 0) folded out, as two signed 16-bit numbers;
// x low. Of the four ways to round, the one nearest to the vector.
// Cigolle et al.: A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3(2), 2014.
inline glm::vec3 unpackOctahedral(uint32_t packed) {
    const glm::vec2 p = glm::unpackSnorm2x16(packed);
    const float z = 1.0f - std::abs(p.x) - std::abs(p.y);
    const float fold = std::max(-z, 0.0f);
    return glm::normalize(
        glm::vec3(p.x + (p.x >= 0.0f ? -fold : fold), p.y + (p.y >= 0.0f ? -fold : fold), z));
}

inline uint32_t packOctahedral(glm::vec3 unit) {
    const float sum = std::abs(unit.x) + std::abs(unit.y) + std::abs(unit.z);
    glm::vec2 p = glm::vec2(unit) / sum;
    if (unit.z < 0.0f)
        p = {(1.0f - std::abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f),
             (1.0f - std::abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f)};
    constexpr float steps = 32767.0f;
    const glm::vec2 low = glm::floor(p * steps) / steps;
    uint32_t best = 0;
    float nearest = 8.0f; // squared; cosines this near to 1 are all the same number
    for (int i = 0; i < 4; ++i) {
        const glm::vec2 corner = low + glm::vec2(float(i & 1), float(i >> 1)) / steps;
        const uint32_t packed = glm::packSnorm2x16(glm::clamp(corner, -1.0f, 1.0f));
        const glm::vec3 off = unpackOctahedral(packed) - unit;
        if (const float distance = glm::dot(off, off); distance < nearest) {
            best = packed;
            nearest = distance;
        }
    }
    return best;
}

// Reflectances of 0 to 1 in steps of 1 / 1023, 10 bits each, red low.
inline uint32_t packAlbedo(glm::vec3 albedo) { return glm::packUnorm3x10_1x2(glm::vec4(albedo, 0.0f)); }
inline glm::vec3 unpackAlbedo(uint32_t packed) { return glm::vec3(glm::unpackUnorm3x10_1x2(packed)); }

// The largest radiance that packEmission() keeps; greater ones become that. GLM's function of that format stops at half
// of it.
inline constexpr float maximumEmission = 65408.0f;

// Radiances of 0 to maximumEmission, 9 bits each and a common exponent of 5 bits, red low.
// OpenGL 4.6 core profile, section 8.5.2, "Encoding of Special Internal Formats".
inline uint32_t packEmission(glm::vec3 emission) {
    constexpr int bits = 9, bias = 15;
    const glm::vec3 clamped = glm::clamp(emission, 0.0f, maximumEmission);
    const float largest = std::max({clamped.x, clamped.y, clamped.z});
    int exponent = largest > 0.0f ? std::max(-bias - 1, std::ilogb(largest)) + 1 + bias : 0;
    if (std::floor(std::ldexp(largest, bias + bits - exponent) + 0.5f) >= float(1 << bits)) ++exponent;
    uint32_t packed = uint32_t(exponent) << (3 * bits);
    for (int i = 0; i < 3; ++i)
        packed |= uint32_t(std::floor(std::ldexp(clamped[i], bias + bits - exponent) + 0.5f)) << (i * bits);
    return packed;
}
inline glm::vec3 unpackEmission(uint32_t packed) {
    const auto channel = [&](int i) {
        return std::ldexp(float(packed >> (9 * i) & 511u), int(packed >> 27) - 24);
    };
    return {channel(0), channel(1), channel(2)};
}

} // namespace rebound
