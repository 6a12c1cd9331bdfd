// SPDX-License-Identifier: MIT
// Spherical harmonics by quadrature over the sphere, and skies whose irradiance is known.
#include "item_runner.hpp"

#include "rebound/math/spherical_harmonics.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace rebound::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int harmonicCount = host::maximumHarmonics;

struct Node {
    glm::dvec3 direction;
    double solidAngle;
};

// A product rule over the sphere above a height: Gauss's in z with 16 nodes, found by Newton's method, and 32 equal steps
// around. It is exact for polynomials of degree 31, and so for products of two harmonics.
std::vector<Node> sphereAbove(double lowest) {
    std::vector<Node> nodes;
    constexpr int n = 16;
    for (int i = 0; i < n; ++i) {
        double z = std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1.0;
        for (int step = 0; step < 50; ++step) {
            double p = 1.0, before = 0.0; // Legendre's polynomials, by Bonnet's recursion
            for (int k = 1; k <= n; ++k) {
                const double next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
                before = p;
                p = next;
            }
            slope = n * (z * p - before) / (z * z - 1.0);
            z -= p / slope;
        }
        const double share = 0.5 * (1.0 - lowest), weight = share * 2.0 / ((1.0 - z * z) * slope * slope);
        z = lowest + share * (z + 1.0);
        const double r = std::sqrt(1.0 - z * z);
        for (int j = 0; j < 2 * n; ++j) {
            const double phi = pi * (j + 0.5) / n;
            nodes.push_back({{r * std::cos(phi), r * std::sin(phi), z}, weight * pi / n});
        }
    }
    return nodes;
}

std::vector<Node> sphere() { return sphereAbove(-1.0); }

// By harmonic, by direction.
using Table = std::vector<std::array<float, harmonicCount>>;

// What the kernel gives: the directions' harmonics, or their lobes' coefficients.
Table harmonicsOf(cpu::Isa isa, const std::vector<glm::dvec3>& directions,
                  const std::vector<float>& exponents = {}) {
    const size_t count = directions.size();
    std::vector<float> values(4 * count, 1.0f);
    for (size_t i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) values[size_t(k) * count + i] = float(directions[i][k]);
        if (!exponents.empty()) values[3 * count + i] = exponents[i];
    }
    const ItemConstants k{{int(count), int(count), 0, 0}};
    const auto bytes = std::as_bytes(std::span(values));
    const std::vector<float> result =
        runItemKernel(isa, {"harmonics",
                            {exponents.empty() ? harmonicsAlone : harmonicsLobe},
                            {{0, {bytes.begin(), bytes.end()}}},
                            {{2, bytesOf(k)}},
                            1,
                            count * size_t(harmonicCount),
                            int(count)});
    Table table(count);
    for (size_t i = 0; i < count; ++i)
        for (size_t h = 0; h < size_t(harmonicCount); ++h) table[i][h] = result[h * count + i];
    return table;
}

std::vector<glm::dvec3> directionsOf(const std::vector<Node>& nodes) {
    std::vector<glm::dvec3> directions;
    for (const Node& n : nodes) directions.push_back(n.direction);
    return directions;
}

// Directions of no symmetry, and the axes.
std::vector<glm::dvec3> someDirections() {
    std::vector<glm::dvec3> directions = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                          {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    for (int i = 0; i < 31; ++i)
        directions.push_back(
            glm::normalize(glm::dvec3(std::sin(1.0 + i), std::cos(2.7 * i), std::sin(0.4 * i * i) + 0.1)));
    return directions;
}

// The coefficients of a radiance, by quadrature.
std::array<double, harmonicCount> project(const std::vector<Node>& nodes, const Table& y,
                                          const std::function<double(glm::dvec3)>& radiance) {
    std::array<double, harmonicCount> c{};
    for (size_t i = 0; i < nodes.size(); ++i)
        for (size_t h = 0; h < c.size(); ++h)
            c[h] += nodes[i].solidAngle * radiance(nodes[i].direction) * double(y[i][h]);
    return c;
}

double product(const std::array<double, harmonicCount>& a, const std::array<float, harmonicCount>& b) {
    double sum = 0.0;
    for (size_t h = 0; h < a.size(); ++h) sum += a[h] * double(b[h]);
    return sum;
}

} // namespace

TEST_CASE("spherical harmonics are orthonormal") {
    const std::vector<Node> nodes = sphere();
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Table y = harmonicsOf(isa, directionsOf(nodes));
        for (size_t a = 0; a < size_t(harmonicCount); ++a)
            for (size_t b = 0; b <= a; ++b) {
                double sum = 0.0;
                for (size_t i = 0; i < nodes.size(); ++i)
                    sum += nodes[i].solidAngle * double(y[i][a]) * double(y[i][b]);
                // Some roundings of numbers of at most 1.
                CHECK(std::abs(sum - (a == b ? 1.0 : 0.0)) < 1e-6);
            }
    }
}

TEST_CASE("band 1 is y, z, x; every band has the sum of squares of the addition theorem") {
    const auto directions = someDirections();
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Table y = harmonicsOf(isa, directions);
        for (size_t i = 0; i < directions.size(); ++i) {
            const double scale = std::sqrt(3.0 / (4.0 * pi));
            CHECK(std::abs(y[i][1] - scale * directions[i].y) < 1e-6); // roundings
            CHECK(std::abs(y[i][2] - scale * directions[i].z) < 1e-6);
            CHECK(std::abs(y[i][3] - scale * directions[i].x) < 1e-6);
            for (size_t l = 0; l < 4; ++l) {
                double sum = 0.0;
                for (size_t h = l * l; h < (l + 1) * (l + 1); ++h) sum += double(y[i][h]) * double(y[i][h]);
                CHECK(sum == doctest::Approx(double(2 * l + 1) / (4.0 * pi)).epsilon(2e-6)); // roundings
            }
        }
    }
}

TEST_CASE("the host's harmonics and lobes are the kernels'") {
    const auto directions = someDirections();
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Table y = harmonicsOf(isa, directions);
        const Table lobes = harmonicsOf(isa, directions, std::vector<float>(directions.size(), 5.0f));
        for (size_t i = 0; i < directions.size(); ++i) {
            const auto h = host::sphericalHarmonics(glm::vec3(directions[i]));
            const auto lobe = host::lobe(glm::vec3(directions[i]), 5.0f);
            for (size_t k = 0; k < size_t(harmonicCount); ++k) {
                CHECK(std::abs(h.value[k] - y[i][k]) < 1e-6f); // sums may be contracted
                CHECK(std::abs(lobe.value[k] - lobes[i][k]) < 1e-6f);
            }
        }
    }
}

TEST_CASE("a lobe's factors are the integrals of Legendre's polynomials over it") {
    // (n + 1) times the integral from 0 to 1 of x^n P_l(x).
    const auto expected = [](double n, size_t l) {
        if (l == 0) return 1.0;
        if (l == 1) return (n + 1) / (n + 2);
        if (l == 2) return (n + 1) * (1.5 / (n + 3) - 0.5 / (n + 1));
        return (n + 1) * (2.5 / (n + 4) - 1.5 / (n + 2));
    };
    const glm::dvec3 d = glm::normalize(glm::dvec3(0.3, -0.5, 0.7));
    const std::vector<float> exponents = {0.0f, 0.5f, 1.0f, 2.0f, 3.0f, 7.0f, 20.0f, 200.0f};
    const std::vector<glm::dvec3> directions(exponents.size(), d);
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Table y = harmonicsOf(isa, directions), lobes = harmonicsOf(isa, directions, exponents);
        for (size_t i = 0; i < exponents.size(); ++i)
            for (size_t h = 0; h < size_t(harmonicCount); ++h) {
                const size_t l = h < 1 ? 0 : h < 4 ? 1 : h < 9 ? 2 : 3;
                // Roundings of numbers of at most 1.
                CHECK(std::abs(lobes[i][h] - expected(exponents[i], l) * double(y[i][h])) < 1e-6);
            }
    }
}

TEST_CASE("a constant sphere, a cosine sky and a half-space sky give their irradiance over pi") {
    const std::vector<Node> nodes = sphere(), upper = sphereAbove(0.0);
    const auto directions = someDirections();
    const glm::dvec3 up = glm::normalize(glm::dvec3(0.2, 0.6, -0.5));
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Table y = harmonicsOf(isa, directionsOf(nodes));
        const Table lobes = harmonicsOf(isa, directions, std::vector<float>(directions.size(), 1.0f));
        const auto constant = project(nodes, y, [](glm::dvec3) { return 1.0; });
        const auto cosine = project(nodes, y, [&](glm::dvec3 w) { return 1.0 + glm::dot(w, up); });
        const auto half =
            project(upper, harmonicsOf(isa, directionsOf(upper)), [](glm::dvec3) { return 1.0; });
        for (size_t i = 0; i < directions.size(); ++i) {
            // Single precision of sixteen products.
            CHECK(product(constant, lobes[i]) == doctest::Approx(1.0).epsilon(2e-6));
            // A sky without harmonics above band 1: the lobe's mean is 1 + 2/3 of the cosine.
            CHECK(product(cosine, lobes[i]) ==
                  doctest::Approx(1.0 + 2.0 / 3.0 * glm::dot(up, directions[i])).epsilon(4e-6));
            // The share of the cosine-weighted hemisphere above a plane is (1 + cos) / 2. The half space has no even
            // bands above 0, and the lobe has no odd ones above 1.
            CHECK(std::abs(product(half, lobes[i]) - (0.5 + 0.5 * directions[i].z)) < 4e-6);
        }
    }
}

} // namespace rebound::test
