// SPDX-License-Identifier: MIT
#include "light_map_charts.hpp"

#include "triangle.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <unordered_map>

namespace rebound::detail {

namespace {

// Cosine of 37 degrees: areas are kept to a fifth, and a column is five charts.
constexpr double leastCosine = 0.8;
// Slopes up to that cosine rise by 0.75 from texel to texel; what lies further apart is another layer. [texels]
constexpr double layerDistance = 2.0;
// Charts of less than that many texels are joined to one beside that is turned by less than 70 degrees.
constexpr double smallArea = 1.0;
constexpr double leastJoinedCosine = 0.35;
constexpr uint32_t noChart = 0xffffffffu;
// Edges that more triangles share are no surface whose sides go on from each other.
constexpr size_t mostAtEdge = 8;

// Neighbours of each triangle, one list behind the other.
struct Adjacency {
    std::vector<uint32_t> first; // of a triangle, and all
    std::vector<uint32_t> neighbours;
};

// Numbers that are equal where positions are: files repeat a vertex for each of its normals.
std::vector<uint32_t> weld(const BakeGeometry& geometry) {
    const auto& p = geometry.positions;
    std::vector<uint32_t> order(p.size()), number(p.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto before = [&](uint32_t a, uint32_t b) {
        for (int k = 0; k < 3; ++k)
            if (p[a][k] != p[b][k]) return p[a][k] < p[b][k];
        return false;
    };
    // Positions that triangles do not use need not be numbers.
    std::erase_if(order, [&](uint32_t i) { return !std::isfinite(p[i].x + p[i].y + p[i].z); });
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b) { return before(a, b) || (!before(b, a) && a < b); });
    for (size_t i = 0; i < order.size(); ++i)
        number[order[i]] = i > 0 && !before(order[i - 1], order[i]) ? number[order[i - 1]] : order[i];
    return number;
}

struct Edge {
    uint32_t low, high, triangle;
    bool rises; // from low to high, in the order of the triangle's corners
};

std::vector<Edge> edgesOf(const BakeGeometry& geometry) {
    const std::vector<uint32_t> vertex = weld(geometry);
    std::vector<Edge> edges;
    edges.reserve(geometry.indices.size());
    for (uint32_t t = 0; t < geometry.triangles(); ++t)
        for (uint32_t i = 0; i < 3; ++i) {
            const uint32_t a = vertex[geometry.indices[3 * t + i]];
            const uint32_t b = vertex[geometry.indices[3 * t + (i + 1) % 3]];
            if (a != b) edges.push_back({std::min(a, b), std::max(a, b), t, a < b});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        if (a.low != b.low) return a.low < b.low;
        return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
    });
    return edges;
}

// Triangles that go on from each other across an edge with the same side up.
Adjacency neighboursOf(const BakeGeometry& geometry) {
    const std::vector<Edge> edges = edgesOf(geometry);
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    for (size_t first = 0; first < edges.size();) {
        size_t last = first + 1;
        while (last < edges.size() && edges[last].low == edges[first].low &&
               edges[last].high == edges[first].high)
            ++last;
        if (last - first <= mostAtEdge)
            for (size_t a = first; a < last; ++a)
                for (size_t b = first; b < last; ++b)
                    if (edges[a].rises != edges[b].rises)
                        pairs.push_back({edges[a].triangle, edges[b].triangle});
        first = last;
    }
    std::sort(pairs.begin(), pairs.end());
    Adjacency adjacency;
    adjacency.first.assign(geometry.triangles() + 1, 0);
    for (const auto& [triangle, neighbour] : pairs) {
        ++adjacency.first[triangle + 1];
        adjacency.neighbours.push_back(neighbour);
    }
    std::partial_sum(adjacency.first.begin(), adjacency.first.end(), adjacency.first.begin());
    return adjacency;
}

// Along the side of middle length, a right triangle's longer leg: quads lie straight.
ChartFrame frameOf(const Triangle& triangle, double texel) {
    std::array<glm::dvec3, 3> sides;
    for (size_t i = 0; i < 3; ++i) sides[i] = triangle.corner[(i + 1) % 3] - triangle.corner[i];
    std::stable_sort(sides.begin(), sides.end(),
                     [](glm::dvec3 a, glm::dvec3 b) { return glm::dot(a, a) < glm::dot(b, b); });
    const glm::dvec3 along = sides[1];
    ChartFrame frame;
    frame.normal = triangle.normal();
    frame.right = glm::normalize(along - frame.normal * glm::dot(frame.normal, along));
    frame.up = glm::cross(frame.normal, frame.right);
    frame.texel = texel;
    return frame;
}

class ChartGrower {
public:
    ChartGrower(const BakeGeometry& g, double texelWidth)
        : geometry(g), texel(texelWidth), adjacency(neighboursOf(g)), areas(g.triangles()),
          taken(g.triangles()) {
        for (uint32_t t = 0; t < g.triangles(); ++t) areas[t] = Triangle(g, t).area();
    }

    std::vector<Chart> grow() {
        std::vector<uint32_t> seeds(areas.size());
        std::iota(seeds.begin(), seeds.end(), 0u);
        std::stable_sort(seeds.begin(), seeds.end(),
                         [&](uint32_t a, uint32_t b) { return areas[a] > areas[b]; });
        std::vector<Chart> charts;
        for (const uint32_t seed : seeds)
            if (!taken[seed] && areas[seed] > 0.0) charts.push_back(growFrom(seed));
        return joined(std::move(charts));
    }

private:
    // Small charts, smallest first, go to the chart beside that faces most alike: a fold of a curtain, a strip of a moulding.
    // What is turned by less than a right angle lies beyond the edge that both share, and is less than a texel.
    std::vector<Chart> joined(std::vector<Chart> charts) const {
        std::vector<uint32_t> chartOf(areas.size(), noChart);
        for (uint32_t c = 0; c < charts.size(); ++c)
            for (const uint32_t triangle : charts[c].triangles) chartOf[triangle] = c;
        std::vector<uint32_t> order(charts.size());
        std::iota(order.begin(), order.end(), 0u);
        std::stable_sort(order.begin(), order.end(),
                         [&](uint32_t a, uint32_t b) { return charts[a].area < charts[b].area; });
        for (const uint32_t c : order) {
            if (charts[c].area >= smallArea * texel * texel) break;
            const uint32_t other = bestBeside(charts, chartOf, c);
            if (other == noChart) continue;
            for (const uint32_t triangle : charts[c].triangles) chartOf[triangle] = other;
            Chart& to = charts[other];
            to.triangles.insert(to.triangles.end(), charts[c].triangles.begin(), charts[c].triangles.end());
            to.area += charts[c].area;
            charts[c].triangles.clear();
        }
        std::erase_if(charts, [](const Chart& chart) { return chart.triangles.empty(); });
        return charts;
    }

    uint32_t bestBeside(const std::vector<Chart>& charts, const std::vector<uint32_t>& chartOf,
                        uint32_t c) const {
        std::vector<uint32_t> beside;
        for (const uint32_t triangle : charts[c].triangles)
            for (uint32_t i = adjacency.first[triangle]; i < adjacency.first[triangle + 1]; ++i)
                if (const uint32_t other = chartOf[adjacency.neighbours[i]]; other != noChart && other != c)
                    beside.push_back(other);
        std::sort(beside.begin(), beside.end());
        beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
        uint32_t best = noChart;
        double bestCosine = leastJoinedCosine;
        for (const uint32_t other : beside) {
            // Of all its triangles, not of the one at the edge alone.
            double cosine = 1.0;
            for (const uint32_t triangle : charts[c].triangles)
                cosine = std::min(
                    cosine, glm::dot(charts[other].frame.normal, Triangle(geometry, triangle).normal()));
            if (cosine > bestCosine) {
                best = other;
                bestCosine = cosine;
            }
        }
        return best;
    }

    Chart growFrom(uint32_t seed) {
        Chart chart;
        chart.frame = frameOf(Triangle(geometry, seed), texel);
        heights.clear();
        std::deque<uint32_t> open{seed};
        while (!open.empty()) {
            const uint32_t triangle = open.front();
            open.pop_front();
            if (taken[triangle] || !facesAlike(triangle, chart.frame) || !isOneLayer(triangle, chart.frame))
                continue;
            taken[triangle] = 1;
            chart.triangles.push_back(triangle);
            chart.area += areas[triangle];
            for (const auto& [place, height] : covered) heights.insert({place, height});
            for (uint32_t i = adjacency.first[triangle]; i < adjacency.first[triangle + 1]; ++i)
                if (!taken[adjacency.neighbours[i]]) open.push_back(adjacency.neighbours[i]);
        }
        return chart;
    }

    bool facesAlike(uint32_t triangle, const ChartFrame& frame) const {
        if (!(areas[triangle] > 0.0)) return false;
        return glm::dot(Triangle(geometry, triangle).normal(), frame.normal) >= leastCosine;
    }

    // Leaves in `covered` what the triangle covers: texels whose middle is in it, and the one of its own middle.
    bool isOneLayer(uint32_t number, const ChartFrame& frame) {
        const Triangle triangle(geometry, number);
        const FlatTriangle flat = flatTriangle(geometry, frame, number);
        covered.clear();
        const auto cover = [&](glm::ivec2 place, glm::dvec2 barycentrics) {
            const uint64_t key = uint64_t(uint32_t(place.x)) << 32 | uint32_t(place.y);
            const double height = frame.height(triangle.at(barycentrics));
            covered.push_back({key, height});
            const auto found = heights.find(key);
            return found == heights.end() || std::abs(found->second - height) < layerDistance;
        };
        const glm::dvec2 middle(1.0 / 3.0);
        if (!cover(glm::ivec2(glm::floor(at(flat, middle))), middle)) return false;
        const TexelRange range = texelsAround(flat, 0.0);
        for (int y = range.first.y; y <= range.last.y; ++y)
            for (int x = range.first.x; x <= range.last.x; ++x) {
                const glm::dvec2 centre = glm::dvec2(x, y) + 0.5;
                const glm::dvec2 nearest = nearestOn(flat, centre);
                if (glm::distance(at(flat, nearest), centre) < 1e-6 && !cover({x, y}, nearest)) return false;
            }
        return true;
    }

    const BakeGeometry& geometry;
    double texel;
    Adjacency adjacency;
    std::vector<double> areas; // by triangle [m^2]
    std::vector<uint8_t> taken;
    std::unordered_map<uint64_t, double> heights; // of the chart, by texel [texels]
    std::vector<std::pair<uint64_t, double>> covered;
};

} // namespace

FlatTriangle flatTriangle(const BakeGeometry& geometry, const ChartFrame& frame, uint32_t number) {
    const Triangle triangle(geometry, number);
    return {frame.flat(triangle.corner[0]), frame.flat(triangle.corner[1]), frame.flat(triangle.corner[2])};
}

// Ericson: Real-Time Collision Detection, section 5.1.5.
glm::dvec2 nearestOn(const FlatTriangle& t, glm::dvec2 point) {
    const glm::dvec2 ab = t[1] - t[0], ac = t[2] - t[0], ap = point - t[0];
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0) return {0, 0};
    const glm::dvec2 bp = point - t[1];
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3) return {1, 0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {d1 / (d1 - d3), 0};
    const glm::dvec2 cp = point - t[2];
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6) return {0, 1};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {0, d2 / (d2 - d6)};
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {1.0 - w, w};
    }
    return glm::dvec2(vb, vc) / (va + vb + vc);
}

glm::dvec2 at(const FlatTriangle& t, glm::dvec2 barycentrics) {
    return t[0] + (t[1] - t[0]) * barycentrics.x + (t[2] - t[0]) * barycentrics.y;
}

TexelRange texelsAround(const FlatTriangle& t, double margin) {
    const glm::dvec2 lower = glm::min(glm::min(t[0], t[1]), t[2]) - margin;
    const glm::dvec2 upper = glm::max(glm::max(t[0], t[1]), t[2]) + margin;
    return {glm::ivec2(glm::floor(lower)), glm::ivec2(glm::floor(upper))};
}

std::vector<Chart> growCharts(const BakeGeometry& geometry, double texel) {
    return ChartGrower(geometry, texel).grow();
}

} // namespace rebound::detail
