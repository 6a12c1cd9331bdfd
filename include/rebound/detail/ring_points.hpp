// SPDX-License-Identifier: MIT
// Which texels a ring has, row by row, and as points that cells are cut from. Part of rings.hpp.
#pragma once

#include "rebound/math/rings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

namespace rebound::detail {

inline double outerRadius(const Ring& ring, Extent2D level) {
    if (!ring.isOpen) return ring.radius;
    return std::min(std::hypot(double(level.width), double(level.height)),
                    std::max(openRingReach, double(ring.radius)));
}

// A ring's texels in one row, x >= 0: none from inner on, those with a weight of their own up to full, then whole ones
// up to last.
struct RingRow {
    int inner = 0, full = 1, last = -1;
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
        r.full = std::max({r.full, r.inner, 1});
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

    // Calls visit(first, last, y, weight) for a row's runs of texels of one weight, without the receiver.
    template <class Visit>
    void visitRow(int y, const Visit& visit) const {
        const RingRow r = row(y);
        const auto single = [&](int x) {
            const double share = x == 0 && y == 0 ? 0.0 : weight(x, y);
            if (share > 0.0) visit(x, x, y, share);
        };
        const int partial = std::min(r.full - 1, r.last);
        if (r.full <= r.last) visit(-r.last, -r.full, y, 1.0);
        for (int x = -partial; x <= -r.inner; ++x) single(x);
        for (int x = std::max(r.inner, 1); x <= partial; ++x) single(x);
        if (r.full <= r.last) visit(r.full, r.last, y, 1.0);
    }

    template <class Visit>
    void visitRuns(const Visit& visit) const {
        for (int y = -reachY; y <= reachY; ++y) visitRow(y, visit);
    }

private:
    Ring ring;
    double outer2 = 0.0, radius2 = 0.0;
    int reachX = 0, reachY = 0;
};

// A texel, or a block of texels that is small beside a sample's share.
struct RingPoint {
    glm::ivec2 texel; // one of them
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
        // Some ten a sample's quarter, or, where there are more samples, one.
        constexpr int64_t manyTexels = 6000, manyBlocks = 2500;
        if (texels > manyTexels)
            while (texels / (int64_t(block) * block) > manyBlocks) ++block;
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

    // Columns of blocks from first to last.
    struct Columns {
        int first = 0, last = -1;
    };

    void gatherBlocks() {
        std::vector<Block> partial;
        for (int band = floorOf(-rows.lastRow()); band <= floorOf(rows.lastRow()); ++band) {
            const int top = std::max(band * block, -rows.lastRow());
            const int bottom = std::min(band * block + block - 1, rows.lastRow());
            int full = 1, last = std::numeric_limits<int>::max(), reach = -1;
            for (int y = top; y <= bottom; ++y) {
                const RingRow r = rows.row(y);
                full = std::max(full, r.full);
                last = std::min(last, r.last);
                reach = std::max(reach, r.last);
            }
            if (bottom - top + 1 < block) last = -1;
            const Columns right{floorOf(full + block - 1), floorOf(last + 1) - 1};
            const Columns left{floorOf(-last + block - 1), floorOf(1 - full) - 1};
            addWhole(left, band);
            addWhole(right, band);
            const int low = floorOf(-reach);
            partial.assign(size_t(floorOf(reach) - low + 1), Block{});
            for (int y = top; y <= bottom; ++y)
                rows.visitRow(y, [&](int from, int to, int row, double weight) {
                    const Columns whole = from < 0 ? left : right;
                    const int begin = whole.first * block, end = whole.last * block + block;
                    if (whole.first > whole.last || end <= from || begin > to) {
                        addRun(partial, low, from, to, row, weight);
                    } else {
                        addRun(partial, low, from, begin - 1, row, weight);
                        addRun(partial, low, end, to, row, weight);
                    }
                });
            for (const Block& b : partial)
                if (b.weight > 0.0)
                    points.push_back(
                        {b.texel, float(b.x / b.weight), float(b.y / b.weight), float(b.weight), 0, 0});
        }
    }

    // Blocks all of whose texels count as one.
    void addWhole(Columns columns, int band) {
        const float middle = 0.5f * float(block - 1);
        for (int column = columns.first; column <= columns.last; ++column) {
            const glm::ivec2 corner(column * block, band * block);
            // Not always the same texel of a block: samples would all lie in rows and columns of one lattice.
            const uint32_t mixed = (uint32_t(column) * 73856093u) ^ (uint32_t(band) * 19349663u);
            const glm::ivec2 within(int((mixed >> 8) % uint32_t(block)),
                                    int((mixed >> 16) % uint32_t(block)));
            points.push_back({corner + within, float(corner.x) + middle, float(corner.y) + middle,
                              float(block * block), 0, 0});
        }
    }

    void addRun(std::vector<Block>& to, int low, int first, int last, int y, double weight) const {
        if (first > last) return;
        const double dy = y - ((floorOf(y) + 0.5) * block - 0.5);
        const int column = floorOf(first);
        Block* b = &to[size_t(column - low)];
        for (int start = column * block; start <= last; start += block, ++b) {
            const int from = std::max(first, start), until = std::min(last, start + block - 1);
            const double share = weight * (until - from + 1);
            b->weight += share;
            b->x += share * 0.5 * (from + until);
            b->y += share * y;
            const int x = std::clamp(start + block / 2, from, until);
            const double dx = x - (start + 0.5 * block - 0.5), d = dx * dx + dy * dy;
            if (d < b->distance2) b->distance2 = d, b->texel = {x, y};
        }
    }

    int floorOf(int x) const { return x >= 0 ? x / block : -((block - 1 - x) / block); }
};

} // namespace rebound::detail
