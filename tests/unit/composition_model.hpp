// SPDX-License-Identifier: MIT
// Precomputed illuminance composition by plain loops in double precision, from a packed bake: what kernels have to give.
#pragma once

#include "made_bake.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace rebound::test {

class CompositionModel {
public:
    CompositionModel(const Bake& b, bool bounces, bool emission)
        : bake(b), hasBounces(bounces), hasEmission(emission),
          caches(b.layout.caches, std::array<glm::dvec3, 16>{}) {}

    // A frame's surfels, nodes and caches. light: as the technique takes it.
    void run(const std::vector<float>& light) {
        const BakeLayout& l = bake.layout;
        nodes.assign(l.nodes + 1, glm::dvec3(0.0));
        for (uint32_t i = 0; i < l.surfels; ++i) nodes[i] = sentBy(i, light);
        for (uint32_t s = 0; s < l.stages; ++s)
            for (uint32_t i = 0; i < l.stage[s].nodes; ++i)
                for (uint32_t t = 0; t < l.stage[s].terms; ++t)
                    nodes[l.stage[s].firstNode + i] +=
                        nodes[number(BakeSection::terms,
                                     l.stage[s].firstTerm + t * BakeLayout::stride(l.stage[s].nodes) + i)];
        for (uint32_t c = 0; c < l.caches; ++c) caches[c] = received(c);
    }

    // Irradiance over pi.
    glm::dvec3 at(glm::dvec3 position, glm::dvec3 normal) const {
        return through(position, normal, normal, 1.0);
    }
    // Mean radiance over the lobe max(0, cos)^exponent around a direction.
    glm::dvec3 through(glm::dvec3 position, glm::dvec3 normal, glm::dvec3 direction, double exponent) const;
    // The same at a place of the light map, or, where that lies outside, of the grid.
    glm::dvec3 at(glm::dvec2 mapPlace, glm::dvec3 position, glm::dvec3 normal) const;

    const std::vector<glm::dvec3>& nodeFlux() const { return nodes; }
    const std::array<glm::dvec3, 16>& cache(uint32_t c) const { return caches[c]; }

private:
    Bake bake;
    bool hasBounces, hasEmission;
    std::vector<std::array<glm::dvec3, 16>> caches;
    std::vector<glm::dvec3> nodes;

    uint32_t number(BakeSection s, size_t i) const { return bake.section(s)[i]; }
    uint32_t surfelNumber(uint32_t kind, uint32_t i) const {
        return number(BakeSection::surfels, kind * BakeLayout::stride(bake.layout.surfels) + i);
    }
    static glm::dvec3 sound(glm::dvec3 v) {
        for (int c = 0; c < 3; ++c)
            if (!std::isfinite(v[c])) return glm::dvec3(0.0);
        return glm::clamp(v, 0.0, 65504.0);
    }

    glm::dvec3 irradiance(uint32_t cache, const std::array<double, 16>& y) const {
        glm::dvec3 sum(0.0);
        for (uint32_t i = 0; i < bake.layout.coefficients(); ++i)
            sum += caches[cache][i] * y[i] * (i < 1 ? 1.0 : i < 4 ? 2.0 / 3.0 : i < 9 ? 0.25 : 0.0);
        return sum;
    }

    glm::dvec3 sentBy(uint32_t i, const std::vector<float>& light) const {
        const size_t stride = BakeLayout::stride(bake.layout.surfels);
        glm::dvec3 received = sound({light[i], light[stride + i], light[2 * stride + i]});
        if (hasBounces)
            received +=
                at({floatOf(surfelNumber(0, i)), floatOf(surfelNumber(1, i)), floatOf(surfelNumber(2, i))},
                   unpackOctahedral(surfelNumber(3, i)));
        glm::dvec3 radiance = glm::dvec3(unpackAlbedo(surfelNumber(5, i))) * received;
        if (hasEmission) radiance += glm::dvec3(unpackEmission(surfelNumber(6, i)));
        return sound(radiance) * double(floatOf(surfelNumber(4, i)));
    }

    std::array<glm::dvec3, 16> received(uint32_t c) const {
        const BakeLayout& l = bake.layout;
        const uint32_t count = l.coefficients();
        std::array<glm::dvec3, 16> sum{};
        for (uint32_t j = 0; j < l.links; ++j) {
            const glm::dvec3 light =
                nodes[number(BakeSection::linkNodes, BakeLayout::ofCache(c, j, l.links))] *
                double(floatOf(number(BakeSection::linkFactors, BakeLayout::ofCache(c, j, l.links))));
            sum[0] += light;
            for (uint32_t i = 1; i < count; ++i) sum[i] += light * shapeOf(c, j, i);
        }
        return sum;
    }
    // Coefficient i over coefficient 0.
    double shapeOf(uint32_t c, uint32_t link, uint32_t i) const {
        const BakeLayout& l = bake.layout;
        const uint32_t words = l.shapeWords();
        const auto word = [&](uint32_t w) {
            return number(BakeSection::linkShapes, BakeLayout::ofCache(c, link * words + w, l.links * words));
        };
        if (l.linkForm == LinkForm::direction) {
            const auto y = harmonics(glm::dvec3(unpackOctahedral(word(0))));
            return y[i] / y[0];
        }
        const uint32_t bits = l.bands == 2 ? 10 : 8, inWord = l.bands == 2 ? 3 : 4;
        const int32_t shifted = int32_t(word((i - 1) / inWord) << (32 - bits - (i - 1) % inWord * bits));
        const double band = std::floor(std::sqrt(double(i)));
        return std::sqrt(2.0 * band + 1.0) * (shifted >> (32 - bits)) / double((1 << (bits - 1)) - 1);
    }

    static std::array<double, 16> harmonics(glm::dvec3 d) {
        const double pi = 3.14159265358979323846, x = d.x, y = d.y, z = d.z;
        const double k1 = std::sqrt(3.0 / (4.0 * pi)), k2 = std::sqrt(15.0 / (4.0 * pi));
        const double k3 = std::sqrt(35.0 / (32.0 * pi)), k4 = std::sqrt(21.0 / (32.0 * pi));
        return {std::sqrt(1.0 / (4.0 * pi)),
                k1 * y,
                k1 * z,
                k1 * x,
                k2 * x * y,
                k2 * y * z,
                std::sqrt(5.0 / (16.0 * pi)) * (3.0 * z * z - 1.0),
                k2 * x * z,
                0.5 * k2 * (x * x - y * y),
                k3 * y * (3.0 * x * x - y * y),
                std::sqrt(105.0 / (4.0 * pi)) * x * y * z,
                k4 * y * (5.0 * z * z - 1.0),
                std::sqrt(7.0 / (16.0 * pi)) * z * (5.0 * z * z - 3.0),
                k4 * x * (5.0 * z * z - 1.0),
                std::sqrt(105.0 / (16.0 * pi)) * z * (x * x - y * y),
                k3 * x * (x * x - 3.0 * y * y)};
    }
    std::array<double, 8> visibility(const uint32_t* cell, glm::dvec3 local, glm::dvec3 normal) const;
};

// Up to a factor of all eight.
inline std::array<double, 8> CompositionModel::visibility(const uint32_t* cell, glm::dvec3 local,
                                                          glm::dvec3 normal) const {
    std::array<double, 8> seen;
    seen.fill(1e-3);
    for (uint32_t r = cell[9]; r < cell[9] + cell[10]; ++r) {
        const uint32_t place = number(BakeSection::receivers, 4 * r);
        const glm::dvec3 n(unpackOctahedral(number(BakeSection::receivers, 4 * r + 1)));
        const glm::dvec3 apart =
            local - (glm::dvec3(place & 1023, place >> 10 & 1023, place >> 20 & 1023) * 3.0 / 1023.0 - 1.0);
        const double facing = std::max(glm::dot(n, normal), 0.0), height = glm::dot(n, apart);
        const double spread = 1.0 + glm::dot(apart, apart) / (0.35 * 0.35),
                     off = 1.0 + height * height / 0.01;
        for (uint32_t k = 0; k < 8; ++k) {
            const uint32_t share = number(BakeSection::receivers, 4 * r + 2 + k / 4) >> (8 * (k % 4)) & 255;
            seen[k] += facing * facing / (spread * spread * off) * share / 255.0;
        }
    }
    return seen;
}

inline glm::dvec3 CompositionModel::through(glm::dvec3 position, glm::dvec3 normal, glm::dvec3 direction,
                                            double exponent) const {
    const BakeLayout& l = bake.layout;
    const glm::dvec3 at = (position - glm::dvec3(l.origin)) / double(l.spacing);
    // In the cell before a wall that lies in a plane of the grid.
    const glm::dvec3 before = at + normal / 32.0;
    const glm::uvec3 whole(glm::clamp(before, glm::dvec3(0.0), glm::dvec3(4u * l.bricks) - 0.5));
    const glm::uvec3 brick = whole / 4u, within = whole % 4u;
    const uint32_t filled =
        number(BakeSection::bricks, (brick.z * l.bricks.y + brick.y) * l.bricks.x + brick.x);
    const uint32_t cellNumber =
        number(BakeSection::brickCells, 64 * filled + (within.z * 4 + within.y) * 4 + within.x);
    const uint32_t* cell = &bake.section(BakeSection::cells)[12 * cellNumber];
    const glm::dvec3 local = at - glm::dvec3(cell[8] & 1023u, cell[8] >> 10 & 1023u, cell[8] >> 20 & 1023u);
    const glm::dvec3 f = glm::clamp(local, 1e-5, 1.0 - 1e-5);
    const auto seen = visibility(cell, local, normal);
    const auto y = harmonics(direction);
    const double n = exponent, first = (n + 1.0) / (n + 2.0);
    const double factors[] = {1.0, first, n / (n + 3.0), first * (n - 1.0) / (n + 4.0)};
    std::array<double, 8> weights{};
    double total = 0.0;
    for (uint32_t k = 0; k < 8; ++k) {
        if (cell[k] == 0xffffffffu) continue;
        const glm::dvec3 place(floatOf(number(BakeSection::places, 4 * cell[k])),
                               floatOf(number(BakeSection::places, 4 * cell[k] + 1)),
                               floatOf(number(BakeSection::places, 4 * cell[k] + 2)));
        const double trilinear = (k & 1 ? f.x : 1 - f.x) * (k & 2 ? f.y : 1 - f.y) * (k & 4 ? f.z : 1 - f.z);
        const double t = std::clamp(glm::dot(normal, place - position) / double(l.spacing) / 0.25, 5e-4, 1.0);
        total += weights[k] = trilinear * seen[k] * t * t * (3.0 - 2.0 * t);
    }
    glm::dvec3 sum(0.0);
    double kept = 0.0;
    for (uint32_t k = 0; k < 8; ++k) {
        if (weights[k] <= 1e-4 * total) continue;
        glm::dvec3 radiance(0.0);
        for (uint32_t i = 0; i < l.coefficients(); ++i)
            radiance += caches[cell[k]][i] * y[i] * factors[i < 1 ? 0 : i < 4 ? 1 : i < 9 ? 2 : 3];
        sum += radiance * weights[k];
        kept += weights[k];
    }
    return glm::max(kept > 0.0 ? sum / kept : glm::dvec3(0.0), 0.0);
}

inline glm::dvec3 CompositionModel::at(glm::dvec2 mapPlace, glm::dvec3 position, glm::dvec3 normal) const {
    const glm::dvec2 size(bake.layout.mapSize);
    if (!(mapPlace.x >= 0.5 && mapPlace.y >= 0.5 && mapPlace.x <= size.x - 0.5 && mapPlace.y <= size.y - 0.5))
        return at(position, normal);
    const auto y = harmonics(normal);
    glm::dvec3 sum(0.0);
    for (uint32_t row = 0; row < bake.layout.mapSize.y; ++row)
        for (uint32_t column = 0; column < bake.layout.mapSize.x; ++column) {
            const glm::dvec2 off = glm::abs(glm::dvec2(column, row) + 0.5 - mapPlace);
            const uint32_t cache =
                number(BakeSection::mapTexels, row * bake.layout.mapSize.x + column) & 0xffffffu;
            if (off.x >= 1.0 || off.y >= 1.0 || cache == 0xffffffu) continue;
            sum += (1.0 - off.x) * (1.0 - off.y) * irradiance(cache, y);
        }
    return glm::max(sum, 0.0);
}

} // namespace rebound::test
