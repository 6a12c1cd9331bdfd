// SPDX-License-Identifier: MIT
// Glossy light of caches against path-traced specular reflection: a white metal plate in a coloured room.
#include "../lab/frame_test_scene.hpp"
#include "take.hpp"

#include "lab/baking/bake_of_scene.hpp"
#include "lab/light/path_tracer.hpp"
#include "lab/runner/runner.hpp"
#include "lab/scenes/camera_matrices.hpp"
#include "rebound/techniques/illuminance_composition.hpp"

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

namespace rebound::accuracy {
namespace {

constexpr Extent2D extent{64, 48};

// 4 x 3 x 4 m; the lamp's light is light of a surface like any other's, which caches hold.
lab::Scene roomWithPlate(float exponent) {
    lab::Scene scene;
    scene.name = "room with a plate";
    scene.emissiveMaterialsLight = false;
    const int white = lab::addMaterial(scene, glm::vec3(0.6f)),
              red = lab::addMaterial(scene, {0.6f, 0.1f, 0.1f}),
              green = lab::addMaterial(scene, {0.1f, 0.6f, 0.1f}),
              lamp = lab::addMaterial(scene, glm::vec3(0.0f), glm::vec3(10.0f)),
              plate = lab::addMaterial(scene, glm::vec3(1.0f));
    scene.materials[size_t(plate)].metallic = 1.0f;
    scene.materials[size_t(plate)].roughness =
        std::pow(2.0f / (exponent + 2.0f), 0.25f); // alpha^2 = 2 / (n + 2)
    lab::addQuad(scene, {0, 0, 0}, {0, 0, 2}, {2, 0, 0}, white);
    lab::addQuad(scene, {0, 3, 0}, {2, 0, 0}, {0, 0, 2}, white);
    lab::addQuad(scene, {0, 1.5f, -2}, {2, 0, 0}, {0, 1.5f, 0}, white);
    lab::addQuad(scene, {0, 1.5f, 2}, {0, 1.5f, 0}, {2, 0, 0}, white);
    lab::addQuad(scene, {-2, 1.5f, 0}, {0, 1.5f, 0}, {0, 0, 2}, red);
    lab::addQuad(scene, {2, 1.5f, 0}, {0, 0, 2}, {0, 1.5f, 0}, green);
    lab::addQuad(scene, {0.3f, 2.9f, -1.0f}, {0.6f, 0, 0}, {0, 0, 0.6f}, lamp);
    lab::addQuad(scene, {0, 0.5f, 0}, {0, 0, 0.7f}, {0.7f, 0, 0}, plate);
    lab::CameraView view;
    view.name = "plate";
    view.position = {0.0f, 1.6f, 1.4f};
    view.target = {0.0f, 0.5f, 0.0f};
    view.verticalFieldOfView = 0.7f;
    scene.cameras = {view};
    return scene;
}

lab::Image composedGlossy(const lab::Scene& scene, const lab::Frame& frame, GlossyLobe lobe, float exponent) {
    BakeSettings bakeSettings;
    bakeSettings.surfels = 8000;
    bakeSettings.caches = 3000;
    bakeSettings.bands = 4;
    const auto rays = std::make_shared<const lab::EmbreeScene>(take(lab::EmbreeScene::build(scene)));
    const Bake bake = take(lab::bakeOfScene(rays, bakeSettings));
    IlluminanceCompositionSettings settings;
    settings.resolution = extent;
    settings.bake = bake.layout;
    settings.writeIndirect = settings.compose = false;
    settings.glossy = lobe;
    settings.glossyExponent = exponent;
    IlluminanceCompositionFrame<lab::Image> given;
    given.camera = lab::cameraMatrices(frame.camera, extent);
    given.depth = frame.depth;
    given.normal = frame.normal;
    for (size_t i = 0; i < given.sections.size(); ++i) {
        const auto bytes = std::as_bytes(bake.sections[i]);
        given.sections[i] = std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
    }
    // All light is the lamp's emission.
    given.surfelLight = std::make_shared<const std::vector<std::byte>>(
        3 * sizeof(float) * size_t(BakeLayout::stride(bake.layout.surfels)));
    const auto inputs = take(illuminanceCompositionInputs(settings, given));
    const auto backend = take(runner::createBackend({}));
    const auto prepared = take(backend->prepare(take(planIlluminanceComposition(settings)), inputs, {}));
    for (int i = 0; i < 12; ++i) take(prepared->run());
    return take(prepared->read("glossy"));
}

struct Agreement {
    double error = 0.0, mean = 0.0; // root of the mean square over the truth's mean; means' ratio
};

// Where the plate is seen.
Agreement agreementOf(const lab::Image& image, const lab::Image& truth, const lab::Image& diffuse) {
    double squares = 0.0, sum = 0.0, right = 0.0;
    int count = 0;
    for (size_t i = 0; i < image.data.size(); i += 3) {
        if (diffuse.data[i] > 0.0f || truth.data[i] == 0.0f) continue;
        for (size_t c = 0; c < 3; ++c) {
            const double off = double(image.data[i + c]) - double(truth.data[i + c]);
            squares += off * off;
            sum += double(image.data[i + c]);
            right += double(truth.data[i + c]);
            ++count;
        }
    }
    REQUIRE(count > 1000);
    return {std::sqrt(squares / count) / (right / count), sum / right};
}

} // namespace

TEST_CASE("a metal plate reflects through a lobe what a path tracer says") {
    struct Stated {
        GlossyLobe lobe;
        lab::GlossyModel model;
        float exponent;
        Agreement agreement;
    };
    // A lobe of exponent 20 around the mirror's direction is too sharp for four bands: the lamp is smeared.
    for (const Stated& s : {Stated{GlossyLobe::mirror, lab::GlossyModel::phong, 5.0f, {0.186, 1.117}},
                            {GlossyLobe::mirror, lab::GlossyModel::phong, 20.0f, {0.623, 1.083}},
                            {GlossyLobe::halfVector, lab::GlossyModel::blinnPhong, 5.0f, {0.182, 1.043}},
                            {GlossyLobe::halfVector, lab::GlossyModel::blinnPhong, 20.0f, {0.194, 0.901}}}) {
        const lab::Scene scene = roomWithPlate(s.exponent);
        lab::FrameOptions frameOptions;
        frameOptions.extent = extent;
        const lab::Frame frame = take(lab::renderFrame(scene, scene.cameras[0], frameOptions));
        lab::PathTracerOptions options;
        options.extent = extent;
        options.samples = 512;
        options.glossy = s.model;
        const lab::PathTracedLight truth = take(lab::tracePaths(scene, scene.cameras[0], options));
        const Agreement found =
            agreementOf(composedGlossy(scene, frame, s.lobe, s.exponent), truth.glossy, truth.albedo);
        std::printf("%s, exponent %4.1f: error %.3f, mean %.3f\n",
                    s.lobe == GlossyLobe::mirror ? "mirror against Phong" : "half vector against Blinn-Phong",
                    double(s.exponent), found.error, found.mean);
        // As for diffuse light, see composition_views.hpp: other roundings move surfels.
        CHECK(std::abs(found.error - s.agreement.error) <= 0.1 * s.agreement.error);
        CHECK(std::abs(found.mean - s.agreement.mean) <= 0.02);
    }
}

} // namespace rebound::accuracy
