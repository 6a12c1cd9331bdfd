// SPDX-License-Identifier: MIT
// Definitions of rings.hpp: cells of equal importance, and the samples picked from them.

#include "rebound/detail/ring_points.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>

namespace rebound {
namespace detail {

using PointSpan = std::span<RingPoint>;

inline double importanceOf(PointSpan points) {
    double sum = 0.0;
    for (const RingPoint& p : points) sum += p.importance;
    return sum;
}

// Sorts by a number of 0 or more; among equals the order remains.
template <class Order>
void sortPoints(PointSpan points, const Order& order) {
    // Such a float's bits grow with it.
    std::vector<uint64_t> keys;
    keys.reserve(points.size());
    for (size_t i = 0; i < points.size(); ++i) {
        points[i].order = order(points[i]);
        keys.push_back(uint64_t(std::bit_cast<uint32_t>(points[i].order)) << 32 | i);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<RingPoint> sorted;
    sorted.reserve(points.size());
    for (uint64_t key : keys) sorted.push_back(points[uint32_t(key)]);
    std::copy(sorted.begin(), sorted.end(), points.begin());
}

inline float distance2Of(const RingPoint& p) { return p.x * p.x + p.y * p.y; }
// Grows with the angle as it would, from 0 to 4.
inline float turnOf(const RingPoint& p) {
    const float along = p.x / (std::abs(p.x) + std::abs(p.y));
    return p.y < 0.0f ? 3.0f + along : 1.0f - along;
}

// Calls visit(part, points) for parts of equal importance, in the points' order. A shift of a part's share, 0 to 1, lets
// the first part's end be the last part's beginning; both are visited apart, as part `parts` is part 0.
template <class Visit>
void cut(PointSpan points, int parts, double shift, const Visit& visit) {
    const double share = importanceOf(points) / parts;
    double sum = shift * share;
    size_t begin = 0;
    int part = 0;
    for (size_t i = 0; i <= points.size(); ++i) {
        const int next =
            i < points.size() ? std::min(int((sum + 0.5 * points[i].importance) / share), parts) : parts + 1;
        if (next != part) {
            if (i > begin) visit(part, points.subspan(begin, i - begin));
            begin = i;
            part = next;
        }
        if (i < points.size()) sum += points[i].importance;
    }
}

// Picks each pattern's sample from a cell.
class CellSampler {
public:
    CellSampler(RingPatterns& to, int patternCount) : result(to), patterns(patternCount) {}

    void sample(std::vector<RingPoint>& cell) {
        std::array<Part, 4> parts;
        if (patterns == 1) parts[0] = partOf(cell);
        else quarter(cell, parts);
        // A cell of one to three texels has empty quarters: its texels then serve several patterns.
        std::array<int, 4> chosen{}, uses{};
        for (int pattern = 0; pattern < patterns; ++pattern) {
            const int column = pattern & 1, row = pattern >> 1;
            int part = patterns == 1 ? 0 : ((column ^ row) | (row << 1)) ^ (cells & 3);
            while (parts[size_t(part)].weight == 0.0f) part = (part + 1) & 3;
            chosen[size_t(pattern)] = part;
        }
        spread(parts, chosen);
        for (int pattern = 0; pattern < patterns; ++pattern) ++uses[size_t(chosen[size_t(pattern)])];
        for (int pattern = 0; pattern < patterns; ++pattern) {
            const Part& p = parts[size_t(chosen[size_t(pattern)])];
            perPattern[size_t(pattern)].push_back(
                {p.texel, p.weight * float(patterns) / float(uses[size_t(chosen[size_t(pattern)])])});
        }
        ++cells;
    }

    void finish() {
        result.count = cells;
        result.isShared = patterns == 1;
        for (int pattern = 0; pattern < patterns; ++pattern)
            result.texels.insert(result.texels.end(), perPattern[size_t(pattern)].begin(),
                                 perPattern[size_t(pattern)].end());
    }

private:
    struct Part {
        glm::ivec2 texel{0};
        float weight = 0.0f;
    };

    RingPatterns& result;
    int patterns = 1;
    int cells = 0;
    std::array<std::vector<RingTexel>, 4> perPattern;

    // The texel nearest the part's centre stands for it.
    static Part partOf(PointSpan points) {
        double weight = 0.0, x = 0.0, y = 0.0;
        for (const RingPoint& p : points) weight += p.weight, x += p.weight * p.x, y += p.weight * p.y;
        Part part;
        double nearest = 1e300;
        for (const RingPoint& p : points) {
            const double dx = p.x - x / weight, dy = p.y - y / weight, d = dx * dx + dy * dy;
            if (d < nearest) nearest = d, part.texel = p.texel;
        }
        part.weight = float(weight);
        return part;
    }

    static void quarter(PointSpan cell, std::array<Part, 4>& parts) {
        sortPoints(cell, distance2Of);
        cut(cell, 2, 0.0, [&](int radial, PointSpan half) {
            // A cell may lie across the direction where turns begin anew: turns count from opposite it.
            const float start = turnOf(half[0]) + 2.0f;
            sortPoints(half, [&](const RingPoint& p) {
                const float turn = turnOf(p) - start;
                return turn < 0.0f ? (turn < -4.0f ? turn + 8.0f : turn + 4.0f) : turn;
            });
            cut(half, 2, 0.0, [&](int along, PointSpan points) {
                parts[size_t(std::min(radial, 1) + 2 * std::min(along, 1))] = partOf(points);
            });
        });
    }
    // Lets no part go unused.
    void spread(const std::array<Part, 4>& parts, std::array<int, 4>& chosen) const {
        for (int part = 0; part < patterns; ++part) {
            const auto end = chosen.begin() + patterns;
            if (parts[size_t(part)].weight == 0.0f || std::find(chosen.begin(), end, part) != end) continue;
            for (auto it = chosen.begin(); it != end; ++it)
                if (std::count(chosen.begin(), end, *it) > 1) {
                    *it = part;
                    break;
                }
        }
    }
};

// Cuts a ring into cells and hands them out.
template <class Visit>
void cutRing(std::vector<RingPoint>& points, int cells, const Visit& visit) {
    constexpr double goldenRatio = 0.618033988749895;
    sortPoints(points, distance2Of);
    size_t begin = 0;
    double left = importanceOf(PointSpan(points));
    for (int annulus = 0; begin < points.size() && cells > 0; ++annulus) {
        // As wide as its cells are long.
        const double share = left / cells, inner = std::sqrt(points[begin].order);
        double sum = 0.0;
        size_t end = begin;
        while (end < points.size()) {
            sum += points[end].importance;
            const float order = points[end++].order;
            if (end < points.size() && points[end].order == order) continue;
            const double outer = std::sqrt(order), count = sum / share;
            if (count >= 0.9 &&
                (outer + 0.5 - std::max(inner - 0.5, 0.0)) * count >= 3.14159 * (inner + outer))
                break;
        }
        int sectors = std::clamp(int(std::lround(sum / share)), 1, cells);
        if (end == points.size()) sectors = cells;
        if (sectors == cells) end = points.size();
        const PointSpan all(points.data() + begin, end - begin);
        sortPoints(all, turnOf);
        double turned = annulus * goldenRatio;
        turned -= std::floor(turned);
        std::vector<std::vector<RingPoint>> cell(static_cast<size_t>(sectors));
        cut(all, sectors, turned, [&](int sector, PointSpan part) {
            std::vector<RingPoint>& to = cell[size_t(sector % sectors)];
            to.insert(to.end(), part.begin(), part.end());
        });
        for (std::vector<RingPoint>& c : cell)
            if (!c.empty()) visit(c);
        cells -= sectors;
        left -= importanceOf(all);
        begin = end;
    }
}

} // namespace detail

inline std::vector<RingTexel> ringTexels(const Ring& ring, Extent2D level) {
    std::vector<RingTexel> texels;
    detail::RingRows(ring, level).visitRuns([&](int first, int last, int y, double weight) {
        for (int x = first; x <= last; ++x) texels.push_back({{x, y}, float(weight)});
    });
    return texels;
}

inline RingPatterns ringPatterns(const Ring& ring, int samples, int patterns, Extent2D level) {
    RingPatterns result;
    int64_t texels = 0;
    detail::RingRows(ring, level).visitRuns([&](int first, int last, int, double) {
        texels += last - first + 1;
    });
    if (texels <= int64_t(samples)) {
        result.texels = ringTexels(ring, level);
        result.count = int(result.texels.size());
        return result;
    }
    detail::RingPoints all(ring, level);
    detail::CellSampler sampler(result, patterns);
    detail::cutRing(all.points, samples, [&](std::vector<detail::RingPoint>& cell) { sampler.sample(cell); });
    sampler.finish();
    return result;
}

} // namespace rebound
