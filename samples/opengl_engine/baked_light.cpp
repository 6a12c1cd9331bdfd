// SPDX-License-Identifier: MIT
#include "baked_light.hpp"

#include <algorithm>
#include <span>

namespace rebound::engine {

// [rebound bake]
Result<BakedLight> BakedLight::create(opengl::Loader loader, const Bake& bake, bool emission, bool timings) {
    opengl::DeviceOptions options;
    options.loader = std::move(loader);
    options.timings = timings;
    auto device = opengl::Device::create(options);
    if (!device) return device.error();
    BakedLight light(*std::move(device));
    for (size_t i = 0; i < bake.sections.size(); ++i) {
        if (bake.sections[i].empty()) continue; // no plan asks for it
        auto buffer = light.device.createBuffer(std::as_bytes(bake.sections[i]));
        if (!buffer) return buffer.error();
        light.sections[i] = *std::move(buffer);
    }
    light.lights.surfels = bake.layout.surfels;
    light.lights.maximumSources = maximumSurfelSources;
    light.lights.shadowMaps = {{shadowMapSize, shadowMapSize}};
    light.lights.maximumShadowViews = 1;
    light.lights.handOut = false; // what lights surfels goes on to what composes
    light.current.bake = bake.layout;
    light.current.emission = emission; // not where emissive surfaces are among the lights
    light.current.skipUnchanged = true;
    return light;
}
// [/rebound bake]

// [rebound compile baked]
Result<> BakedLight::compile(const GBufferConventions& conventions, Extent2D size) {
    IlluminanceCompositionSettings next = current;
    next.resolution = size;
    next.conventions = conventions;
    auto plan = planSurfelLight(lights);
    if (!plan) return plan.error();
    auto composition = planIlluminanceComposition(next);
    if (!composition) return composition.error();
    const AppendOptions options{"", "", {{"surfel light", "surfel light"}}};
    if (auto joined = append(*plan, *composition, options); !joined) return joined;
    auto compiled = device.compile(*plan);
    if (!compiled) return compiled.error();
    current = next;
    program = *std::move(compiled);
    return {};
}
// [/rebound compile baked]

// [rebound record baked]
Result<> BakedLight::record(IlluminanceCompositionFrame<opengl::Image> images,
                            const SurfelSources& surfelSources, opengl::Image shadowMap) {
    images.sections = sections;
    SurfelLightFrame<opengl::Image> surfels;
    surfels.sources = int(surfelSources.sources.size());
    surfels.shadowMaps[0] = shadowMap;
    surfels.surfels = sections[size_t(BakeSection::surfels)];
    // New storage each frame: the driver keeps the old one until the GPU is done with it.
    std::vector<LightSource> sources = surfelSources.sources;
    sources.resize(std::max(sources.size(), size_t(maximumSurfelSources)));
    auto sourceBuffer = device.createBuffer(std::as_bytes(std::span(sources)));
    if (!sourceBuffer) return sourceBuffer.error();
    auto viewBuffer = device.createBuffer(std::as_bytes(std::span(&surfelSources.view, 1)));
    if (!viewBuffer) return viewBuffer.error();
    surfels.lightSources = *std::move(sourceBuffer);
    surfels.shadowViews = *std::move(viewBuffer);
    auto inputs = surfelLightInputs(lights, surfels);
    if (!inputs) return inputs.error();
    auto composition = illuminanceCompositionInputs(current, images);
    if (!composition) return composition.error();
    const AppendOptions options{"", "", {{"surfel light", "surfel light"}}};
    if (auto joined = append(*inputs, *composition, options); !joined) return joined;
    return program->record(*inputs);
}
// [/rebound record baked]

} // namespace rebound::engine
