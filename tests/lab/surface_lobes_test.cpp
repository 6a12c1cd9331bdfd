// SPDX-License-Identifier: MIT
// Lobes: what their sampling says of itself, energy, reciprocity, and limits that are known.
#include "lab/light/sampling.hpp"
#include "lab/light/surface_lobes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace rebound::lab;

namespace {

constexpr double pi = std::numbers::pi;
const glm::vec3 up(0, 0, 1);

constexpr GlossyModel glossyModels[] = {GlossyModel::phong, GlossyModel::blinnPhong, GlossyModel::ggx};
constexpr float roughnesses[] = {0.25f, 0.5f, 1.0f};
constexpr float viewAngles[] = {0.0f, 0.6f, 1.3f};

glm::vec3 tilted(float angle) { return {std::sin(angle), 0.0f, std::cos(angle)}; }

SpecularLobe lobeOf(GlossyModel model, float roughness, float reflectance = 1.0f) {
    Material material;
    material.metallic = 1.0f;
    material.roughness = roughness;
    return specularOf(material, glm::vec3(reflectance), model).specular;
}

// The integral of a function over all directions, by the midpoint rule in the lobe's own polar coordinates:
// dense near the axis, where lobes are narrow.
template <class Function>
double overSphere(glm::vec3 axis, Function function) {
    constexpr int rings = 1500, sectors = 720;
    double sum = 0.0;
    for (int i = 0; i < rings; ++i) {
        const double u = (i + 0.5) / rings;
        const double angle = pi * u * u; // d angle = 2 pi u du
        for (int j = 0; j < sectors; ++j) {
            const double azimuth = 2.0 * pi * (j + 0.5) / sectors;
            const glm::vec3 local(std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
                                  std::cos(angle));
            sum += function(fromTangentSpace(axis, local)) * std::sin(angle) * 2.0 * pi * u / rings * 2.0 *
                   pi / sectors;
        }
    }
    return sum;
}

} // namespace

TEST_CASE("densities of sampling integrate to 1") {
    for (const GlossyModel model : glossyModels)
        for (const float roughness : roughnesses)
            for (const float angle : viewAngles) {
                CAPTURE(int(model));
                CAPTURE(roughness);
                CAPTURE(angle);
                const SpecularLobe lobe = lobeOf(model, roughness);
                const glm::vec3 viewer = tilted(angle);
                const double sum = overSphere(
                    tilted(-angle), [&](glm::vec3 light) { return double(lobe.density(up, viewer, light)); });
                // Directions that lobes are sampled for but that no light comes from: the mirror images at
                // half vectors that face away from the viewer, which lie below the surface and have no
                // density.
                constexpr uint32_t count = 1 << 14;
                double wasted = 0.0;
                for (uint32_t i = 0; i < count; ++i)
                    wasted += lobe.density(up, viewer, lobe.sample(up, viewer, sobolPoint(i, 11))) == 0.0f
                                  ? 1.0
                                  : 0.0;
                // The midpoint rule, and 16,384 stratified samples.
                CHECK(sum + wasted / count == doctest::Approx(1.0).epsilon(0.005));
                CHECK((model == GlossyModel::blinnPhong || wasted == 0.0));
            }
}

TEST_CASE("samples fall as their density says, and estimate what the midpoint rule integrates") {
    constexpr int count = 1 << 16;
    for (const GlossyModel model : glossyModels)
        for (const float roughness : roughnesses)
            for (const float angle : viewAngles) {
                CAPTURE(int(model));
                CAPTURE(roughness);
                CAPTURE(angle);
                const SpecularLobe lobe = lobeOf(model, roughness);
                const glm::vec3 viewer = tilted(angle);
                double estimate = 0.0;
                for (uint32_t i = 0; i < count; ++i) {
                    const glm::vec3 light = lobe.sample(up, viewer, sobolPoint(i, 7));
                    const float density = lobe.density(up, viewer, light);
                    if (light.z > 0.0f && density > 0.0f)
                        estimate += double(lobe.value(up, viewer, light).x * light.z / density) / count;
                }
                const double integral = overSphere(tilted(-angle), [&](glm::vec3 light) {
                    return light.z > 0.0f ? double(lobe.value(up, viewer, light).x * light.z) : 0.0;
                });
                // 65,536 stratified samples, and the midpoint rule at the edge of the hemisphere.
                CHECK(estimate == doctest::Approx(integral).epsilon(0.01));
                CHECK(estimate <= 1.005); // reflectance 1 reflects no more than arrives
            }
}

TEST_CASE("a lobe is the same with viewer and light exchanged") {
    for (const GlossyModel model : glossyModels)
        for (uint32_t i = 0; i < 200; ++i) {
            const SpecularLobe lobe = lobeOf(model, 0.3f + 0.6f * sobolPoint(i, 1).x, 0.5f);
            const glm::vec3 a = cosineDirection(up, sobolPoint(i, 2));
            const glm::vec3 b = cosineDirection(up, sobolPoint(i, 3));
            CHECK(lobe.value(up, a, b).x == doctest::Approx(double(lobe.value(up, b, a).x)).epsilon(1e-3));
        }
}

TEST_CASE("narrow lobes reflect as a mirror does, by Schlick's term") {
    for (const GlossyModel model : glossyModels)
        for (const float angle : viewAngles) {
            const SpecularLobe lobe = lobeOf(model, 0.05f, 0.3f);
            const glm::vec3 viewer = tilted(angle);
            double sum = 0.0;
            int far = 0;
            for (uint32_t i = 0; i < 4096; ++i) {
                const glm::vec3 light = lobe.sample(up, viewer, sobolPoint(i, 5));
                far += glm::dot(light, tilted(-angle)) < 0.99f;
                if (light.z <= 0.0f) continue;
                sum += double(lobe.value(up, viewer, light).x * light.z / lobe.density(up, viewer, light)) /
                       4096;
            }
            CHECK(far <= 41); // GGX has long tails: 1 %
            const double expected = 0.3 + 0.7 * std::pow(1.0 - std::cos(double(angle)), 5);
            // The lobe is 0.0025 wide: its edge sees other angles, most at grazing ones.
            CHECK(sum == doctest::Approx(expected).epsilon(0.02));
        }
}

TEST_CASE("metals have no diffuse reflectance, dielectrics lose what they reflect at normal incidence") {
    Material material;
    material.metallic = 1.0f;
    CHECK(lobesOf(material, glm::vec3(0.8f), GlossyModel::ggx).diffuse == glm::vec3(0.0f));
    CHECK(lobesOf(material, glm::vec3(0.8f), GlossyModel::diffuseOnly).diffuse == glm::vec3(0.8f));
    material.metallic = 0.0f;
    CHECK(lobesOf(material, glm::vec3(0.8f), GlossyModel::ggx).diffuse.x == doctest::Approx(0.8 * 0.96));
    CHECK(lobesOf(material, glm::vec3(0.8f), GlossyModel::diffuseOnly).specularShare == 0.0f);
}
