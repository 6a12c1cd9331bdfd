// SPDX-License-Identifier: MIT
// Light that is composed from a bake, within the engine: surfels are lit by the engine's lights and shadow map, in the same
// program that lights pixels. Beside indirect_light.hpp, which is the screen's.
#pragma once

#include "lab/engine/moment.hpp"
#include "rebound/bake/bake.hpp"
#include "rebound/opengl/device.hpp"
#include "rebound/techniques/illuminance_composition.hpp"

#include <array>
#include <optional>

namespace rebound::engine {

class BakedLight {
public:
    // Once, with the context current: uploads the bake. emission: whether surfels send what the bake says that they emit.
    static Result<BakedLight> create(opengl::Loader, const Bake&, bool emission, bool timings);

    // At the start and after a resize, behind which light has to settle anew. After a failure the program is the one before.
    Result<> compile(const GBufferConventions&, Extent2D);

    // Every frame. Of `images` the camera and the images are looked at.
    Result<> record(IlluminanceCompositionFrame<opengl::Image> images, const SurfelSources&,
                    opengl::Image shadowMap);

    Result<std::vector<PassTiming>> timings() const { return program->timings(); }
    MemoryUse memoryUse() const { return program->memoryUse(); }
    const SurfelLightSettings& lightSettings() const { return lights; }
    const IlluminanceCompositionSettings& settings() const { return current; }

private:
    explicit BakedLight(opengl::Device d) : device(std::move(d)) {}

    opengl::Device device;
    std::array<opengl::Buffer, bakeSectionCount> sections;
    SurfelLightSettings lights;
    IlluminanceCompositionSettings current;
    std::optional<opengl::Program> program;
};

} // namespace rebound::engine
