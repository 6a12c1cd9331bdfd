// SPDX-License-Identifier: MIT
#include "room_cells.hpp"

#include "parallel.hpp"

#include <algorithm>
#include <array>

namespace rebound::detail {

namespace {

constexpr int placesAlong = 3; // of a room, along each axis, from where its corners are looked at
// Of the places that see any corner, those that have to see one for it to count.
constexpr double leastSight = 0.3;

// Nothing where keys do not reach the last rooms' far corners.
bool fits(const Lattice& lattice, uint32_t size) {
    const glm::uvec3 end = (lattice.cells + size - 1u) / size * size;
    return std::max({end.x, end.y, end.z}) <= maximumLatticePlace;
}

std::vector<LatticeKey> roomsOf(const Lattice& lattice, uint32_t size) {
    std::vector<LatticeKey> rooms;
    for (uint32_t z = 0; z < lattice.cells.z; z += size)
        for (uint32_t y = 0; y < lattice.cells.y; y += size)
            for (uint32_t x = 0; x < lattice.cells.x; x += size) rooms.push_back(latticeKey({x, y, z}));
    return rooms;
}

class SightSeeker {
public:
    SightSeeker(const Surroundings& surroundings, const GridCells& cells, const std::vector<CachePlace>& p)
        : around(surroundings), grid(cells), places(p) {}

    uint8_t cornersInSight(LatticeKey room) {
        const std::array<size_t, 8> corners = grid.cornersOf(room, grid.roomSize);
        rays.clear();
        for (int i = 0; i < placesAlong * placesAlong * placesAlong; ++i) {
            const glm::vec3 share =
                (glm::vec3(i % placesAlong, i / placesAlong % placesAlong, i / placesAlong / placesAlong) +
                 0.5f) /
                float(placesAlong);
            const glm::vec3 start = grid.lattice.corner(latticePlace(room)) +
                                    share * (float(grid.roomSize) * grid.lattice.spacing);
            for (const size_t corner : corners) {
                const glm::vec3 towards = places[corner].position - start;
                const float distance = glm::length(towards);
                rays.push_back({start, 0.0f, towards / std::max(distance, 1e-20f), distance});
            }
        }
        hidden.resize(rays.size());
        around.rays.occluded(rays, hidden);
        return judge(corners);
    }

private:
    uint8_t judge(const std::array<size_t, 8>& corners) const {
        std::array<int, 8> seenFrom{};
        int lookers = 0; // that see any corner
        for (size_t i = 0; i < hidden.size(); i += 8) {
            bool any = false;
            for (size_t c = 0; c < 8; ++c) {
                const bool seen = places[corners[c]].isValid && !hidden[i + c];
                seenFrom[c] += seen;
                any = any || seen;
            }
            lookers += any;
        }
        uint8_t mask = 0;
        for (size_t c = 0; c < 8; ++c)
            if (seenFrom[c] > 0 && seenFrom[c] >= leastSight * lookers) mask = uint8_t(mask | 1u << c);
        return mask;
    }

    const Surroundings& around;
    const GridCells& grid;
    const std::vector<CachePlace>& places;
    std::vector<BakeRay> rays;
    std::vector<uint8_t> hidden;
};

} // namespace

void addRooms(GridCells& grid, size_t mostCorners) {
    for (const uint32_t size : {4u, 8u, 16u}) {
        const glm::uvec3 along = (grid.lattice.cells + size - 1u) / size + 1u;
        if (size_t(along.x) * along.y * along.z > mostCorners || !fits(grid.lattice, size)) continue;
        grid.roomSize = size;
        grid.rooms = roomsOf(grid.lattice, size);
        for (const LatticeKey room : grid.rooms)
            for (uint32_t c = 0; c < 8; ++c) grid.corners.push_back(cornerOf(room, c, size));
        std::sort(grid.corners.begin(), grid.corners.end());
        grid.corners.erase(std::unique(grid.corners.begin(), grid.corners.end()), grid.corners.end());
        return;
    }
}

std::vector<uint8_t> cornersInSight(const Surroundings& around, const GridCells& grid,
                                    const std::vector<CachePlace>& places, int threads) {
    std::vector<uint8_t> masks(grid.rooms.size());
    parallelFor(
        masks.size(), threads,
        [&](size_t first, size_t last) {
            SightSeeker seeker(around, grid, places);
            for (size_t i = first; i < last; ++i) masks[i] = seeker.cornersInSight(grid.rooms[i]);
        },
        16);
    return masks;
}

} // namespace rebound::detail
