// SPDX-License-Identifier: MIT
#include "lab/light/direct_light.hpp"

#include "lab/light/path_walk.hpp"

#include <numbers>

namespace rebound::lab {

namespace {

struct Sum {
    glm::vec3 radiance{0.0f};

    void add(int, glm::vec3 value) { radiance += value; }
    bool enter(int, const Reflector&) { return false; }
};

} // namespace

DirectLight::DirectLight(const EmbreeScene& embreeScene, int sampleCount)
    : scene(&embreeScene), light(embreeScene), samples(sampleCount) {}

glm::vec3 DirectLight::irradiance(const SurfacePoint& point, uint32_t seed) const {
    const Reflector white{point, point.shadingNormal, whiteDiffuse()};
    Sum sum;
    if (light.hasExtendedLight())
        for (int i = 0; i < samples; ++i) {
            SampleSequence sequence(uint32_t(i), seed);
            walkPath({*scene, light}, white, sequence, sum);
        }
    return std::numbers::pi_v<float> * (light.fromPoints(white) + sum.radiance / float(samples));
}

} // namespace rebound::lab
