// SPDX-License-Identifier: MIT
#include "light_map_texels.hpp"

#include "triangle.hpp"

#include <cmath>
#include <limits>

namespace rebound::detail {

namespace {

// Places on a chart's edge are moved into it: on the edge of a floor, half of what is seen is the wall's inside. [texels]
constexpr double inset = 0.05;
constexpr double onMiddle = 1e-6; // distances that are none [texels]
// What reaches no further into a texel need not have one. [texels]
constexpr double leastOverhang = 1e-3;

struct Candidate {
    uint32_t triangle = 0;
    glm::dvec2 barycentrics{0.0};
    double distance = std::numeric_limits<double>::infinity(); // from the texel's middle [texels]
    double height = 0.0;                                       // [texels]

    bool isBetterThan(const Candidate& other) const {
        if (distance < onMiddle && other.distance < onMiddle) return height > other.height;
        return distance < other.distance;
    }
};

class ChartRasterizer {
public:
    ChartRasterizer(const BakeGeometry& g, const Chart& c) : geometry(g), chart(c) { layOut(); }

    ChartTexels rasterize() {
        best.resize(size_t(texels.size.x) * size_t(texels.size.y));
        for (const uint32_t triangle : chart.triangles) cover(triangle);
        for (size_t i = 0; i < best.size(); ++i)
            if (std::isfinite(best[i].distance))
                texels.held.push_back(placeOf(best[i], {int(i) % texels.size.x, int(i) / texels.size.x}));
        return std::move(texels);
    }

private:
    // As many texels as it takes, and the chart in their middle.
    void layOut() {
        glm::dvec2 lower(std::numeric_limits<double>::infinity()), upper = -lower;
        for (const uint32_t triangle : chart.triangles)
            for (const glm::dvec2 corner : flatTriangle(geometry, chart.frame, triangle)) {
                lower = glm::min(lower, corner);
                upper = glm::max(upper, corner);
            }
        const glm::dvec2 extent = upper - lower;
        const glm::dvec2 inner = glm::max(glm::ceil(extent - leastOverhang), glm::dvec2(1.0));
        texels.size = glm::ivec2(inner) + 2;
        texels.origin = lower - 0.5 * (inner - extent) - 1.0;
    }

    FlatTriangle inTexels(uint32_t triangle) const {
        FlatTriangle flat = flatTriangle(geometry, chart.frame, triangle);
        for (glm::dvec2& corner : flat) corner -= texels.origin;
        return flat;
    }

    void cover(uint32_t number) {
        const Triangle triangle(geometry, number);
        const FlatTriangle flat = inTexels(number);
        const TexelRange range = texelsAround(flat, 0.0);
        const glm::ivec2 first = glm::max(range.first, glm::ivec2(0));
        const glm::ivec2 last = glm::min(range.last, texels.size - 1);
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const glm::dvec2 centre = glm::dvec2(x, y) + 0.5;
                Candidate c{number, nearestOn(flat, centre), 0.0, 0.0};
                const glm::dvec2 off = at(flat, c.barycentrics) - centre;
                if (std::max(std::abs(off.x), std::abs(off.y)) > 0.5) continue;
                c.distance = glm::length(off);
                c.height = chart.frame.height(triangle.at(c.barycentrics));
                Candidate& known = best[size_t(y) * size_t(texels.size.x) + size_t(x)];
                if (c.isBetterThan(known)) known = c;
            }
    }

    TexelPlace placeOf(const Candidate& c, glm::ivec2 texel) const {
        const Triangle triangle(geometry, c.triangle);
        glm::dvec3 position = triangle.at(c.barycentrics);
        if (c.distance >= onMiddle) {
            const glm::dvec3 inwards = triangle.at(glm::dvec2(1.0 / 3.0)) - position;
            const double way = glm::length(inwards);
            if (way > 0.0) position += inwards * std::min(inset * chart.frame.texel / way, 0.5);
        }
        return {texel, glm::vec3(position), glm::vec3(triangle.normal())};
    }

    const BakeGeometry& geometry;
    const Chart& chart;
    ChartTexels texels;
    std::vector<Candidate> best; // by texel
};

} // namespace

ChartTexels texelsOf(const BakeGeometry& geometry, const Chart& chart) {
    return ChartRasterizer(geometry, chart).rasterize();
}

} // namespace rebound::detail
