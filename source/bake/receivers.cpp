// SPDX-License-Identifier: MIT
#include "receivers.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::detail {

namespace {

constexpr float margin = 0.25f;     // around a cell, in which samples count for it [cells]
constexpr size_t mostReceivers = 8; // of a cell
constexpr size_t mostSamples = 128; // of a cell; of more every n-th
constexpr float startOffset =
    0.01f; // of rays, off the surface; more than unevenness of curved surfaces [spacings]
constexpr float finestRadius = 0.15f; // samples so alike need no receiver of their own
constexpr int rounds = 3;             // of moving samples to the nearest receiver
// What weighs as much as a distance of one cell.
constexpr float normalWeight = 0.3f;     // times the squared difference of unit vectors
constexpr float visibilityWeight = 4.0f; // times the mean squared difference of visibilities

// A sample in its cell, or several that are alike.
struct Point {
    glm::vec3 position{0.0f}; // [cells]
    glm::vec3 normal{0.0f};
    std::array<float, 8> visibility{};
};

float difference(const Point& a, const Point& b) {
    const glm::vec3 offset = a.position - b.position, turn = a.normal - b.normal;
    float visibility = 0.0f;
    for (size_t c = 0; c < 8; ++c)
        visibility += (a.visibility[c] - b.visibility[c]) * (a.visibility[c] - b.visibility[c]);
    return glm::dot(offset, offset) + normalWeight * glm::dot(turn, turn) +
           visibilityWeight / 8.0f * visibility;
}

Point meanOf(const std::vector<Point>& points, const std::vector<size_t>& group, size_t number) {
    Point mean;
    float count = 0.0f;
    for (size_t i = 0; i < points.size(); ++i) {
        if (group[i] != number) continue;
        mean.position += points[i].position;
        mean.normal += points[i].normal;
        for (size_t c = 0; c < 8; ++c) mean.visibility[c] += points[i].visibility[c];
        count += 1.0f;
    }
    mean.position /= count;
    for (float& v : mean.visibility) v /= count;
    const float length = glm::length(mean.normal);
    // Opposite normals cancel only where all alike points of a group are; any of them will do.
    const size_t any = size_t(std::find(group.begin(), group.end(), number) - group.begin());
    mean.normal = length > 0.01f * count ? mean.normal / length : points[any].normal;
    return mean;
}

// Farthest points first, then k-means.
std::vector<Point> cluster(const std::vector<Point>& points) {
    std::vector<Point> centres{points[0]};
    std::vector<float> least(points.size(), std::numeric_limits<float>::infinity());
    for (;;) {
        for (size_t i = 0; i < points.size(); ++i)
            least[i] = std::min(least[i], difference(points[i], centres.back()));
        const auto farthest = std::max_element(least.begin(), least.end());
        if (centres.size() == mostReceivers || *farthest < finestRadius * finestRadius) break;
        centres.push_back(points[size_t(farthest - least.begin())]);
    }
    std::vector<size_t> group(points.size());
    for (int round = 0; round < rounds; ++round) {
        for (size_t i = 0; i < points.size(); ++i) {
            size_t nearest = 0;
            for (size_t c = 1; c < centres.size(); ++c)
                if (difference(points[i], centres[c]) < difference(points[i], centres[nearest])) nearest = c;
            group[i] = nearest;
        }
        for (size_t c = 0; c < centres.size(); ++c)
            if (std::find(group.begin(), group.end(), c) != group.end())
                centres[c] = meanOf(points, group, c);
    }
    return centres;
}

class ReceiverGatherer {
public:
    ReceiverGatherer(const Surroundings& surroundings, const Lattice& grid, const CellTable& cellTable,
                     const std::vector<SurfaceSide>& surfaceSamples)
        : around(surroundings), lattice(grid), table(cellTable), samples(surfaceSamples) {}

    std::vector<Receiver> gather(const Cell& cell, const std::vector<uint32_t>& members) {
        const std::vector<Point> points = look(cell, members);
        if (points.empty()) return {};
        std::vector<Receiver> receivers;
        for (const Point& p : cluster(points)) receivers.push_back({p.position, p.normal, p.visibility});
        return receivers;
    }

private:
    std::vector<Point> look(const Cell& cell, const std::vector<uint32_t>& members) {
        const size_t count = std::min(members.size(), mostSamples);
        std::vector<Point> points(count);
        rays.clear();
        for (size_t i = 0; i < count; ++i) {
            const SurfaceSide& sample = samples[members[i * members.size() / count]];
            points[i].position = lattice.coordinates(sample.position) - glm::vec3(latticePlace(cell.key));
            points[i].normal = sample.normal;
            const float offset = std::max(around.clearance, startOffset * lattice.spacing);
            const glm::vec3 start = sample.position + sample.normal * offset;
            for (const uint32_t cache : cell.caches) {
                const glm::vec3 towards = cache == noCache ? sample.normal : table.caches[cache] - start;
                const float distance = glm::length(towards);
                rays.push_back({start, 0.0f, towards / std::max(distance, 1e-20f), distance});
            }
        }
        hidden.resize(rays.size());
        around.rays.occluded(rays, hidden);
        for (size_t i = 0; i < count; ++i)
            for (size_t c = 0; c < 8; ++c)
                points[i].visibility[c] = cell.caches[c] != noCache && !hidden[8 * i + c] ? 1.0f : 0.0f;
        return points;
    }

    const Surroundings& around;
    const Lattice& lattice;
    const CellTable& table;
    const std::vector<SurfaceSide>& samples;
    std::vector<BakeRay> rays;
    std::vector<uint8_t> hidden;
};

} // namespace

SamplesOfCells samplesOfCells(const Lattice& lattice, const std::vector<Cell>& cells,
                              const std::vector<SurfaceSide>& samples) {
    SamplesOfCells result(cells.size());
    for (uint32_t i = 0; i < samples.size(); ++i) {
        const glm::vec3 place =
            lattice.coordinates(samples[i].position + samples[i].normal * (receiverOffset * lattice.spacing));
        const glm::ivec3 first(glm::floor(place - margin)), last(glm::floor(place + margin));
        for (int z = std::max(first.z, 0); z <= last.z; ++z)
            for (int y = std::max(first.y, 0); y <= last.y; ++y)
                for (int x = std::max(first.x, 0); x <= last.x; ++x) {
                    const LatticeKey key = latticeKey(glm::uvec3(x, y, z));
                    const auto found =
                        std::lower_bound(cells.begin(), cells.end(), key,
                                         [](const Cell& cell, LatticeKey k) { return cell.key < k; });
                    if (found != cells.end() && found->key == key)
                        result[size_t(found - cells.begin())].push_back(i);
                }
    }
    return result;
}

std::vector<std::vector<Receiver>> gatherReceivers(const Surroundings& around, const Lattice& lattice,
                                                   const CellTable& table,
                                                   const std::vector<SurfaceSide>& samples,
                                                   const SamplesOfCells& members, uint32_t first,
                                                   uint32_t last) {
    std::vector<std::vector<Receiver>> ofCell;
    ReceiverGatherer gatherer(around, lattice, table, samples);
    for (uint32_t i = first; i < last; ++i) ofCell.push_back(gatherer.gather(table.cells[i], members[i]));
    return ofCell;
}

} // namespace rebound::detail
