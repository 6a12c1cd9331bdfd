// SPDX-License-Identifier: MIT
// Definitions of rings.hpp.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

namespace rebound {
namespace detail {

inline double outerRadius(const Ring& ring, Extent2D level) {
    if (!ring.isOpen) return ring.radius;
    return std::min(std::hypot(double(level.width), double(level.height)),
                    std::max(openRingReach, double(ring.radius)));
}

// A ring's texels in one row, x >= 0: none from inner on, those with a weight of their own up to full, then whole ones
// up to last.
struct RingRow {
    int inner = 0, full = 0, last = -1;
};

class RingRows {
public:
    RingRows(const Ring& shape, Extent2D level) : ring(shape) {
        const double outer = outerRadius(ring, level);
        outer2 = outer * outer + 1e-6;
        radius2 = double(ring.radius) * ring.radius + 1e-6;
        reachX = std::min(int(outer), level.width - 1);
        reachY = std::min(int(outer), level.height - 1);
    }

    int lastRow() const { return reachY; }

    RingRow row(int y) const {
        RingRow r;
        const double left = outer2 - double(y) * y;
        r.last = left < 0.0 ? -1 : std::min(int(std::sqrt(left)), reachX);
        if (ring.isDisc) return r;
        // Of the finer level's texels -1, 0 and 1 around a texel's middle, the farthest and the nearest.
        const double far = 2.0 * std::abs(y) + 1.0, near = std::max(2.0 * std::abs(y) - 1.0, 0.0);
        if (far * far + 1.0 <= radius2) r.inner = int((std::sqrt(radius2 - far * far) - 1.0) / 2.0) + 1;
        if (near * near <= radius2) r.full = int((std::sqrt(radius2 - near * near) + 1.0) / 2.0) + 1;
        return r;
    }

    // The share of a texel that the finer level leaves out.
    double weight(int x, int y) const {
        double share = 1.0;
        for (int a = -1; a <= 1 && !ring.isDisc; ++a)
            for (int b = -1; b <= 1; ++b) {
                const double fx = 2 * x + a, fy = 2 * y + b;
                if (fx * fx + fy * fy <= radius2) share -= (2 - std::abs(a)) * (2 - std::abs(b)) / 16.0;
            }
        return share;
    }

    // Calls visit(first, last, y, weight) for runs of texels of one weight, without the receiver.
    template <class Visit>
    void visitRuns(const Visit& visit) const {
        for (int y = -reachY; y <= reachY; ++y) {
            const RingRow r = row(y);
            const auto single = [&](int x) {
                const double share = x == 0 && y == 0 ? 0.0 : weight(x, y);
                if (share > 0.0) visit(x, x, y, share);
            };
            const int full = std::max({r.full, r.inner, 1});
            if (full <= r.last) visit(-r.last, -full, y, 1.0);
            const int partial = std::min(full - 1, r.last);
            for (int x = -partial; x <= -r.inner; ++x) single(x);
            for (int x = std::max(r.inner, 1); x <= partial; ++x) single(x);
            if (full <= r.last) visit(full, r.last, y, 1.0);
        }
    }

private:
    Ring ring;
    double outer2 = 0.0, radius2 = 0.0;
    int reachX = 0, reachY = 0;
};

// A texel, or a block of texels that is small beside a sample's share.
struct RingPoint {
    glm::ivec2 texel; // one of them, at its middle
    float x, y;       // centre [texels]
    float weight;     // texels
    float importance;
    float order; // by which points are sorted
};

// How important a texel is, relative: light changes fastest near the receiver, and more receivers have near texels on
// the screen.
inline double importanceOf(double x, double y, const Ring& ring, Extent2D level) {
    const double distance = std::max(std::sqrt(x * x + y * y), 1.0);
    const double nearness = ring.isDisc ? distance * std::sqrt(std::sqrt(distance)) : distance;
    const double onScreen =
        (level.width - std::abs(x)) * (level.height - std::abs(y)) / (double(level.width) * level.height);
    return std::max(onScreen, 0.02) / nearness;
}

// The texels as points; many texels in blocks, of which there remain a few thousand.
class RingPoints {
public:
    RingPoints(const Ring& ring, Extent2D level) : rows(ring, level) {
        int64_t texels = 0;
        rows.visitRuns([&](int first, int last, int, double) { texels += last - first + 1; });
        constexpr int64_t manyTexels = 6000;
        while (texels / (int64_t(block) * block) > manyTexels) ++block;
        if (block == 1) {
            points.reserve(size_t(texels));
            rows.visitRuns([&](int first, int last, int y, double weight) {
                for (int x = first; x <= last; ++x)
                    points.push_back({{x, y}, float(x), float(y), float(weight), 0, 0});
            });
        } else {
            gatherBlocks();
        }
        for (RingPoint& p : points) p.importance = float(p.weight * importanceOf(p.x, p.y, ring, level));
    }

    std::vector<RingPoint> points;

private:
    struct Block {
        double weight = 0, x = 0, y = 0, distance2 = 1e300;
        glm::ivec2 texel{0};
    };

    RingRows rows;
    int block = 1;

    void gatherBlocks() {
        const int low = -rows.lastRow() / block - 1;
        int reach = 0;
        rows.visitRuns([&](int, int last, int, double) { reach = std::max(reach, last); });
        const int lowX = -reach / block - 1, columns = 2 - 2 * lowX;
        std::vector<Block> blocks(size_t(columns) * size_t(2 - 2 * low));
        rows.visitRuns([&](int first, int last, int y, double weight) {
            const int row = floorOf(y), column = floorOf(first);
            const double middle = (row + 0.5) * block - 0.5, dy = y - middle;
            Block* to = &blocks[size_t(row - low) * size_t(columns) + size_t(column - lowX)];
            for (int start = column * block; start <= last; start += block, ++to) {
                const int a = std::max(first, start), b = std::min(last, start + block - 1);
                const double share = weight * (b - a + 1);
                to->weight += share;
                to->x += share * 0.5 * (a + b);
                to->y += share * y;
                const int x = std::clamp(start + block / 2, a, b);
                const double dx = x - (start + 0.5 * block - 0.5), d = dx * dx + dy * dy;
                if (d < to->distance2) to->distance2 = d, to->texel = {x, y};
            }
        });
        for (const Block& b : blocks)
            if (b.weight > 0.0)
                points.push_back(
                    {b.texel, float(b.x / b.weight), float(b.y / b.weight), float(b.weight), 0, 0});
    }

    int floorOf(int x) const { return x >= 0 ? x / block : -((block - 1 - x) / block); }
};

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
        int filled = 0;
        for (const Part& p : parts) filled += p.weight > 0.0f ? 1 : 0;
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
