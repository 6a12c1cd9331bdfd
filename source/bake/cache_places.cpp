// SPDX-License-Identifier: MIT
#include "cache_places.hpp"

#include "parallel.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::detail {

namespace {

constexpr uint32_t raysOfPlace = 128;
constexpr uint32_t sidesLookedAt = 8;
// Of what a cache sees. Inside a closed object it is all; from above a floor, the odd back face of an open mesh.
constexpr float mostInnerSides = 0.25f;
// A sunlit patch nearer than that would light everything around its cache. [spacings]
constexpr float wantedDistance = 0.25f;
constexpr float furthestMove = 0.8f; // [spacings]
constexpr float leastDistance =
    0.05f; // there is no room for a cache in a gap narrower than twice that [spacings]
constexpr int exitsTried = 4;
constexpr int stepsAway = 3;

// What is seen from one place.
struct View {
    glm::vec3 position{0.0f};
    std::vector<BakeHit> hits;
    bool isInside = false;
    size_t nearest = raysOfPlace; // number of the ray that meets a surface first; raysOfPlace: none does
    float nearestDistance = std::numeric_limits<float>::infinity();
};

class CachePlacer {
public:
    CachePlacer(const Surroundings& surroundings, float latticeSpacing)
        : around(surroundings), spacing(latticeSpacing), directions(sphereDirections(raysOfPlace)),
          rays(raysOfPlace) {}

    CachePlace place(glm::vec3 corner) {
        View view = look(corner);
        if (view.isInside && !leaveGeometry(corner, view)) return {corner, false, false};
        keepDistance(corner, view);
        return {view.position, true, view.position != corner};
    }

private:
    View look(glm::vec3 position) {
        View view;
        view.position = position;
        view.hits.resize(raysOfPlace);
        for (uint32_t i = 0; i < raysOfPlace; ++i) {
            rays[i].origin = position;
            rays[i].direction = directions[i];
        }
        around.rays.intersect(rays, view.hits);
        for (size_t i = 0; i < view.hits.size(); ++i)
            if (view.hits[i].triangle != noTriangle && view.hits[i].distance < view.nearestDistance) {
                view.nearest = i;
                view.nearestDistance = view.hits[i].distance;
            }
        view.isInside = seesInnerSides(view);
        return view;
    }

    bool isBack(const View& view, size_t ray) const {
        return glm::dot(around.normalOf(view.hits[ray].triangle), directions[ray]) > 0.0f;
    }

    // Back faces are right to see where light reaches them: those of a curtain, say.
    bool seesInnerSides(const View& view) {
        std::vector<size_t> backs;
        size_t met = 0;
        for (size_t i = 0; i < view.hits.size(); ++i) {
            if (view.hits[i].triangle == noTriangle) continue;
            ++met;
            if (isBack(view, i)) backs.push_back(i);
        }
        if (float(backs.size()) <= mostInnerSides * float(met)) return false;
        std::vector<SurfaceSide> sides;
        for (size_t i = 0; i < std::min<size_t>(backs.size(), sidesLookedAt); ++i) {
            const size_t ray = backs[i * backs.size() / std::min<size_t>(backs.size(), sidesLookedAt)];
            const BakeHit& hit = view.hits[ray];
            sides.push_back({view.position + directions[ray] * hit.distance, -around.normalOf(hit.triangle)});
        }
        const auto inner = double(countInnerSides(around, sides));
        return inner / double(sides.size()) * double(backs.size()) > double(mostInnerSides) * double(met);
    }

    // Along a surface's normal to the next one, at most a spacing [m].
    float roomBefore(glm::vec3 surface, glm::vec3 normal) const {
        const BakeRay ray{surface + normal * around.clearance, 0.0f, normal, spacing};
        BakeHit opposite;
        around.rays.intersect({&ray, 1}, {&opposite, 1});
        return opposite.triangle == noTriangle ? spacing : opposite.distance;
    }

    // To the other side of the nearest surfaces whose back is seen.
    bool leaveGeometry(glm::vec3 corner, View& view) {
        std::vector<size_t> exits;
        for (size_t i = 0; i < view.hits.size(); ++i)
            if (view.hits[i].triangle != noTriangle && isBack(view, i) &&
                view.hits[i].distance < furthestMove * spacing)
                exits.push_back(i);
        std::stable_sort(exits.begin(), exits.end(),
                         [&](size_t a, size_t b) { return view.hits[a].distance < view.hits[b].distance; });
        const View inside = view;
        std::vector<glm::vec3> tried;
        for (const size_t exit : exits) {
            const glm::vec3 outwards = around.normalOf(inside.hits[exit].triangle);
            if (std::any_of(tried.begin(), tried.end(),
                            [&](glm::vec3 normal) { return glm::dot(normal, outwards) > 0.9f; }))
                continue; // the same wall again
            if (tried.size() == exitsTried) break;
            tried.push_back(outwards);
            // Along its normal the surface is nearer than along the ray.
            const float depth = inside.hits[exit].distance * glm::dot(outwards, directions[exit]);
            const glm::vec3 surface = corner + directions[exit] * inside.hits[exit].distance;
            const float beyond = std::min(wantedDistance * spacing, 0.5f * roomBefore(surface, outwards));
            const glm::vec3 position = corner + outwards * (depth + beyond);
            if (beyond < leastDistance * spacing) continue;
            if (glm::distance(position, corner) > furthestMove * spacing) continue;
            view = look(position);
            if (!view.isInside) return true;
        }
        return false;
    }

    // Off the nearest surface, to the middle of the room that there is at most.
    void keepDistance(glm::vec3 corner, View& view) {
        for (int step = 0; step < stepsAway && view.nearestDistance < wantedDistance * spacing; ++step) {
            glm::vec3 away = around.normalOf(view.hits[view.nearest].triangle);
            if (isBack(view, view.nearest)) away = -away;
            const float room = roomBefore(view.position, away);
            const float length = std::min(wantedDistance * spacing - view.nearestDistance,
                                          0.5f * (room - view.nearestDistance));
            const glm::vec3 position = view.position + away * length;
            if (length <= 0.0f || glm::distance(position, corner) > furthestMove * spacing) return;
            View moved = look(position);
            if (moved.isInside || moved.nearestDistance <= view.nearestDistance) return;
            view = std::move(moved);
        }
    }

    const Surroundings& around;
    float spacing;
    std::vector<glm::vec3> directions;
    std::vector<BakeRay> rays;
};

} // namespace

std::vector<CachePlace> placeCaches(const Surroundings& around, const GridCells& grid, int threads) {
    std::vector<CachePlace> places(grid.corners.size());
    parallelFor(
        places.size(), threads,
        [&](size_t first, size_t last) {
            CachePlacer placer(around, grid.lattice.spacing);
            for (size_t i = first; i < last; ++i)
                places[i] = placer.place(grid.lattice.corner(latticePlace(grid.corners[i])));
        },
        32);
    return places;
}

std::vector<LostCell> placeInLostCells(const Surroundings& around, const GridCells& grid,
                                       const std::vector<CachePlace>& places,
                                       const std::vector<SurfaceSide>& sides) {
    const auto isLost = [&](LatticeKey cell) {
        const std::array<size_t, 8> corners = grid.cornersOf(cell);
        return std::none_of(corners.begin(), corners.end(), [&](size_t i) { return places[i].isValid; });
    };
    std::vector<LostCell> lost;
    std::vector<const SurfaceSide*> middle; // of each lost cell, the side nearest to its middle
    for (const LatticeKey cell : grid.cells)
        if (isLost(cell)) lost.push_back({cell, {}});
    middle.resize(lost.size());
    for (const SurfaceSide& side : sides) {
        const LatticeKey key = grid.lattice.receiverCell(side.position, side.normal);
        const auto found = std::lower_bound(lost.begin(), lost.end(), key,
                                            [](const LostCell& cell, LatticeKey k) { return cell.cell < k; });
        if (found == lost.end() || found->cell != key) continue;
        const SurfaceSide*& nearest = middle[size_t(found - lost.begin())];
        const glm::vec3 centre = grid.lattice.corner(latticePlace(key)) + 0.5f * grid.lattice.spacing;
        if (!nearest || glm::distance(side.position, centre) < glm::distance(nearest->position, centre))
            nearest = &side;
    }
    size_t kept = 0;
    for (size_t i = 0; i < lost.size(); ++i) {
        if (!middle[i]) continue; // lit at the receivers' offset alone
        const glm::vec3 normal = middle[i]->normal, start = middle[i]->position + normal * around.clearance;
        const float wanted = wantedDistance * grid.lattice.spacing;
        const BakeRay ray{start, 0.0f, normal, 2.0f * wanted};
        BakeHit hit;
        around.rays.intersect({&ray, 1}, {&hit, 1});
        const float distance = hit.triangle == noTriangle ? wanted : 0.5f * hit.distance;
        lost[kept++] = {lost[i].cell, start + normal * distance};
    }
    lost.resize(kept);
    return lost;
}

} // namespace rebound::detail
