// SPDX-License-Identifier: MIT
// Points that fill what they are in evenly, and numbers that look random; the same everywhere.
#pragma once

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace rebound::detail {

// Element `index` of the Halton sequence of a base: the index's digits, mirrored at the point; 0 to 1.
inline double halton(uint64_t index, uint32_t base) {
    double result = 0.0, digit = 1.0;
    for (; index > 0; index /= base) {
        digit /= double(base);
        result += double(index % base) * digit;
    }
    return result;
}

// A number that looks random. Steele, Lea, Flood: Fast Splittable Pseudorandom Number Generators (SplitMix64).
inline uint64_t hash(uint64_t value) {
    value += 0x9e3779b97f4a7c15ull;
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ull;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebull;
    return value ^ (value >> 31);
}

// Of 0 to 1, less than 1.
inline double unit(uint64_t hashed) { return double(hashed >> 11) * 0x1p-53; }

// Points moved together, around the square's edges: as even as before. Cranley, Patterson: Randomization of Number
// Theoretic Methods for Multiple Integration, 1976.
inline glm::dvec2 shifted(glm::dvec2 point, uint64_t hashed) {
    const glm::dvec2 sum = point + glm::dvec2(unit(hashed), unit(hash(hashed)));
    return sum - glm::floor(sum);
}

// From the unit square to barycentric weights of two corners, without folds: close points stay close.
// Heitz: A Low-Distortion Map Between Triangle and Square, 2019.
inline glm::dvec2 triangleFromSquare(glm::dvec2 p) {
    return p.y > p.x ? glm::dvec2(0.5 * p.x, p.y - 0.5 * p.x) : glm::dvec2(p.x - 0.5 * p.y, 0.5 * p.y);
}

// A direction around a unit normal, of density cosine over pi.
inline glm::vec3 cosineDirection(glm::vec3 normal, glm::dvec2 p) {
    // Duff et al.: Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    const glm::vec3 tangent(1.0f + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    const glm::vec3 bitangent(b, sign + normal.y * normal.y * a, -normal.y);
    const auto radius = float(std::sqrt(p.x));
    const auto angle = float(2.0 * std::numbers::pi * p.y);
    return glm::normalize(radius * std::cos(angle) * tangent + radius * std::sin(angle) * bitangent +
                          float(std::sqrt(1.0 - p.x)) * normal);
}

} // namespace rebound::detail
