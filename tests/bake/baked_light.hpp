// SPDX-License-Identifier: MIT
// What a bake says of light, read from its sections in plain loops and double precision.
#pragma once

#include "rebound/bake/bake.hpp"
#include "rebound/bake/packing.hpp"
#include "rebound/math/spherical_harmonics.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

class BakedLight {
public:
    using Coefficients = std::array<double, 16>;

    // radiance: of surfels, by position and normal.
    BakedLight(const rebound::Bake& b, const std::function<double(glm::vec3, glm::vec3)>& radiance)
        : bake(b), layout(b.layout) {
        const auto surfels = section(rebound::BakeSection::surfels);
        const size_t stride = rebound::BakeLayout::stride(layout.surfels);
        flux.assign(layout.nodes + 1, 0.0);
        for (size_t i = 0; i < layout.surfels; ++i) {
            const auto number = [&](size_t k) { return std::bit_cast<float>(surfels[k * stride + i]); };
            const glm::vec3 position(number(0), number(1), number(2));
            flux[i] =
                double(number(4)) * radiance(position, rebound::unpackOctahedral(surfels[3 * stride + i]));
        }
        for (uint32_t s = 0; s < layout.stages; ++s) {
            const rebound::BakeStage& stage = layout.stage[s];
            for (uint32_t n = 0; n < stage.nodes; ++n)
                for (uint32_t t = 0; t < stage.terms; ++t)
                    flux[stage.firstNode + n] += flux[section(
                        rebound::BakeSection::terms)[stage.firstTerm +
                                                     t * rebound::BakeLayout::stride(stage.nodes) + n]];
        }
    }

    glm::vec3 place(size_t cache) const {
        const auto places = section(rebound::BakeSection::places);
        glm::vec3 position;
        for (int k = 0; k < 3; ++k) position[k] = std::bit_cast<float>(places[4 * cache + size_t(k)]);
        return position;
    }

    // Of the radiance that arrives at a cache.
    Coefficients atCache(size_t cache) const {
        Coefficients sum{};
        for (size_t link = 0; link < layout.links; ++link) {
            const size_t at = rebound::BakeLayout::ofCache(cache, link, layout.links);
            const double c0 = double(std::bit_cast<float>(section(rebound::BakeSection::linkFactors)[at]));
            const double light = flux[section(rebound::BakeSection::linkNodes)[at]] * c0;
            sum[0] += light;
            for (size_t i = 1; i < layout.coefficients(); ++i) sum[i] += light * shape(link, cache, i);
        }
        return sum;
    }

    // Irradiance over pi of a receiver, by what its cell says of its caches: their trilinear weights times their
    // visibility from the baked receivers around.
    double atReceiver(glm::vec3 position, glm::vec3 normal) const {
        const glm::vec3 at = (position - layout.origin) / layout.spacing;
        const size_t cell = cellAt(at + normal / 32.0f);
        const auto cells = section(rebound::BakeSection::cells);
        const glm::vec3 local = at - glm::vec3(unpackPlace(cells[12 * cell + 8]));
        const std::array<double, 8> seen = visibility(cell, local, normal);
        const glm::vec3 share = glm::clamp(local, 0.0f, 1.0f);
        double sum = 0.0, total = 0.0;
        for (size_t corner = 0; corner < 8; ++corner) {
            const uint32_t cache = cells[12 * cell + corner];
            if (cache == 0xffffffffu) continue;
            double weight = seen[corner] + 1e-9;
            for (int axis = 0; axis < 3; ++axis)
                weight *= double((corner >> axis & 1) ? share[axis] : 1.0f - share[axis]) + 1e-5;
            const double height = double(glm::dot(normal, place(cache) - position) / layout.spacing);
            weight *= std::clamp(height / 0.25, 1e-6, 1.0);
            sum += weight * irradiance(atCache(cache), normal);
            total += weight;
        }
        return total > 0.0 ? sum / total : 0.0;
    }

    // Irradiance over pi at a place of the light map [texels]: between the middles of four texels.
    double atMap(glm::dvec2 place, glm::vec3 normal) const {
        const glm::dvec2 first = glm::floor(place - 0.5), share = place - 0.5 - first;
        double sum = 0.0;
        for (int corner = 0; corner < 4; ++corner) {
            const uint32_t texel = mapTexel(glm::ivec2(first) + glm::ivec2(corner & 1, corner >> 1));
            const uint32_t cache = texel & rebound::BakeLayout::noMapCache;
            if (cache == rebound::BakeLayout::noMapCache) continue;
            sum += ((corner & 1) ? share.x : 1.0 - share.x) * ((corner >> 1) ? share.y : 1.0 - share.y) *
                   irradiance(atCache(cache), normal);
        }
        return sum;
    }
    uint32_t mapTexel(glm::ivec2 texel) const {
        return section(rebound::BakeSection::mapTexels)[size_t(texel.y) * layout.mapSize.x + size_t(texel.x)];
    }
    // Where a triangle's place lies in the map, as a front side [texels]. Precondition: it is in the map.
    glm::dvec2 mapPlace(uint32_t triangle, glm::dvec2 barycentrics) const {
        const auto corner = [&](size_t i) {
            const uint32_t packed = section(rebound::BakeSection::mapCorners)[3 * size_t(triangle) + i];
            return glm::dvec2(packed & 0xffffu, packed >> 16) / double(rebound::BakeLayout::mapStepsOfTexel);
        };
        return corner(0) + (corner(1) - corner(0)) * barycentrics.x +
               (corner(2) - corner(0)) * barycentrics.y;
    }
    bool isInMap(uint32_t triangle) const {
        return section(rebound::BakeSection::mapCorners)[3 * size_t(triangle)] !=
               rebound::BakeLayout::notInMap;
    }

    static double irradiance(const Coefficients& light, glm::vec3 normal) {
        const rebound::host::Harmonics lobe = rebound::host::lobe(normal, 1.0f);
        double sum = 0.0;
        for (size_t i = 0; i < 16; ++i) sum += light[i] * double(lobe.value[i]);
        return sum;
    }

    std::span<const uint32_t> section(rebound::BakeSection s) const { return bake.section(s); }

    size_t cellAt(glm::vec3 at) const {
        const glm::uvec3 bricks = layout.bricks;
        const glm::uvec3 c(glm::clamp(at, glm::vec3(0.0f), glm::vec3(4u * bricks) - 0.5f));
        const uint32_t brick =
            section(rebound::BakeSection::bricks)[c.x / 4 + bricks.x * (c.y / 4 + bricks.y * (c.z / 4))];
        return section(
            rebound::BakeSection::brickCells)[64 * brick + c.x % 4 + 4 * (c.y % 4) + 16 * (c.z % 4)];
    }

    static glm::uvec3 unpackPlace(uint32_t packed) {
        return {packed & 1023u, packed >> 10 & 1023u, packed >> 20};
    }

private:
    double shape(size_t link, size_t cache, size_t i) const {
        const uint32_t bits = layout.bands == 2 ? 10 : 8, ofWord = 32 / bits;
        const uint32_t word = uint32_t(i - 1) / ofWord, first = bits * (uint32_t(i - 1) % ofWord);
        const uint32_t packed = section(rebound::BakeSection::linkShapes)[rebound::BakeLayout::ofCache(
            cache, link * layout.shapeWords() + word, layout.links * layout.shapeWords())];
        const int32_t number = int32_t(packed << (32 - bits - first)) >> (32 - bits);
        const double band = i < 4 ? 1.0 : i < 9 ? 2.0 : 3.0;
        return number / double((1 << (bits - 1)) - 1) * std::sqrt(2.0 * band + 1.0);
    }

    std::array<double, 8> visibility(size_t cell, glm::vec3 local, glm::vec3 normal) const {
        const auto cells = section(rebound::BakeSection::cells);
        const auto receivers = section(rebound::BakeSection::receivers);
        std::array<double, 8> seen;
        seen.fill(1e-3);
        double total = 1e-3;
        for (size_t r = cells[12 * cell + 9]; r < cells[12 * cell + 9] + cells[12 * cell + 10]; ++r) {
            const glm::vec3 stands = glm::vec3(unpackPlace(receivers[4 * r])) * (3.0f / 1023.0f) - 1.0f;
            const glm::vec3 facing = rebound::unpackOctahedral(receivers[4 * r + 1]);
            const double cosine = std::max(double(glm::dot(facing, normal)), 0.0);
            const double distance2 = double(glm::dot(local - stands, local - stands));
            const double height = double(glm::dot(local - stands, facing));
            const double weight =
                cosine * cosine /
                (std::pow(1.0 + distance2 / (0.35 * 0.35), 2.0) * (1.0 + height * height / 0.01));
            total += weight;
            for (size_t c = 0; c < 8; ++c)
                seen[c] += weight * double(receivers[4 * r + 2 + c / 4] >> (8 * (c % 4)) & 255u) / 255.0;
        }
        for (double& s : seen) s /= total;
        return seen;
    }

    const rebound::Bake& bake;
    rebound::BakeLayout layout;
    std::vector<double> flux; // over pi: radiance times area
};
