// SPDX-License-Identifier: MIT
#include "poisson_discs.hpp"

#include "parallel.hpp"
#include "sequence.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace rebound::detail {

namespace {

// Chosen points by place. Cells are two radii wide, so that all within a radius lie in the eight cells around a cell's
// corner. Cells that share a list by chance cost time alone.
class DiscGrid {
public:
    DiscGrid(std::span<const SidePoint> all, float discRadius, size_t expected)
        : points(all), radius(discRadius), scale(0.5 / double(discRadius)),
          heads(std::bit_ceil(std::max<size_t>(2 * expected, 64)), none) {}

    void add(uint32_t point) {
        uint32_t& head = heads[list(glm::i64vec3(glm::floor(glm::dvec3(points[point].position) * scale)))];
        entries.push_back({points[point], head});
        head = uint32_t(entries.size()) - 1;
        chosen.push_back(point);
    }

    // Whether a chosen point is nearer than the radius.
    bool isCovered(const SidePoint& point) const {
        bool covered = false;
        visit(point, [&](uint32_t, float distance2) { return covered = distance2 < radius * radius; });
        return covered;
    }

    uint32_t nearest(const SidePoint& point) const {
        uint32_t best = 0;
        float least = std::numeric_limits<float>::infinity();
        visit(point, [&](uint32_t entry, float distance2) {
            if (distance2 < least || (distance2 == least && entry < best)) {
                best = entry;
                least = distance2;
            }
            return false;
        });
        return best;
    }

    std::vector<uint32_t> chosen;

private:
    static constexpr uint32_t none = 0xffffffffu;
    struct Entry {
        SidePoint point;
        uint32_t next;
    };

    size_t list(glm::i64vec3 cell) const {
        const uint64_t mixed = uint64_t(cell.x) * 0x9e3779b97f4a7c15ull +
                               uint64_t(cell.y) * 0xc2b2ae3d27d4eb4full +
                               uint64_t(cell.z) * 0x165667b19e3779f9ull;
        return size_t((mixed ^ (mixed >> 32)) * 0xd6e8feb86659fd93ull >> 32) & (heads.size() - 1);
    }

    // Until body(entry, squared distance) says that it is enough.
    template <class Body>
    void visit(const SidePoint& point, const Body& body) const {
        const glm::dvec3 place = glm::dvec3(point.position) * scale;
        const glm::i64vec3 own(glm::floor(place));
        const glm::i64vec3 corner(glm::floor(place - 0.5));
        const auto visitCell = [&](glm::i64vec3 cell) {
            for (uint32_t i = heads[list(cell)]; i != none; i = entries[i].next)
                if (body(i, surfaceDistance2(point, entries[i].point, radius))) return true;
            return false;
        };
        if (visitCell(own)) return;
        for (int i = 0; i < 8; ++i) {
            const glm::i64vec3 cell = corner + glm::i64vec3(i & 1, i >> 1 & 1, i >> 2);
            if (cell != own && visitCell(cell)) return;
        }
    }

    std::span<const SidePoint> points;
    float radius;
    double scale;
    std::vector<uint32_t> heads;
    std::vector<Entry> entries;
};

// Fisher, Yates. std::shuffle gives other orders in other standard libraries.
std::vector<uint32_t> shuffledNumbers(size_t count, uint64_t seed) {
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    for (size_t i = count; i > 1; --i)
        std::swap(order[i - 1], order[size_t(unit(hash(seed + i)) * double(i))]);
    return order;
}

// Dart throwing: in the order given, each that no earlier one is too near to.
DiscGrid throwDarts(std::span<const SidePoint> points, const std::vector<uint32_t>& order, float radius,
                    size_t expected) {
    DiscGrid grid(points, radius, expected);
    for (const uint32_t point : order)
        if (!grid.isCovered(points[point])) grid.add(point);
    return grid;
}

// The radius whose discs are about so many: their number falls with its square, on surfaces that are large enough.
DiscGrid fitRadius(std::span<const SidePoint> points, double area, double count, uint64_t seed,
                   float& radius) {
    const std::vector<uint32_t> order = shuffledNumbers(points.size(), seed);
    // Discs of half the radius cover about half of an area when no more fit between them.
    radius = float(std::sqrt(0.65 * area / count));
    DiscGrid best = throwDarts(points, order, radius, size_t(count));
    const auto missing = [&](const DiscGrid& grid) {
        return std::abs(std::log(double(grid.chosen.size()) / count));
    };
    constexpr double closeEnough = 0.02;
    constexpr int mostTries = 8;
    float next = radius;
    double chosen = double(best.chosen.size());
    for (int i = 0; i < mostTries && missing(best) > closeEnough; ++i) {
        next *= float(std::sqrt(chosen / count));
        DiscGrid grid = throwDarts(points, order, next, size_t(count));
        chosen = double(grid.chosen.size());
        if (missing(grid) >= missing(best)) continue;
        best = std::move(grid);
        radius = next;
    }
    return best;
}

} // namespace

PoissonDiscs choosePoissonDiscs(std::span<const SidePoint> points, double area, double count, uint64_t seed,
                                int threads) {
    PoissonDiscs result;
    DiscGrid grid = fitRadius(points, area, count, seed, result.radius);
    result.nearest.resize(points.size());
    parallelFor(points.size(), threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) result.nearest[i] = grid.nearest(points[i]);
    });
    result.chosen = std::move(grid.chosen);
    return result;
}

} // namespace rebound::detail
