// SPDX-License-Identifier: MIT
#include "rebound/bake/surfels.hpp"

#include "morton.hpp"
#include "parallel.hpp"
#include "poisson_discs.hpp"
#include "sequence.hpp"
#include "surface_samples.hpp"
#include "triangle.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <string>
#include <utility>

namespace rebound {

namespace {

using detail::SidePoint;

// Enough that discs leave few gaps, and that areas and mean colours are those of their surroundings.
constexpr size_t samplesPerSurfel = 16;
constexpr size_t fewestSamples = 1 << 14;
// Of samples and of surfels, on what emits: at least so many, where it is small.
constexpr double emitterShare = 0.125;

// Sides on which surfels are equally dense.
struct Sides {
    std::vector<SidePoint> points;
    std::vector<const detail::SurfaceSample*> samples; // that each is a side of
    double area = 0.0;                                 // [m^2]
    double density = 1.0;                              // of surfels, to other sides'
};

// By whether they see surfaces or the open alone (2), and whether they emit (1).
using AllSides = std::array<Sides, 4>;

AllSides sidesOf(const std::vector<detail::SurfaceSample>& samples) {
    AllSides all;
    for (const detail::SurfaceSample& sample : samples)
        for (const bool front : {true, false}) {
            const detail::SideView view = front ? sample.front : sample.back;
            if (view == detail::SideView::nothing) continue;
            const bool emits = glm::any(glm::greaterThan(sample.emission, glm::vec3(0.0f)));
            Sides& sides = all[(view == detail::SideView::open ? 2 : 0) + (emits ? 1 : 0)];
            sides.points.push_back({sample.position, front ? sample.normal : -sample.normal});
            sides.samples.push_back(&sample);
            sides.area += double(sample.area);
        }
    return all;
}

void setDensities(AllSides& all) {
    // What sides that see the open alone send meets nothing that is baked, and lights moving objects near them only. The
    // outer sides of a room's walls would take half of all surfels.
    constexpr double open = 1.0 / 16.0;
    // Small lamps are seen from near by; large ones take no more surfels than others of their size.
    constexpr double densest = 16.0;
    const double emitting = all[1].area + open * all[3].area, other = all[0].area + open * all[2].area;
    double emitters = 1.0;
    if (emitting > 0.0) {
        const double wanted = emitterShare / (1.0 - emitterShare) * other / emitting;
        emitters = std::clamp(wanted, 1.0, densest);
    }
    for (size_t i = 0; i < all.size(); ++i) all[i].density = (i & 2 ? open : 1.0) * (i & 1 ? emitters : 1.0);
}

// Each with what is nearest to it.
void gather(const Sides& sides, const detail::PoissonDiscs& discs, std::vector<Surfel>& surfels) {
    struct Sum {
        double area = 0.0;
        glm::dvec3 albedo{0.0}, emission{0.0};
    };
    std::vector<Sum> sums(discs.chosen.size());
    for (size_t i = 0; i < sides.points.size(); ++i) {
        Sum& sum = sums[discs.nearest[i]];
        const auto area = double(sides.samples[i]->area);
        sum.area += area;
        sum.albedo += area * glm::dvec3(sides.samples[i]->albedo);
        sum.emission += area * glm::dvec3(sides.samples[i]->emission);
    }
    for (size_t i = 0; i < sums.size(); ++i) {
        const SidePoint& point = sides.points[discs.chosen[i]];
        surfels.push_back({point.position, point.normal, float(sums[i].area),
                           glm::vec3(sums[i].albedo / sums[i].area),
                           glm::vec3(sums[i].emission / sums[i].area)});
    }
}

struct Extent {
    glm::dvec3 lower;
    double longest; // side [m]
};

Extent extentOf(const std::vector<Surfel>& surfels) {
    glm::dvec3 lower(surfels.front().position), upper = lower;
    for (const Surfel& surfel : surfels) {
        lower = glm::min(lower, glm::dvec3(surfel.position));
        upper = glm::max(upper, glm::dvec3(surfel.position));
    }
    const glm::dvec3 size = upper - lower;
    return {lower, std::max({size.x, size.y, size.z, 1e-30})};
}

// Neighbours in space become neighbours in the list, and in memory of whatever runs over it.
void sortByPlace(std::vector<Surfel>& surfels) {
    const Extent extent = extentOf(surfels);
    std::vector<std::pair<uint64_t, uint32_t>> order(surfels.size());
    for (uint32_t i = 0; i < surfels.size(); ++i)
        order[i] = {detail::mortonCode((glm::dvec3(surfels[i].position) - extent.lower) / extent.longest), i};
    std::sort(order.begin(), order.end());
    std::vector<Surfel> sorted(surfels.size());
    for (size_t i = 0; i < order.size(); ++i) sorted[i] = surfels[order[i].second];
    surfels = std::move(sorted);
}

// Sets what surfels see of the open and of surfaces.
void lookAround(std::vector<Surfel>& surfels, const RayCaster& caster, int threads) {
    // Off any triangle: of coordinates and of the whole's size, a few units in the last place.
    const Extent extent = extentOf(surfels);
    const glm::dvec3 furthest = glm::abs(extent.lower) + extent.longest;
    const double largest = std::max({furthest.x, furthest.y, furthest.z});
    const float clearance = detail::clearance(float(largest));
    constexpr uint32_t raysOfSurfel = 64;
    detail::parallelFor(surfels.size(), threads, [&](size_t first, size_t last) {
        std::vector<BakeRay> rays;
        for (size_t i = first; i < last; ++i)
            for (uint32_t k = 0; k < raysOfSurfel; ++k) {
                BakeRay ray;
                ray.origin = surfels[i].position + clearance * surfels[i].normal;
                // The same of all: neighbours differ by what they see, not by chance.
                ray.direction = detail::cosineDirection(surfels[i].normal,
                                                        {detail::halton(k + 1, 2), detail::halton(k + 1, 3)});
                rays.push_back(ray);
            }
        std::vector<BakeHit> hits(rays.size());
        caster.intersect(rays, hits);
        for (size_t i = first; i < last; ++i) {
            glm::vec3 away(0.0f);
            float met = 0.0f;
            for (size_t r = (i - first) * raysOfSurfel; r < (i - first + 1) * raysOfSurfel; ++r)
                if (hits[r].triangle == noTriangle)
                    surfels[i].open += rays[r].direction / float(raysOfSurfel);
                else {
                    away += rays[r].direction * hits[r].distance;
                    met += 1.0f;
                }
            surfels[i].prospect = surfels[i].position + away / std::max(met, 1.0f);
        }
    });
}

Result<std::vector<Surfel>> place(const BakeGeometry& geometry, const RayCaster& caster,
                                  const BakeSettings& settings) {
    const auto report = [&](const char* what, double share) {
        if (settings.progress) settings.progress(what, share);
    };
    report("sampling surfaces", 0.0);
    const size_t count = std::max(settings.surfels * samplesPerSurfel, fewestSamples);
    const std::vector<detail::SurfaceSample> samples =
        detail::sampleSurfaces(geometry, caster, settings, count, emitterShare);
    report("placing surfels", 0.5);
    AllSides all = sidesOf(samples);
    setDensities(all);
    double weight = 0.0;
    for (const Sides& sides : all) weight += sides.density * sides.area;
    if (!(weight > 0.0))
        return Error{ErrorCode::invalidData,
                     "geometry has " + std::to_string(geometry.triangles()) +
                         " triangles of which no side sees anything but back faces or "
                         "holes; one that does was expected"};
    std::vector<Surfel> surfels;
    for (const Sides& sides : all) {
        if (sides.points.empty()) continue;
        const double wanted = std::max(1.0, sides.density * sides.area / weight * settings.surfels);
        gather(sides,
               detail::choosePoissonDiscs(sides.points, sides.area, wanted, detail::hash(settings.seed),
                                          settings.threads),
               surfels);
    }
    sortByPlace(surfels);
    report("looking around", 0.9);
    lookAround(surfels, caster, settings.threads);
    report("placing surfels", 1.0);
    return surfels;
}

} // namespace

Result<std::vector<Surfel>> placeSurfels(const BakeGeometry& geometry, const RayCaster& caster,
                                         const BakeSettings& settings) {
    if (auto valid = validate(geometry); !valid) return valid.error();
    if (auto valid = validate(settings); !valid) return valid.error();
    try {
        return place(geometry, caster, settings);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory,
                     "out of memory while placing " + std::to_string(settings.surfels) + " surfels"};
    }
}

} // namespace rebound
