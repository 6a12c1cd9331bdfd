// SPDX-License-Identifier: MIT
#include "surface_samples.hpp"

#include "parallel.hpp"
#include "sequence.hpp"
#include "triangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace rebound::detail {

namespace {

// Triangles that share samples by area.
struct Share {
    std::vector<uint32_t> triangles;
    std::vector<double> areasBefore{0.0}; // each, and all

    double area() const { return areasBefore.back(); }
    void add(const BakeGeometry& geometry, uint32_t triangle) {
        triangles.push_back(triangle);
        areasBefore.push_back(area() + Triangle(geometry, triangle).area());
    }
};

BakeSurface surfaceAt(const BakeGeometry& geometry, uint32_t triangle, glm::vec2 at) {
    if (geometry.surface) return geometry.surface(triangle, at);
    BakeSurface white;
    white.albedo = glm::vec3(1.0f);
    return white;
}

bool emits(const BakeSurface& surface) {
    return !surface.hole && glm::any(glm::greaterThan(surface.emission, glm::vec3(0.0f)));
}

// Of each triangle whether it emits in the middle of one of its quarters: 1 or 0.
std::vector<uint8_t> findEmitters(const BakeGeometry& geometry, int threads) {
    std::vector<uint8_t> found(geometry.triangles());
    constexpr float sixth = 1.0f / 6.0f;
    constexpr std::array<std::array<float, 2>, 4> middles{
        {{2 * sixth, 2 * sixth}, {sixth, sixth}, {4 * sixth, sixth}, {sixth, 4 * sixth}}};
    parallelFor(found.size(), threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i)
            found[i] = std::any_of(middles.begin(), middles.end(), [&](const auto& at) {
                return emits(geometry.surface(uint32_t(i), {at[0], at[1]}));
            });
    });
    return found;
}

// One after the other along all triangles' areas, so that many small triangles share what none of them is large enough
// for, and by the Halton sequence within a triangle   [PIC, sec. 4.2]
void place(const BakeGeometry& geometry, const Share& share, const BakeSettings& settings,
           std::span<SurfaceSample> samples) {
    const uint64_t seed = hash(settings.seed);
    const double area = share.area() / double(samples.size());
    parallelFor(samples.size(), settings.threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const auto after = std::upper_bound(share.areasBefore.begin(), share.areasBefore.end() - 1,
                                                (double(i) + 0.5) * area);
            SurfaceSample& sample = samples[i];
            sample.triangle = share.triangles[size_t(after - share.areasBefore.begin()) - 1];
            sample.area = float(area);
            const Triangle triangle(geometry, sample.triangle);
            const glm::dvec2 at = triangleFromSquare(shifted({halton(i + 1, 2), halton(i + 1, 3)}, seed));
            sample.position = glm::vec3(triangle.at(at));
            sample.normal = glm::vec3(triangle.normal());
            const BakeSurface surface = surfaceAt(geometry, sample.triangle, glm::vec2(at));
            sample.albedo = surface.albedo;
            sample.emission = surface.emission;
            sample.isHole = surface.hole;
        }
    });
}

// A side of a sample, while rays look for a front face.
struct Side {
    size_t sample = 0;
    bool front = true;
    bool seesTheOpen = false;
};

class SideTest {
public:
    SideTest(const BakeGeometry& tested, const RayCaster& rayCaster, std::span<SurfaceSample> all,
             uint64_t rotation)
        : geometry(tested), caster(rayCaster), samples(all), seed(rotation) {}

    // Samples first to last: a few rays for all sides first, as most see something at once, and more for the rest.
    void run(size_t first, size_t last) {
        searching.clear();
        for (size_t i = first; i < last; ++i) {
            if (samples[i].isHole) continue;
            samples[i].front = samples[i].back = SideView::surfaces;
            searching.push_back({i, true});
            searching.push_back({i, false});
        }
        constexpr std::array<uint32_t, 4> ends{1, 4, 8, 16};
        for (uint32_t begin = 0; const uint32_t end : ends) {
            cast(begin, end);
            begin = end;
        }
        for (const Side& side : searching)
            (side.front ? samples[side.sample].front : samples[side.sample].back) =
                side.seesTheOpen ? SideView::open : SideView::nothing;
    }

private:
    BakeRay ray(const Side& side, uint32_t index) const {
        const SurfaceSample& sample = samples[side.sample];
        const glm::vec3 normal = side.front ? sample.normal : -sample.normal;
        BakeRay result;
        result.direction = cosineDirection(
            normal, shifted({halton(index + 1, 2), halton(index + 1, 3)}, hash(seed ^ side.sample)));
        result.origin = sample.position + normal * clearance(geometry, sample.triangle, sample.position);
        return result;
    }

    bool meetsFront(const Side& side, const BakeRay& cast, const BakeHit& hit) const {
        return hit.triangle != noTriangle && hit.triangle != samples[side.sample].triangle &&
               glm::dot(Triangle(geometry, hit.triangle).cross(), glm::dvec3(cast.direction)) < 0.0;
    }

    void cast(uint32_t begin, uint32_t end) {
        rays.clear();
        for (const Side& side : searching)
            for (uint32_t i = begin; i < end; ++i) rays.push_back(ray(side, i));
        hits.resize(rays.size());
        caster.intersect(rays, hits);
        const size_t each = end - begin;
        size_t kept = 0;
        for (size_t s = 0; s < searching.size(); ++s) {
            Side side = searching[s];
            bool found = false;
            for (size_t i = s * each; i < (s + 1) * each; ++i) {
                found = found || meetsFront(side, rays[i], hits[i]);
                side.seesTheOpen = side.seesTheOpen || hits[i].triangle == noTriangle;
            }
            if (!found) searching[kept++] = side;
        }
        searching.resize(kept);
    }

    const BakeGeometry& geometry;
    const RayCaster& caster;
    std::span<SurfaceSample> samples;
    uint64_t seed;
    std::vector<Side> searching; // that no front face has been seen from yet
    std::vector<BakeRay> rays;
    std::vector<BakeHit> hits;
};

} // namespace

std::vector<SurfaceSample> sampleSurfaces(const BakeGeometry& geometry, const RayCaster& caster,
                                          const BakeSettings& settings, size_t count, double onEmitters) {
    Share emitters, others;
    std::vector<uint8_t> areEmitters(geometry.triangles());
    if (onEmitters > 0.0 && geometry.surface) areEmitters = findEmitters(geometry, settings.threads);
    for (uint32_t i = 0; i < geometry.triangles(); ++i) (areEmitters[i] ? emitters : others).add(geometry, i);
    const double share = emitters.area() / (emitters.area() + others.area());
    size_t first = emitters.area() > 0.0 ? size_t(std::max(share, onEmitters) * double(count)) : 0;
    if (!(others.area() > 0.0)) first = count;
    std::vector<SurfaceSample> samples(count);
    const std::span<SurfaceSample> all(samples);
    place(geometry, emitters, settings, all.first(first));
    place(geometry, others, settings, all.subspan(first));
    parallelFor(count, settings.threads, [&](size_t begin, size_t end) {
        SideTest(geometry, caster, samples, hash(~uint64_t(settings.seed))).run(begin, end);
    });
    return samples;
}

} // namespace rebound::detail
