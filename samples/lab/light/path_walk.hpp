// SPDX-License-Identifier: MIT
// One random path from a surface on, and the light that it brings there.
#pragma once

#include "lab/light/light_sampling.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::lab {

struct PathRules {
    const EmbreeScene& scene;
    const LightSampling& light;
    GlossyModel glossy = GlossyModel::diffuseOnly;
    int bounces = 0; // surfaces that light may meet before the first
};

// Paths this long go on with the chance that their throughput gives, and count the more.
inline constexpr int firstBounceOfChance = 4;

// Estimates the radiance that the start reflects to its viewer, but for that of points, which is exact and
// costs the same every time: LightSampling::fromPoints() of the start is the caller's. What emissive surfaces send that
// are no direct light counts as if they reflected it. Calls
//   recorder.add(int bounces, glm::vec3 radiance)         what light brings that met so many surfaces before
//   the start recorder.enter(int bounces, const Reflector&) -> bool   for each of these surfaces; false ends
//   the path
template <class Recorder>
void walkPath(const PathRules& rules, Reflector at, SampleSequence& sequence, Recorder&& recorder) {
    glm::vec3 throughput(1.0f);
    for (int bounce = 0;; ++bounce) {
        if (bounce > 0)
            recorder.add(bounce,
                         throughput * (rules.light.fromPoints(at) + rules.light.sentEmission(at.point)));
        if (rules.light.hasExtendedLight())
            recorder.add(bounce, throughput * rules.light.fromSurfaces(at, sequence));
        else if (bounce == rules.bounces) return;
        const glm::vec2 choices = sequence.next();
        const glm::vec3 n = at.point.shadingNormal;
        const glm::vec3 direction = at.lobes.sample(n, at.toViewer, sequence.next(), choices.x);
        const float cosine = receivedCosine(at.point, direction);
        const float density = at.lobes.density(n, at.toViewer, direction);
        if (cosine == 0.0f || !(density > 0.0f)) return;
        throughput *= at.lobes.value(n, at.toViewer, direction) * (cosine / density);
        const Arrival arrival = rules.light.follow(at.point, direction, density);
        if (arrival.light != glm::vec3(0.0f)) recorder.add(bounce, throughput * arrival.light);
        if (!arrival.hit || bounce == rules.bounces) return;
        if (bounce + 1 >= firstBounceOfChance) {
            const float chance = std::min(1.0f, std::max({throughput.x, throughput.y, throughput.z}));
            if (!(choices.y < chance)) return;
            throughput /= chance;
        }
        at.point = rules.scene.surfaceAt(arrival.hit->location, direction);
        at.toViewer = -direction;
        at.lobes = lobesOf(rules.scene.materialAt(arrival.hit->location), at.point.albedo, rules.glossy);
        if (!recorder.enter(bounce + 1, at)) return;
    }
}

} // namespace rebound::lab
