// SPDX-License-Identifier: MIT
// Form factors against closed forms, packing, and the weights of upsampling.
#include "kernel_runner.hpp"

#include <glm/glm.hpp>

#include <cmath>
#include <numbers>

namespace rebound::test {
namespace {

constexpr double pi = std::numbers::pi;

Picture lightMath(cpu::Isa isa, int mode, Picture& first, Picture& second) {
    const GridConstants k{{first.extent.width, first.extent.height, 0, 0}};
    return runKernel(isa,
                     {"light_math", {mode}, {{0, &first}, {1, &second}}, {{3, bytesOf(k)}}, 2, first.extent});
}

// A piece of a sender: a receiver at the origin with normal +z looks at it.
struct Patch {
    glm::dvec3 position, normal;
    double area;
};

// The sum of the patches' form factors, by the kernel's formula.
double sumOfFactors(cpu::Isa isa, int mode, const std::vector<Patch>& patches) {
    const Extent2D extent{64, int((patches.size() + 63) / 64)};
    Picture first(extent, 4), second(extent, 4);
    for (size_t i = 0; i < size_t(extent.width) * size_t(extent.height); ++i) {
        first.values[4 * i + 2] = 1.0f;
        if (i >= patches.size()) continue;
        const Patch& p = patches[i];
        const double r = glm::length(p.position);
        first.values[4 * i] = float(std::max(p.position.z / r, 0.0));
        first.values[4 * i + 1] = float(p.area / pi * std::max(-glm::dot(p.normal, p.position) / r, 0.0));
        first.values[4 * i + 2] = float(r * r);
    }
    const Picture factors = lightMath(isa, mode, first, second);
    double sum = 0.0;
    for (size_t i = 0; i < patches.size(); ++i) sum += factors.values[4 * i];
    return sum;
}

// A parallelogram in n x n patches.
std::vector<Patch> parallelogram(glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v, int n) {
    const glm::dvec3 c = glm::cross(u, v);
    std::vector<Patch> patches;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            patches.push_back({corner + u * ((i + 0.5) / n) + v * ((j + 0.5) / n), glm::normalize(c),
                               glm::length(c) / (n * n)});
    return patches;
}

// Lambert's formula for a polygon above the receiver's plane: half the sum over its edges of the angle that
// each subtends times the cosine between the edge's plane and the receiver, over pi.
double lambert(const std::vector<glm::dvec3>& corners) {
    double sum = 0.0;
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = corners[i], b = corners[(i + 1) % corners.size()], c = glm::cross(a, b);
        sum += std::atan2(glm::length(c), glm::dot(a, b)) * c.z / glm::length(c);
    }
    return std::abs(sum) / (2.0 * pi);
}

double lambert(glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v) {
    return lambert({corner, corner + u, corner + u + v, corner + v});
}

} // namespace

TEST_CASE("a point and a coaxial disc: the point-to-disc factor is exact") {
    for (cpu::Isa isa : cpu::availableIsas())
        for (double radius : {0.001, 0.1, 1.0, 30.0})
            for (double height : {0.01, 0.5, 2.0, 100.0}) {
                const std::vector<Patch> disc = {{{0, 0, height}, {0, 0, -1}, pi * radius * radius}};
                // Closed form a^2 / (a^2 + h^2); single precision and a reciprocal to 5e-7.
                CHECK(sumOfFactors(isa, lightDisc, disc) ==
                      doctest::Approx(radius * radius / (radius * radius + height * height)).epsilon(2e-6));
            }
}

TEST_CASE(
    "a point, and squares parallel and perpendicular to its surface: patches add up to Lambert's formula") {
    struct Square {
        glm::dvec3 corner, u, v;
    };
    const Square squares[] = {
        {{-0.5, -0.5, 1}, {0, 1, 0}, {1, 0, 0}},   // parallel, centred
        {{0.2, 0.3, 0.7}, {0, 1, 0}, {1, 0, 0}},   // parallel, aside
        {{1, -0.5, 0}, {0, 0, 1}, {0, 1, 0}},      // perpendicular, standing on the receiver's plane
        {{-1.5, -0.5, 0.1}, {0, 1, 0}, {0, 0, 1}}, // perpendicular, above it
    };
    for (const Square& s : squares) {
        // Lambert's formula itself, against the closed form of a point below a unit square's middle at
        // distance 1.
        if (s.corner.x == -0.5)
            CHECK(lambert(s.corner, s.u, s.v) ==
                  doctest::Approx(4.0 / (pi * std::sqrt(5.0)) * std::atan(1.0 / std::sqrt(5.0)))
                      .epsilon(1e-12));
        const auto patches = parallelogram(s.corner, s.u, s.v, 100);
        for (cpu::Isa isa : cpu::availableIsas())
            for (int mode : {lightDisc, lightPoint})
                // The midpoint rule errs by (0.01 / 0.7)^2 or so; discs by area / (pi r^2) = 1e-4 / 1.5.
                CHECK(sumOfFactors(isa, mode, patches) ==
                      doctest::Approx(lambert(s.corner, s.u, s.v)).epsilon(5e-4));
    }
}

TEST_CASE("a plane and a sphere above it: patches add up to R^2 / d^2 times the cosine") {
    const int n = 120;
    for (double radius : {0.2, 1.0})
        for (glm::dvec3 center : {glm::dvec3(0, 0, 2.5), glm::dvec3(1.2, -0.4, 2.0)}) {
            std::vector<Patch> patches;
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < 2 * n; ++j) {
                    const double t = pi * (i + 0.5) / n, f = pi * (j + 0.5) / n;
                    const glm::dvec3 normal(std::sin(t) * std::cos(f), std::sin(t) * std::sin(f),
                                            std::cos(t));
                    patches.push_back({center + radius * normal, normal,
                                       radius * radius * pi / n *
                                           (std::cos(t - pi / (2 * n)) - std::cos(t + pi / (2 * n)))});
                }
            const double d2 = glm::dot(center, center);
            const double exact = radius * radius / d2 * center.z / std::sqrt(d2);
            for (cpu::Isa isa : cpu::availableIsas())
                for (int mode : {lightDisc, lightPoint})
                    // Patches at the outline count whole or not at all: an error of order 1 / n of the
                    // outline's small share.
                    CHECK(sumOfFactors(isa, mode, patches) == doctest::Approx(exact).epsilon(2e-3));
        }
}

TEST_CASE("the point-to-disc factor is bounded where surfaces meet, and point to point for small areas") {
    Picture first({400, 1}, 4), second({400, 1}, 4);
    for (int i = 0; i < 400; ++i) {
        first.at(i, 0, 0) = 0.8f;
        first.at(i, 0, 1) = 0.01f;
        first.at(i, 0, 2) = std::pow(10.0f, -30.0f + 0.08f * float(i)); // 1e-30 to 80 m^2
    }
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Picture disc = lightMath(isa, lightDisc, first, second),
                      point = lightMath(isa, lightPoint, first, second);
        for (int i = 0; i < 400; ++i) {
            const double d2 = first.at(i, 0, 2);
            CHECK(disc.at(i, 0, 0) <=
                  0.8f * 1.000001f); // never above the cosine, but for the rounding of the quotient
            CHECK(disc.at(i, 0, 0) ==
                  doctest::Approx(0.8 * 0.01 / (d2 + 0.01)).epsilon(2e-6)); // single precision
            CHECK(std::isfinite(point.at(i, 0, 0)));
            // They part by the disc's share R^2 / r^2.
            if (d2 > 1.0)
                CHECK(point.at(i, 0, 0) / disc.at(i, 0, 0) == doctest::Approx(1.0 + 0.01 / d2).epsilon(4e-6));
        }
    }
}

TEST_CASE("texels of a level come out of their images as they went in") {
    Picture first({100, 3}, 4), second({100, 3}, 4);
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(std::sin(i), std::cos(3 * i), std::sin(2 * i + 1)));
        for (size_t k = 0; k < 3; ++k) first.values[size_t(4 * i) + k] = float(n[int(k)]);
        first.values[size_t(4 * i + 3)] = 0.01f * float(i + 1);
        second.values[size_t(4 * i)] =
            std::pow(10.0f, -16.0f + 0.09f * float(i)); // areas from 1e-16 to 1e10 m^2
        second.values[size_t(4 * i + 1)] = first.values[size_t(4 * i + 3)] * (1.0f + 0.003f * float(i % 100));
        second.values[size_t(4 * i + 2)] = float(i);
    }
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Picture surface = lightMath(isa, lightUnpacked, first, second);
        const Picture rest = lightMath(isa, lightUnpackedArea, first, second);
        for (size_t i = 0; i < 300; ++i) {
            // A product, a sum of squares and an inverse square root to 5e-7.
            for (size_t k = 0; k < 3; ++k)
                CHECK(std::abs(surface.values[4 * i + k] - first.values[4 * i + k]) < 1.5e-6f);
            // One of the two distances is kept as its ratio to the other: a quotient to 5e-7, and three
            // roundings.
            CHECK(surface.values[4 * i + 3] == doctest::Approx(first.values[4 * i + 3]).epsilon(1e-6));
            CHECK(rest.values[4 * i + 1] == doctest::Approx(second.values[4 * i + 1]).epsilon(1e-6));
            CHECK(rest.values[4 * i] == doctest::Approx(second.values[4 * i]).epsilon(2e-6));
            CHECK(rest.values[4 * i + 2] == second.values[4 * i + 2]);
            CHECK(rest.values[4 * i + 3] == second.values[4 * i + 2]);
        }
    }
}

TEST_CASE("a texel without surface stays zero") {
    Picture zero({20, 1}, 4), rest({20, 1}, 4);
    for (cpu::Isa isa : cpu::availableIsas())
        for (int mode : {lightUnpacked, lightUnpackedArea})
            CHECK(lightMath(isa, mode, zero, rest).values == std::vector<float>(80, 0.0f));
}

TEST_CASE(
    "bilateral weights: 1 where surfaces agree, next to nothing far from the plane and where normals part") {
    // A small share is left to texels that do not agree: it decides where none does.
    constexpr float share = 1e-3f;
    // Both factors are fourth powers of rough reciprocals, which are off by 1.5 * 2^-12 at most.
    constexpr float rounding = 8.0f * 1.5f / 4096.0f;
    Picture first({101, 3}, 4), second({101, 3}, 4);
    for (int i = 0; i <= 100; ++i) {
        const float distance = 0.05f * float(i); // from the receiver's plane [widths of a texel]
        first.at(i, 0, 0) = distance;
        first.at(i, 1, 0) = 0.0f;
        first.at(i, 2, 0) = std::pow(10.0f, 0.36f * float(i) + 1.0f); // 10 to 1e37 widths
        // Normals of another length than 1.
        second.at(i, 0, 2) = second.at(i, 2, 2) = 0.25f;
        const float cosine2 = 0.01f * float(i);
        second.at(i, 1, 0) = 0.25f * std::sqrt(1.0f - cosine2);
        second.at(i, 1, 2) = 0.25f * std::sqrt(cosine2);
    }
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Picture w = lightMath(isa, lightBilateral, first, second);
        CHECK(std::abs(w.at(100, 1, 0) - 1.0f) < share + rounding);
        CHECK(w.at(0, 1, 0) < share);
        for (int i = 0; i <= 100; ++i) {
            CHECK((w.at(i, 0, 0) >= 0.0f && w.at(i, 0, 0) <= 1.0f + share + rounding));
            CHECK((w.at(i, 2, 0) >= 0.0f && w.at(i, 2, 0) < share));
            // Falls with the distance, and rises with the cosine.
            if (i > 0) CHECK(w.at(i, 0, 0) <= w.at(i - 1, 0, 0));
            if (i > 0) CHECK(w.at(i, 1, 0) >= w.at(i - 1, 1, 0));
        }
    }
}

} // namespace rebound::test
