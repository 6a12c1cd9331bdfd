// SPDX-License-Identifier: MIT
#include "rebound/bake/packing.hpp"

#include <doctest/doctest.h>

using namespace rebound;

TEST_CASE("Octahedral normals come back within the distance between two of them, axes exactly") {
    for (const glm::vec3 axis : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0),
                                 glm::vec3(0, -1, 0), glm::vec3(0, 0, 1)})
        CHECK(unpackOctahedral(packOctahedral(axis)) == axis);
    float largest = 0.0f;
    for (int i = 0; i < 5000; ++i) {
        const float z = 1.0f - 2.0f * (float(i) + 0.5f) / 5000.0f;
        const float angle = 2.399963f * float(i);
        const float across = std::sqrt(1.0f - z * z);
        const glm::vec3 normal(across * std::cos(angle), across * std::sin(angle), z);
        largest = std::max(largest, glm::length(unpackOctahedral(packOctahedral(normal)) - normal));
    }
    // A step is 1 / 32767, half of one along both axes the most that rounding leaves, and the map stretches by 3 at most:
    // in the middle of a face, sqrt(3) for its slope and sqrt(3) for its nearness to the origin. 2e-7: rounding.
    CHECK(largest < 3.0f * std::sqrt(0.5f) / 32767.0f + 2e-7f);
    CHECK(unpackOctahedral(packOctahedral(glm::vec3(0, 0, -1))).z == -1.0f);
}

TEST_CASE("Octahedral numbers lie where shaders look for them") {
    CHECK(packOctahedral({1, 0, 0}) == 0x00007fffu);
    CHECK(packOctahedral({0, 1, 0}) == 0x7fff0000u);
    CHECK(packOctahedral({0, 0, 1}) == 0u);
}

TEST_CASE("Albedo has 10 bits a channel, red low, and is clamped") {
    CHECK(packAlbedo({1, 0, 0}) == 1023u);
    CHECK(packAlbedo({0, 1, 0}) == 1023u << 10);
    CHECK(packAlbedo({0, 0, 2}) == 1023u << 20);
    const glm::vec3 albedo(0.123f, 0.5f, 0.987f);
    const glm::vec3 back = unpackAlbedo(packAlbedo(albedo));
    for (int i = 0; i < 3; ++i) CHECK(std::abs(back[i] - albedo[i]) <= 0.5f / 1023.0f + 1e-6f);
}

TEST_CASE("Emission shares an exponent as GL_RGB9_E5 does") {
    // 1 = 256 / 512 * 2^1: mantissa 256, exponent 16.
    CHECK(packEmission({1, 0, 0}) == (16u << 27 | 256u));
    CHECK(packEmission({0, 1, 0}) == (16u << 27 | 256u << 9));
    CHECK(packEmission({0, 0, 1}) == (16u << 27 | 256u << 18));
    CHECK(packEmission(glm::vec3(0)) == 0u);
    CHECK(unpackEmission(packEmission(glm::vec3(maximumEmission))) == glm::vec3(maximumEmission));
    CHECK(unpackEmission(packEmission(glm::vec3(1e30f))) == glm::vec3(maximumEmission));
    CHECK(unpackEmission(packEmission(glm::vec3(-1.0f))) == glm::vec3(0));
    CHECK(unpackEmission(packEmission(glm::vec3(1e-30f))) == glm::vec3(0));
    // The largest channel keeps 8 bits or more; the others are steps of the same size.
    for (float scale = 1e-3f; scale < 6e4f; scale *= 1.37f) {
        const glm::vec3 emission = scale * glm::vec3(1.0f, 0.3f, 0.011f);
        const glm::vec3 back = unpackEmission(packEmission(emission));
        for (int i = 0; i < 3; ++i) CHECK(std::abs(back[i] - emission[i]) <= scale / 511.0f);
    }
}
