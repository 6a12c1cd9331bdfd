// SPDX-License-Identifier: MIT
#include "cell_table.hpp"

#include "morton.hpp"

#include <algorithm>
#include <limits>

namespace rebound::detail {

namespace {

constexpr uint32_t unknown = 0xffffffffu;

// Of the largest lattice.
glm::dvec3 shareOf(LatticeKey key) { return glm::dvec3(latticePlace(key)) / double(maximumLatticePlace + 1); }

// Numbers of the corners' caches: neighbours in space are neighbours in memory.
std::vector<uint32_t> numberCaches(const GridCells& grid, const std::vector<CachePlace>& places,
                                   std::vector<glm::vec3>& caches) {
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < places.size(); ++i)
        if (places[i].isValid) order.push_back(i);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return mortonCode(shareOf(grid.corners[a])) < mortonCode(shareOf(grid.corners[b]));
    });
    std::vector<uint32_t> number(places.size(), noCache);
    for (const uint32_t corner : order) {
        number[corner] = uint32_t(caches.size());
        caches.push_back(places[corner].position);
    }
    return number;
}

std::vector<Cell> cellsWithCaches(const GridCells& grid, const std::vector<uint32_t>& numberOf,
                                  const std::vector<LostCell>& lost, std::vector<glm::vec3>& caches) {
    std::vector<Cell> cells;
    size_t next = 0; // of lost cells, which are in the same order
    for (const LatticeKey key : grid.cells) {
        Cell cell;
        cell.key = key;
        const std::array<size_t, 8> corners = grid.cornersOf(key);
        for (size_t c = 0; c < 8; ++c) cell.caches[c] = numberOf[corners[c]];
        if (next < lost.size() && lost[next].cell == key) {
            cell.caches[0] = uint32_t(caches.size());
            caches.push_back(lost[next++].position);
        }
        if (std::any_of(cell.caches.begin(), cell.caches.end(),
                        [](uint32_t cache) { return cache != noCache; }))
            cells.push_back(cell);
    }
    return cells;
}

class BrickTable {
public:
    explicit BrickTable(CellTable& filled) : table(filled), size(filled.bricks) {}

    void fill() {
        table.brickOf.assign(size_t(size.x) * size.y * size.z, unknown);
        std::vector<glm::uvec3> placeOf;
        for (uint32_t i = 0; i < table.cells.size(); ++i) {
            const glm::uvec3 place = latticePlace(table.cells[i].key) / 4u;
            uint32_t& brick = table.brickOf[indexOf(place)];
            if (brick == unknown) {
                brick = uint32_t(placeOf.size());
                placeOf.push_back(place);
                cellsOf.emplace_back();
            }
            cellsOf[brick].push_back(i);
        }
        table.filledBricks = uint32_t(placeOf.size());
        for (const glm::uvec3 place : placeOf) fillCells(place);
        fillEmptyBricks(placeOf);
    }

private:
    size_t indexOf(glm::uvec3 brick) const {
        return brick.x + size_t(size.x) * (brick.y + size_t(size.y) * brick.z);
    }

    // For each cell of a brick the nearest lit one of it and its neighbours; of equally near ones the first.
    void fillCells(glm::uvec3 brick) {
        std::vector<uint32_t> candidates;
        const glm::uvec3 first = glm::max(brick, 1u) - 1u, last = glm::min(brick + 1u, size - 1u);
        for (uint32_t z = first.z; z <= last.z; ++z)
            for (uint32_t y = first.y; y <= last.y; ++y)
                for (uint32_t x = first.x; x <= last.x; ++x)
                    if (const uint32_t near = table.brickOf[indexOf({x, y, z})]; near != unknown)
                        candidates.insert(candidates.end(), cellsOf[near].begin(), cellsOf[near].end());
        std::sort(candidates.begin(), candidates.end());
        for (uint32_t i = 0; i < 64; ++i) {
            const glm::ivec3 place(brick * 4u + glm::uvec3(i & 3, i >> 2 & 3, i >> 4));
            int least = std::numeric_limits<int>::max();
            uint32_t nearest = 0;
            for (const uint32_t cell : candidates) {
                const glm::ivec3 offset = glm::ivec3(latticePlace(table.cells[cell].key)) - place;
                const int distance = offset.x * offset.x + offset.y * offset.y + offset.z * offset.z;
                if (distance < least) {
                    least = distance;
                    nearest = cell;
                }
            }
            table.cellOf.push_back(nearest);
        }
    }

    // In rings around all filled bricks at once.
    void fillEmptyBricks(std::vector<glm::uvec3> ring) {
        for (size_t i = 0; i < ring.size(); ++i)
            for (int axis = 0; axis < 3; ++axis)
                for (const bool forward : {false, true}) {
                    glm::uvec3 next = ring[i];
                    if (forward ? next[axis] + 1 == size[axis] : next[axis] == 0) continue;
                    next[axis] += forward ? 1u : unknown; // adding the latter takes one away
                    if (table.brickOf[indexOf(next)] != unknown) continue;
                    table.brickOf[indexOf(next)] = table.brickOf[indexOf(ring[i])];
                    ring.push_back(next);
                }
    }

    CellTable& table;
    glm::uvec3 size;
    std::vector<std::vector<uint32_t>> cellsOf; // of filled bricks
};

} // namespace

CellTable tabulateCells(const GridCells& grid, const std::vector<CachePlace>& places,
                        const std::vector<LostCell>& lost) {
    CellTable table;
    const std::vector<uint32_t> numberOf = numberCaches(grid, places, table.caches);
    table.cells = cellsWithCaches(grid, numberOf, lost, table.caches);
    table.bricks = (grid.lattice.cells + 3u) / 4u;
    BrickTable(table).fill();
    return table;
}

} // namespace rebound::detail
