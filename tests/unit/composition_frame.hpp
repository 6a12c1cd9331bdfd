// SPDX-License-Identifier: MIT
// Frames of precomputed illuminance composition on the CPU device, seen by an orthographic camera whose pixels lie where
// a test wants them: x and y from -1 to 9 m, and -z the depth.
#pragma once

#include "kernel_runner.hpp"
#include "made_bake.hpp"

#include "rebound/techniques/illuminance_composition.hpp"

#include <optional>

namespace rebound::test {

inline IlluminanceCompositionSettings settingsFor(const Bake& bake, Extent2D extent = {19, 7}) {
    IlluminanceCompositionSettings settings;
    settings.resolution = extent;
    settings.conventions.projection = Projection::orthographic;
    settings.bake = bake.layout;
    settings.bounces = false;
    settings.emission = false;
    settings.compose = false;
    return settings;
}

class CompositionFrames {
public:
    Bake bake;
    IlluminanceCompositionSettings settings;
    Picture depth, normal, mapPlace, albedo, lit, exponent, indirect, composed, glossy;
    std::vector<float> light, emission; // [3][surfel]
    Camera camera{glm::mat4(1.0f), glm::ortho(-1.0f, 9.0f, -1.0f, 9.0f, 0.1f, 100.0f)};

    CompositionFrames(cpu::Isa isa, const Bake& b, const IlluminanceCompositionSettings& s, int threads = 1)
        : bake(b), settings(s), depth(s.resolution, 1, 4.5f), normal(s.resolution, 3),
          mapPlace(s.resolution, 2, -1.0f), albedo(s.resolution, 3, 0.5f), lit(s.resolution, 3, 0.25f),
          indirect(s.resolution, 3, -7.0f), composed(s.resolution, 3, -7.0f),
          light(3 * size_t(BakeLayout::stride(b.layout.surfels)), 1.0f), emission(light.size(), 0.0f) {
        exponent = Picture(s.resolution, 1, 1.0f);
        glossy = indirect;
        for (size_t i = 2; i < normal.values.size(); i += 3) normal.values[i] = 1.0f;
        const auto valid = validate(bake.layout);
        REQUIRE_MESSAGE(valid, (valid ? "" : valid.error().message));
        auto plan = planIlluminanceComposition(settings);
        REQUIRE_MESSAGE(plan, (plan ? "" : plan.error().message));
        auto compiled = deviceFor(isa, threads).compile(*plan);
        REQUIRE_MESSAGE(compiled, (compiled ? "" : compiled.error().message));
        program.emplace(*std::move(compiled));
    }

    // Where a pixel's surface lies.
    glm::vec3 position(int x, int y) const {
        const Extent2D e = settings.resolution;
        return {-1.0f + 10.0f * (float(x) + 0.5f) / float(e.width),
                9.0f - 10.0f * (float(y) + 0.5f) / float(e.height), -depth.at(x, y, 0)};
    }
    glm::vec3 normalAt(int x, int y) const {
        return {normal.at(x, y, 0), normal.at(x, y, 1), normal.at(x, y, 2)};
    }
    void setNormals(glm::vec3 n) {
        for (size_t i = 0; i < normal.values.size(); ++i) normal.values[i] = n[int(i % 3)];
    }
    glm::vec3 indirectAt(int x, int y) const {
        return {indirect.at(x, y, 0), indirect.at(x, y, 1), indirect.at(x, y, 2)};
    }

    FrameInputs<cpu::Image> inputs() {
        IlluminanceCompositionFrame<cpu::Image> frame;
        frame.camera = camera;
        frame.depth = depth.image();
        frame.normal = normal.image();
        frame.mapPlace = mapPlace.image();
        frame.albedo = albedo.image();
        frame.lit = lit.image();
        frame.indirect = indirect.image();
        frame.composed = composed.image();
        frame.exponent = exponent.image();
        frame.glossy = glossy.image();
        for (size_t i = 0; i < size_t(bakeSectionCount); ++i)
            frame.sections[i] = cpu::Buffer{
                const_cast<uint32_t*>(bake.sections[i].data()), bake.sections[i].size_bytes(), {}};
        frame.surfelLight = cpu::Buffer{light.data(), light.size() * sizeof(float), {}};
        frame.surfelEmission = cpu::Buffer{emission.data(), emission.size() * sizeof(float), {}};
        auto inputs = illuminanceCompositionInputs(settings, frame);
        REQUIRE_MESSAGE(inputs, (inputs ? "" : inputs.error().message));
        return *inputs;
    }
    void run() {
        const auto done = program->record(inputs());
        REQUIRE_MESSAGE(done, (done ? "" : done.error().message));
    }

    std::optional<cpu::Program> program;
};

// Gives a cache the same radiance from everywhere, if node 0 has flux 1: six links, so that every form of links can tell it.
inline void linkAround(MadeCache& cache, float radiance, uint32_t node = 0) {
    for (int axis = 0; axis < 3; ++axis)
        for (float sign : {-1.0f, 1.0f}) {
            MadeLink link;
            link.node = node;
            link.factor = radiance * factorOfSphere() / 6.0f;
            link.direction = glm::vec3(0.0f);
            link.direction[axis] = sign;
            cache.links.push_back(link);
        }
}

// A grid of 8 x 8 x 8 m around the camera's view, lit by a surfel that sends what it receives.
inline MadeBake gridInView() {
    MadeBake made = wholeGrid(glm::uvec3(2), {0.0f, 0.0f, -8.0f});
    made.surfels[0].albedo = glm::vec3(1.0f);
    return made;
}

} // namespace rebound::test
