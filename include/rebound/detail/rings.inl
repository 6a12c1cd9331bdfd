// SPDX-License-Identifier: MIT
// Definitions of rings.hpp.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace rebound {
namespace detail {

// A texel, or a block of texels that is small beside a sample's share.
struct RingPoint {
    double x, y;    // offset of its centre [texels]
    double weight;  // texels
    double density; // weight in Lloyd's relaxation
};

inline double outerRadius(const Ring& ring, Extent2D level) {
    if (!ring.isOpen) return ring.radius;
    return std::min(std::hypot(double(level.width), double(level.height)),
                    std::max(openRingReach, double(ring.radius)));
}

// Wanted density of samples at a distance, relative.
inline double sampleDensity(double distance, bool isDisc) {
    return std::pow(std::max(distance, 1.0), isDisc ? -1.3 : -1.0);
}

// Relaxation converges to a density of weight^(1/2) in the plane, so the weight is the square of what is wanted.
inline double relaxationWeight(double x, double y, const Ring& ring, Extent2D level) {
    const double wanted = sampleDensity(std::hypot(x, y), ring.isDisc);
    const double onScreen =
        (level.width - std::abs(x)) * (level.height - std::abs(y)) / (double(level.width) * level.height);
    const double share = std::max(onScreen, 0.02);
    return wanted * wanted * share * share;
}

// Sites in the plane, and the nearest of them to a point: a grid of buckets searched from the point outwards.
class NearestSite {
public:
    explicit NearestSite(const std::vector<glm::dvec2>& siteList) : sites(siteList) {
        low = high = sites[0];
        for (const glm::dvec2& s : sites) low = glm::min(low, s), high = glm::max(high, s);
        side = std::max(1, int(std::sqrt(double(sites.size()))));
        cell = std::max({(high.x - low.x) / side, (high.y - low.y) / side, 1e-9});
        buckets.resize(size_t(side + 1) * size_t(side + 1));
        for (size_t i = 0; i < sites.size(); ++i)
            bucketAt(column(sites[i].x, low.x), column(sites[i].y, low.y)).push_back(int(i));
    }

    int find(double x, double y) const {
        const int cx = column(x, low.x), cy = column(y, low.y);
        int best = -1;
        double bestDistance = 1e300;
        for (int reach = 0; reach <= side + 1; ++reach) {
            // Buckets further out hold nothing nearer than this; a point may lie outside the grid.
            const double nearest = (reach - 1) * cell;
            if (best >= 0 && nearest > 0 && nearest * nearest > bestDistance) break;
            visitSquare(cx, cy, reach, [&](int i) {
                const double dx = sites[size_t(i)].x - x, dy = sites[size_t(i)].y - y, d = dx * dx + dy * dy;
                if (d < bestDistance || (d == bestDistance && i < best)) bestDistance = d, best = i;
            });
        }
        return best;
    }

private:
    const std::vector<glm::dvec2>& sites;
    glm::dvec2 low{0.0}, high{0.0};
    int side = 1;
    double cell = 1;
    std::vector<std::vector<int>> buckets;

    int column(double v, double origin) const { return std::clamp(int((v - origin) / cell), 0, side); }
    std::vector<int>& bucketAt(int x, int y) { return buckets[size_t(y) * size_t(side + 1) + size_t(x)]; }

    template <class Visit>
    void visitSquare(int cx, int cy, int reach, const Visit& visit) const {
        for (int y = std::max(cy - reach, 0); y <= std::min(cy + reach, side); ++y) {
            const bool edgeRow = y == cy - reach || y == cy + reach;
            for (int x = cx - reach; x <= cx + reach; x += edgeRow || reach == 0 ? 1 : 2 * reach) {
                if (x < 0 || x > side) continue;
                for (int i : buckets[size_t(y) * size_t(side + 1) + size_t(x)]) visit(i);
            }
        }
    }
};

// Sites on a golden-angle spiral whose radii follow the wanted density.
inline std::vector<glm::dvec2> spiralSites(const Ring& ring, double outer, int count) {
    constexpr int steps = 4000;
    constexpr double goldenAngle = 2.39996322972865332;
    const double inner = ring.isDisc ? 0.0 : ring.radius / 2.0;
    std::vector<double> cumulative;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double d = inner + (outer - inner) * (i + 0.5) / steps;
        cumulative.push_back(sum += sampleDensity(d, ring.isDisc) * d);
    }
    std::vector<glm::dvec2> sites;
    for (int i = 0; i < count; ++i) {
        const auto at = std::lower_bound(cumulative.begin(), cumulative.end(), (i + 0.5) / count * sum);
        const double d = inner + (outer - inner) * (double(at - cumulative.begin()) + 0.5) / steps;
        sites.push_back(d * glm::dvec2(std::cos(i * goldenAngle), std::sin(i * goldenAngle)));
    }
    return sites;
}

inline std::vector<int> assignToSites(const std::vector<RingPoint>& points,
                                      const std::vector<glm::dvec2>& sites) {
    const NearestSite nearest(sites);
    std::vector<int> owner;
    owner.reserve(points.size());
    for (const RingPoint& p : points) owner.push_back(nearest.find(p.x, p.y));
    return owner;
}

// Moves sites that own nothing to the point that is worst served, so that no sample is wasted.
inline void reviveEmptySites(const std::vector<RingPoint>& points, std::vector<int>& owner,
                             std::vector<glm::dvec2>& sites, bool isDisc) {
    std::vector<int> count(sites.size(), 0);
    for (int o : owner) ++count[size_t(o)];
    for (size_t site = 0; site < sites.size(); ++site) {
        if (count[site] > 0) continue;
        double worst = -1.0;
        size_t chosen = 0;
        for (size_t i = 0; i < points.size(); ++i) {
            const size_t o = size_t(owner[i]);
            if (count[o] < 2) continue;
            const double dx = sites[o].x - points[i].x, dy = sites[o].y - points[i].y;
            const double badness =
                (dx * dx + dy * dy) * sampleDensity(std::hypot(points[i].x, points[i].y), isDisc);
            if (badness > worst) worst = badness, chosen = i;
        }
        if (worst < 0.0) return;
        --count[size_t(owner[chosen])];
        owner[chosen] = int(site);
        count[site] = 1;
        sites[site] = {points[chosen].x, points[chosen].y};
    }
}

// Lloyd's relaxation: every site moves to the centre of what it owns, again and again.
inline void relaxSites(const std::vector<RingPoint>& points, std::vector<glm::dvec2>& sites, bool isDisc) {
    constexpr int rounds = 40; // after these, sites move by hundredths of a texel
    for (int round = 0; round < rounds; ++round) {
        std::vector<int> owner = assignToSites(points, sites);
        std::vector<glm::dvec3> sums(sites.size(), glm::dvec3(0.0));
        for (size_t i = 0; i < points.size(); ++i)
            sums[size_t(owner[i])] += points[i].density * glm::dvec3(points[i].x, points[i].y, 1.0);
        for (size_t i = 0; i < sites.size(); ++i)
            if (sums[i].z > 0.0) sites[i] = glm::dvec2(sums[i]) / sums[i].z;
        reviveEmptySites(points, owner, sites, isDisc);
    }
}

// The texels as points; many texels in blocks, of which there remain a few thousand.
inline std::vector<RingPoint> relaxationPoints(const std::vector<RingTexel>& texels, const Ring& ring,
                                               Extent2D level) {
    constexpr size_t manyTexels = 8192;
    int block = 1;
    while (texels.size() / (size_t(block) * size_t(block)) > manyTexels) ++block;
    std::vector<RingPoint> points;
    glm::ivec2 low(0), high(0);
    for (const RingTexel& t : texels) low = glm::min(low, t.offset), high = glm::max(high, t.offset);
    const glm::ivec2 count = (high - low) / block + 1;
    std::vector<glm::dvec3> sums(size_t(count.x) * size_t(count.y), glm::dvec3(0.0));
    for (const RingTexel& t : texels) {
        const glm::ivec2 b = (t.offset - low) / block;
        sums[size_t(b.y) * size_t(count.x) + size_t(b.x)] +=
            double(t.weight) * glm::dvec3(double(t.offset.x), double(t.offset.y), 1.0);
    }
    for (const glm::dvec3& s : sums)
        if (s.z > 0.0) {
            const double x = s.x / s.z, y = s.y / s.z;
            points.push_back({x, y, s.z, s.z * relaxationWeight(x, y, ring, level)});
        }
    return points;
}

} // namespace detail

inline std::vector<RingTexel> ringTexels(const Ring& ring, Extent2D level) {
    const double outer = detail::outerRadius(ring, level);
    const double outer2 = outer * outer + 1e-6, radius2 = double(ring.radius) * ring.radius + 1e-6;
    const int reachX = std::min(int(outer), level.width - 1), reachY = std::min(int(outer), level.height - 1);
    std::vector<RingTexel> texels;
    for (int y = -reachY; y <= reachY; ++y)
        for (int x = -reachX; x <= reachX; ++x) {
            if ((x == 0 && y == 0) || double(x) * x + double(y) * y > outer2) continue;
            double weight = 1.0;
            // Offsets between the four finer texels of this one and those of the receiver: -1, 0, 0, 1 along each side.
            for (int a = -1; a <= 1 && !ring.isDisc; ++a)
                for (int b = -1; b <= 1; ++b) {
                    const double fx = 2 * x + a, fy = 2 * y + b;
                    if (fx * fx + fy * fy <= radius2) weight -= (2 - std::abs(a)) * (2 - std::abs(b)) / 16.0;
                }
            if (weight > 0.0) texels.push_back({{x, y}, float(weight)});
        }
    return texels;
}

inline std::vector<RingTexel> ringPattern(const Ring& ring, int samples, Extent2D level) {
    const std::vector<RingTexel> texels = ringTexels(ring, level);
    if (int64_t(texels.size()) <= int64_t(samples)) return texels;
    std::vector<glm::dvec2> sites = detail::spiralSites(ring, detail::outerRadius(ring, level), samples);
    detail::relaxSites(detail::relaxationPoints(texels, ring, level), sites, ring.isDisc);

    std::vector<detail::RingPoint> points;
    for (const RingTexel& t : texels)
        points.push_back({double(t.offset.x), double(t.offset.y), double(t.weight), 0.0});
    const std::vector<int> owner = detail::assignToSites(points, sites);
    std::vector<glm::dvec3> sums(sites.size(), glm::dvec3(0.0));
    for (size_t i = 0; i < points.size(); ++i)
        sums[size_t(owner[i])] += points[i].weight * glm::dvec3(points[i].x, points[i].y, 1.0);

    // The texel nearest the centre of what the sample owns; among equals the one that counts most.
    std::vector<double> distance(sites.size(), 1e300);
    std::vector<RingTexel> pattern(sites.size());
    for (size_t i = 0; i < points.size(); ++i) {
        const size_t o = size_t(owner[i]);
        const double dx = sums[o].x / sums[o].z - points[i].x, dy = sums[o].y / sums[o].z - points[i].y;
        const double d = dx * dx + dy * dy - 1e-3 * points[i].weight;
        if (d < distance[o]) distance[o] = d, pattern[o] = {texels[i].offset, float(sums[o].z)};
    }
    std::erase_if(pattern, [](const RingTexel& t) { return t.weight == 0.0f; });
    return pattern;
}

} // namespace rebound
