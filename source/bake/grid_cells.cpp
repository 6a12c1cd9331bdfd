// SPDX-License-Identifier: MIT
#include "grid_cells.hpp"

#include "parallel.hpp"
#include "sequence.hpp"
#include "surface_samples.hpp"
#include "triangle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace rebound::detail {

namespace {

// Beyond the geometry's box on each side: no surface lies on the grid's border. [spacings]
constexpr float padding = 0.25f;
constexpr uint64_t mostSamples = 1u << 23;
// About as many corners belong to a piece of surface of one spacing's side; those of the cells before and behind it.
constexpr double cornersOfSurface = 2.0;
constexpr double samplesOfCorner = 16.0;
constexpr double leastRoom = 0.15; // before a receiver, in some direction at least [spacings]
constexpr uint32_t raysOfSide = 8;

double areaOf(const BakeGeometry& geometry) {
    double area = 0.0;
    for (uint32_t t = 0; t < geometry.triangles(); ++t) area += Triangle(geometry, t).area();
    return area;
}

struct Box {
    glm::vec3 lower{std::numeric_limits<float>::infinity()}, upper{-std::numeric_limits<float>::infinity()};
    glm::vec3 size() const { return upper - lower; }
};

Box boxOf(const BakeGeometry& geometry) {
    Box box;
    for (const uint32_t index : geometry.indices) {
        box.lower = glm::min(box.lower, geometry.positions[index]);
        box.upper = glm::max(box.upper, geometry.positions[index]);
    }
    return box;
}

glm::dvec3 cellsWanted(const Box& box, double spacing, double shift) {
    return glm::ceil(glm::dvec3(box.size()) / spacing + 2.0 * (double(padding) + shift));
}

// In the middle of the box, so that walls that face each other are treated alike.
Lattice latticeOver(const Box& box, float spacing, float shift) {
    Lattice lattice;
    lattice.spacing = spacing;
    lattice.cells = glm::uvec3(cellsWanted(box, spacing, std::abs(shift)));
    const glm::vec3 middle = 0.5f * (box.lower + box.upper);
    lattice.origin = middle - spacing * (0.5f * glm::vec3(lattice.cells) - shift);
    return lattice;
}

void keepUnique(std::vector<LatticeKey>& keys) {
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

// Cells before the samples. Two offsets, half and one and a half times the receivers' own: those of receivers whose positions
// are not exact.
std::vector<LatticeKey> litCells(const Lattice& lattice, const std::vector<SurfaceSide>& sides) {
    std::vector<LatticeKey> keys;
    for (const SurfaceSide& side : sides)
        for (const float offset : {0.5f * receiverOffset, 1.5f * receiverOffset}) {
            const LatticeKey key =
                latticeKey(lattice.cellAt(side.position + side.normal * (offset * lattice.spacing)));
            if (keys.empty() || keys.back() != key) keys.push_back(key);
        }
    keepUnique(keys);
    return keys;
}

std::vector<LatticeKey> allCornersOf(const std::vector<LatticeKey>& cells) {
    std::vector<LatticeKey> keys;
    keys.reserve(8 * cells.size());
    for (const LatticeKey cell : cells)
        for (uint32_t c = 0; c < 8; ++c)
            keys.push_back(latticeKey(latticePlace(cell) + glm::uvec3(c & 1, c >> 1 & 1, c >> 2)));
    keepUnique(keys);
    return keys;
}

GridCells cellsWith(const Box& box, const ReceivingSides& surfaces, float spacing, float shift) {
    GridCells grid;
    grid.lattice = latticeOver(box, spacing, shift);
    grid.cells = litCells(grid.lattice, surfaces.sides);
    grid.corners = allCornersOf(grid.cells);
    return grid;
}

// A corner takes one more place along each axis than cells do.
bool fitsKeys(const Box& box, double spacing, double shift) {
    const glm::dvec3 cells = cellsWanted(box, spacing, std::abs(shift));
    return std::max({cells.x, cells.y, cells.z}) <= double(maximumLatticePlace);
}

// Before it is known which sides are lit.
double expectedSpacing(const BakeGeometry& geometry, const BakeSettings& settings) {
    if (settings.spacing > 0.0f) return double(settings.spacing);
    return std::sqrt(cornersOfSurface * areaOf(geometry) / settings.caches);
}

size_t samplesFor(const BakeGeometry& geometry, const BakeSettings& settings) {
    const double spacing = expectedSpacing(geometry, settings);
    const double caches =
        std::min(double(settings.caches), cornersOfSurface * areaOf(geometry) / (spacing * spacing));
    constexpr double fewest = 4096.0; // a scene of few caches has small surfaces too
    return size_t(std::clamp(samplesOfCorner * caches, fewest, double(mostSamples)));
}

// For each side 1 where there is room before it. Between surfaces that touch, or the two sides of a doubled wall, nobody
// looks, and no cache would find a place.
std::vector<uint8_t> findRoom(const BakeGeometry& geometry, const RayCaster& caster,
                              const std::vector<SurfaceSide>& sides, float distance, int threads) {
    const Surroundings around(geometry, caster);
    std::vector<uint8_t> hasRoom(sides.size());
    parallelFor(sides.size(), threads, [&](size_t first, size_t last) {
        std::vector<BakeRay> rays;
        for (size_t i = first * raysOfSide; i < last * raysOfSide; ++i) {
            const SurfaceSide& side = sides[i / raysOfSide];
            rays.push_back({side.position + side.normal * around.clearance, 0.0f,
                            cosineDirection(side.normal, {halton(i + 1, 2), halton(i + 1, 3)}), distance});
        }
        std::vector<uint8_t> blocked(rays.size());
        caster.occluded(rays, blocked);
        for (size_t i = 0; i < rays.size(); ++i)
            if (!blocked[i]) hasRoom[first + i / raysOfSide] = 1;
    });
    return hasRoom;
}

std::string text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.4g", value);
    return buffer;
}

Error tooMany(const BakeSettings& settings, double caches) {
    BakeLayout layout;
    layout.bands = settings.bands;
    layout.linkForm = settings.linkForm;
    const double bytes = caches * settings.links * 4.0 * (2.0 + layout.shapeWords());
    return invalidArgument("settings.spacing is " + text(settings.spacing) + " m, which takes about " +
                           text(caches) + " caches, with their links " + text(bytes / double(1u << 30)) +
                           " GiB of memory; at most settings.caches (" + std::to_string(settings.caches) +
                           ") were expected");
}

Result<GridCells> cellsOfGivenSpacing(const Box& box, const ReceivingSides& surfaces,
                                      const BakeSettings& settings, float shift) {
    const double area = surfaces.area;
    const double expected = cornersOfSurface * area / (double(settings.spacing) * settings.spacing);
    if (expected > 4.0 * settings.caches + 64.0) return tooMany(settings, expected);
    if (!fitsKeys(box, settings.spacing, shift))
        return invalidArgument("settings.spacing is " + text(settings.spacing) + " m for a scene of " +
                               text(glm::length(box.size())) + " m; at most " +
                               std::to_string(maximumLatticePlace) + " cells along each axis were expected");
    GridCells grid = cellsWith(box, surfaces, settings.spacing, shift);
    if (grid.corners.size() > settings.caches) return tooMany(settings, double(grid.corners.size()));
    return grid;
}

// The number of corners falls, with small jumps up, as the spacing grows: halving ends at a spacing that suffices.
GridCells finestCells(const Box& box, const ReceivingSides& surfaces, uint32_t caches, float shift) {
    const double area = surfaces.area;
    const glm::vec3 size = box.size();
    const double largest = std::max({size.x, size.y, size.z});
    double spacing = std::sqrt(cornersOfSurface * area / caches);
    const auto suffices = [&](double s, GridCells& grid) {
        if (!fitsKeys(box, s, shift)) return false;
        grid = cellsWith(box, surfaces, float(s), shift);
        return grid.corners.size() <= caches;
    };
    GridCells best;
    while (!suffices(spacing, best))
        spacing = std::min(spacing * 1.5, std::max(spacing * 1.01, 4.0 * largest));
    double fine = spacing / 1.5, coarse = spacing;
    for (GridCells grid; suffices(fine, grid); fine /= 1.5) {
        coarse = fine;
        best = std::move(grid);
    }
    while (coarse > fine * 1.002) { // within 0.4 % of as many caches
        const double middle = std::sqrt(fine * coarse);
        GridCells grid;
        if (suffices(middle, grid)) {
            coarse = middle;
            best = std::move(grid);
        } else fine = middle;
    }
    return best;
}

} // namespace

ReceivingSides findReceivingSides(const BakeGeometry& geometry, const RayCaster& rays,
                                  const BakeSettings& settings) {
    ReceivingSides result;
    std::vector<float> areas;
    for (const SurfaceSample& sample :
         sampleSurfaces(geometry, rays, settings, samplesFor(geometry, settings)))
        for (const bool front : {true, false}) {
            if ((front ? sample.front : sample.back) != SideView::surfaces) continue;
            result.sides.push_back({sample.position, front ? sample.normal : -sample.normal});
            areas.push_back(sample.area);
        }
    const auto room = float(leastRoom * expectedSpacing(geometry, settings));
    const std::vector<uint8_t> hasRoom = findRoom(geometry, rays, result.sides, room, settings.threads);
    // In a scene of narrow gaps alone they are what there is.
    const bool all = std::count(hasRoom.begin(), hasRoom.end(), uint8_t(1)) == 0;
    size_t kept = 0;
    for (size_t i = 0; i < hasRoom.size(); ++i) {
        if (!hasRoom[i] && !all) continue;
        result.sides[kept++] = result.sides[i];
        result.area += double(areas[i]);
    }
    result.sides.resize(kept);
    return result;
}

std::array<size_t, 8> GridCells::cornersOf(LatticeKey cell) const {
    std::array<size_t, 8> numbers{};
    for (uint32_t c = 0; c < 8; ++c) {
        const LatticeKey corner = latticeKey(latticePlace(cell) + glm::uvec3(c & 1, c >> 1 & 1, c >> 2));
        numbers[c] = size_t(std::lower_bound(corners.begin(), corners.end(), corner) - corners.begin());
    }
    return numbers;
}

Result<GridCells> chooseCells(const BakeGeometry& geometry, const ReceivingSides& surfaces,
                              const BakeSettings& settings, float shift) {
    if (surfaces.sides.empty())
        return Error{
            ErrorCode::invalidData,
            "geometry has no side that anything but back faces can be seen from; at least one was expected"};
    const Box box = boxOf(geometry);
    if (settings.spacing > 0.0f) return cellsOfGivenSpacing(box, surfaces, settings, shift);
    return finestCells(box, surfaces, settings.caches, shift);
}

} // namespace rebound::detail
