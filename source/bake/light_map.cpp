// SPDX-License-Identifier: MIT
#include "light_map.hpp"

#include "light_map_packing.hpp"
#include "parallel.hpp"
#include "sequence.hpp"
#include "triangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace rebound::detail {

namespace {

// Charts of less than that many texels are left to the grid: a scene of leaves would be all texels.
constexpr double leastArea = 0.5;
// As few rounds of choosing the texels' size come so near to the wanted number of caches.
constexpr int rounds = 5;
constexpr double tooFew = 0.9, tooMany = 1.02;
constexpr double sizeStep = 1.3; // of texels, where charts do not fit into a map
// A map's width and height: coordinates are kept in steps of a 32nd of a texel, in 16 bits.
constexpr int mostTexels = int(0xffffu / BakeLayout::mapStepsOfTexel) - 1;

// Places of a chart that are asked how much they see, by so many rays each.
constexpr size_t placesAsked = 16;
constexpr uint32_t raysOfPlace = 16;
// A roof's tiles receive next to nothing of each other, but are half of a house's texels: as many caches for their area as the
// square of what they see of surfaces, but no fewer than this.
constexpr double leastDensity = 1.0 / 64.0;
constexpr double mostWidening = 2.0; // of texels, by which more charts are left to the grid

struct MappedChart {
    Chart chart;
    ChartTexels texels;
    std::array<ChartSide, 2> sides; // front, back
};

double areaOf(const BakeGeometry& geometry) {
    double area = 0.0;
    for (uint32_t t = 0; t < geometry.triangles(); ++t) area += Triangle(geometry, t).area();
    return area;
}

// Which part of what is seen from one side of a chart is surfaces; nothing where their backs are all.
double coveredShare(const Surroundings& around, const Chart& chart, float sign) {
    const size_t places = std::min(placesAsked, chart.triangles.size());
    std::vector<BakeRay> rays;
    for (size_t i = 0; i < places; ++i) {
        const Triangle triangle(around.geometry, chart.triangles[i * chart.triangles.size() / places]);
        const glm::vec3 normal = sign * glm::vec3(triangle.normal());
        // Of few triangles each has several places.
        for (size_t k = 0; k < placesAsked / places; ++k) {
            const glm::vec3 place(triangle.at(triangleFromSquare({halton(k + 1, 2), halton(k + 1, 3)})));
            for (uint32_t r = 0; r < raysOfPlace; ++r)
                rays.push_back({place + normal * around.clearance, 0.0f,
                                cosineDirection(normal, {halton(r + 1, 2), halton(r + 1, 3)}),
                                std::numeric_limits<float>::infinity()});
        }
    }
    std::vector<BakeHit> hits(rays.size());
    around.rays.intersect(rays, hits);
    size_t met = 0, fronts = 0;
    for (size_t i = 0; i < hits.size(); ++i) {
        if (hits[i].triangle == noTriangle) continue;
        ++met;
        fronts += glm::dot(around.normalOf(hits[i].triangle), rays[i].direction) < 0.0f;
    }
    return fronts > 0 ? double(met) / double(hits.size()) : 0.0;
}

// Caches for a chart's area, over those of one that sees surfaces all around.
double densityOf(const Surroundings& around, const Chart& chart) {
    const double front = coveredShare(around, chart, 1.0f);
    // Where a front is lit, backs have what it has: what lies below tiles is seen by nobody.
    const double share = front > 0.0 ? front : coveredShare(around, chart, -1.0f);
    return std::max(share * share, leastDensity);
}

// Nothing where a chart is larger than a map.
std::optional<std::vector<MappedChart>> chartsOf(const Surroundings& around, double texel,
                                                 const BakeSettings& settings, const MapRemedies& remedies) {
    std::vector<MappedChart> mapped;
    std::vector<Chart> charts = growCharts(around.geometry, texel);
    parallelFor(
        charts.size(), settings.threads,
        [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i)
                charts[i].frame.texel = texel / std::sqrt(densityOf(around, charts[i]));
        },
        64);
    for (Chart& chart : charts)
        if (chart.area >= leastArea * std::pow(std::min(chart.frame.texel, mostWidening * texel), 2.0))
            mapped.push_back({std::move(chart), {}, {}});
    parallelFor(
        mapped.size(), settings.threads,
        [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i)
                mapped[i].texels = texelsOf(around.geometry, mapped[i].chart);
        },
        4);
    if (std::any_of(mapped.begin(), mapped.end(), [](const MappedChart& m) {
            return std::max(m.texels.size.x, m.texels.size.y) > mostTexels;
        }))
        return std::nullopt;
    parallelFor(
        2 * mapped.size(), settings.threads,
        [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i) {
                MappedChart& m = mapped[i / 2];
                m.sides[i % 2] = placeOnSide(around, m.chart, m.texels, i % 2 == 0, remedies);
            }
        },
        1);
    return mapped;
}

size_t cachesOf(const std::vector<MappedChart>& charts) {
    size_t count = 0;
    for (const MappedChart& m : charts)
        for (const ChartSide& side : m.sides) count += side.caches.size();
    return count;
}

class MapAssembly {
public:
    MapAssembly(const BakeGeometry& g, const std::vector<MappedChart>& c, const PackedRectangles& p)
        : geometry(g), charts(c), packed(p) {}

    LightMap assemble() {
        const bool anyBack = std::any_of(charts.begin(), charts.end(),
                                         [](const MappedChart& m) { return !m.sides[1].caches.empty(); });
        map.size = glm::uvec2(packed.size);
        if (anyBack) {
            map.backRow = map.size.y;
            map.size.y *= 2;
        }
        map.texels.assign(size_t(map.size.x) * map.size.y, BakeLayout::noMapTexel);
        map.corners.assign(geometry.indices.size(), BakeLayout::notInMap);
        for (size_t i = 0; i < charts.size(); ++i) add(charts[i], packed.corners[i]);
        return std::move(map);
    }

private:
    void add(const MappedChart& m, glm::ivec2 corner) {
        for (size_t s = 0; s < 2; ++s) {
            const ChartSide& side = m.sides[s];
            if (side.caches.empty()) continue;
            const uint32_t first = uint32_t(map.caches.size()), row = s == 0 ? 0 : map.backRow;
            map.caches.insert(map.caches.end(), side.caches.begin(), side.caches.end());
            for (int y = 0; y < m.texels.size.y; ++y)
                for (int x = 0; x < m.texels.size.x; ++x) {
                    const MapTexel& texel = side.texels[size_t(y) * size_t(m.texels.size.x) + size_t(x)];
                    const size_t at = (size_t(corner.y + y) + row) * map.size.x + size_t(corner.x + x);
                    const uint32_t cache =
                        texel.state == TexelState::dark ? BakeLayout::noMapCache : first + texel.cache;
                    map.texels[at] = cache | uint32_t(texel.state) << 24;
                }
        }
        for (const uint32_t triangle : m.chart.triangles) {
            const FlatTriangle flat = flatTriangle(geometry, m.chart.frame, triangle);
            for (size_t i = 0; i < 3; ++i) {
                const glm::dvec2 place = flat[i] - m.texels.origin + glm::dvec2(corner);
                const glm::uvec2 steps(glm::round(place * double(BakeLayout::mapStepsOfTexel)));
                map.corners[3 * size_t(triangle) + i] = steps.x | steps.y << 16;
            }
        }
    }

    const BakeGeometry& geometry;
    const std::vector<MappedChart>& charts;
    const PackedRectangles& packed;
    LightMap map;
};

std::optional<PackedRectangles> pack(const std::vector<MappedChart>& charts) {
    std::vector<glm::ivec2> sizes;
    for (const MappedChart& m : charts) sizes.push_back(m.texels.size);
    return packRectangles(sizes, mostTexels);
}

} // namespace

LightMap mapLight(const Surroundings& around, const BakeSettings& settings, const MapRemedies& remedies) {
    const double wanted = settings.lightMap;
    double texel = std::sqrt(areaOf(around.geometry) / wanted);
    LightMap best;
    double leastOff = std::numeric_limits<double>::infinity();
    for (int round = 0; round < rounds;) {
        const auto charts = chartsOf(around, texel, settings, remedies);
        const auto packed = charts ? pack(*charts) : std::nullopt;
        if (!packed) {
            texel *= sizeStep;
            continue;
        }
        ++round;
        const double share = double(cachesOf(*charts)) / wanted;
        if (share > 0.0 && std::abs(std::log(share)) < leastOff) {
            leastOff = std::abs(std::log(share));
            best = MapAssembly(around.geometry, *charts, *packed).assemble();
            best.texel = float(texel);
        }
        if (share >= tooFew && share <= tooMany) break;
        texel *= std::clamp(std::sqrt(share), 0.5, 2.0);
    }
    return best;
}

} // namespace rebound::detail
