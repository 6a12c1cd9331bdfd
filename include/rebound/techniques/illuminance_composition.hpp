// SPDX-License-Identifier: MIT
// Indirect light of a static scene that was baked once: surfels send what light they receive, through links that the bake
// has found, to caches, and caches light pixels of static and dynamic objects.
// Jendersie, Kuri, Grosch: Precomputed Illuminance Composition for Real-Time Global Illumination, I3D 2016.
#pragma once

#include "rebound/bake/bake.hpp"
#include "rebound/camera.hpp"
#include "rebound/device.hpp"
#include "rebound/plan.hpp"

#include <array>
#include <cstddef>
#include <string>

namespace rebound {

struct IlluminanceCompositionSettings {
    Extent2D resolution;            // of the G-buffer, 1x1 to 16384x16384 [pixels]
    GBufferConventions conventions; // how the G-buffer is to be read
    BakeLayout bake;                // of the bake that comes with each frame
    bool bounces =
        true; // surfels also receive what caches received in the frame before: a bounce more each frame
    bool emission =
        true; // surfels send the emission that the bake holds; off where it is in their light already
    // Static pixels read the bake's light map, finer than its grid, which then lights the others alone. For bakes that have
    // one.
    bool lightMap = false;
    bool writeIndirect = true; // hand out irradiance over pi
    bool compose = true;       // hand out lit + albedo * indirect
};

// Fails where a setting is out of its range, or the bake takes more memory than a buffer may; the message names it.
//
// Inputs  depth     1 channel, as the conventions say
//         normal    3 channels, as the conventions say
//         map place 2 channels: where a pixel lies in the light map [texels]; outside of it, such as negative, or no number:
//                   it is lit by the grid (lightMap only)
//         albedo    diffuse reflectance, 0 to 1 (compose only)
//         lit       the picture that indirect light is added to (compose only)
// Buffers by name(BakeSection), the sections of a valid bake with that layout, as they are; those that are empty are left
//         out, as are mapTexels without lightMap, and mapCorners
//         surfel light   irradiance over pi that each surfel receives of all lights, three colours one behind the other,
//                        each of BakeLayout::stride(surfels) floats [W m^-2 sr^-1, or any unit: the output is in the
//                        same]. Up to 65504; more counts as that, less than nothing as nothing, and a surfel whose light
//                        is no number as unlit.
// Outputs indirect  3 channels: irradiance over pi of light that surfels sent (writeIndirect only)
//         composed  3 channels: lit + albedo * indirect (compose only)
//
// A pixel whose depth or normal is not a number, or that has no surface at 1e-6 to 1e7 m, receives nothing: its indirect is
// 0 and its composed is lit. Pixels outside the grid receive what its border does.
//
// With bounces, caches keep their light from frame to frame; Program::reset() forgets it.
Result<Plan> planIlluminanceComposition(const IlluminanceCompositionSettings&);

// One frame's camera, images and buffers; those that the settings leave out stay untouched.
template <class Image>
struct IlluminanceCompositionFrame {
    Camera camera;
    Image depth{}, normal{}, mapPlace{}, albedo{}, lit{};
    Image indirect{}, composed{};
    std::array<BufferOf<Image>, bakeSectionCount> sections{}; // by BakeSection; the same every frame
    BufferOf<Image> surfelLight{};
};

namespace detail {
#include "rebound/math/uniform_types.h"

#include "rebound/techniques/shade_view_constants.h"

// Whether a kernel reads a section of the bake.
inline bool isRead(const IlluminanceCompositionSettings& settings, BakeSection section) {
    return section != BakeSection::mapCorners && (section != BakeSection::mapTexels || settings.lightMap);
}

// Of the view space of CameraConstants, whose z is a distance.
ViewToWorldConstants viewToWorld(const Camera&, const GBufferConventions&);
} // namespace detail

// A frame as Program::record() takes it. Fails where the camera contradicts the settings' conventions.
template <class Image>
Result<FrameInputs<Image>> illuminanceCompositionInputs(const IlluminanceCompositionSettings& settings,
                                                        const IlluminanceCompositionFrame<Image>& frame) {
    auto camera = cameraConstants(frame.camera, settings.conventions, settings.resolution);
    if (!camera) return camera.error();
    FrameInputs<Image> inputs;
    inputs.images = {{"depth", frame.depth}, {"normal", frame.normal}};
    if (settings.lightMap) inputs.images.push_back({"map place", frame.mapPlace});
    if (settings.writeIndirect) inputs.images.push_back({"indirect", frame.indirect});
    if (settings.compose) {
        inputs.images.push_back({"albedo", frame.albedo});
        inputs.images.push_back({"lit", frame.lit});
        inputs.images.push_back({"composed", frame.composed});
    }
    for (int i = 0; i < bakeSectionCount; ++i)
        if (const BakeSection section{i};
            detail::isRead(settings, section) && sizeOf(settings.bake, section) > 0)
            inputs.buffers.push_back({name(section), frame.sections[size_t(i)]});
    inputs.buffers.push_back({"surfel light", frame.surfelLight});
    const detail::ViewToWorldConstants world = detail::viewToWorld(frame.camera, settings.conventions);
    const auto addConstants = [&](const char* called, const auto& constants) {
        const std::byte* bytes = reinterpret_cast<const std::byte*>(&constants);
        inputs.constants.push_back({called, {bytes, bytes + sizeof constants}});
    };
    if (settings.lightMap) {
        addConstants("view", detail::ShadeViewConstants{*camera, world});
    } else {
        addConstants("camera", *camera);
        addConstants("view to world", world);
    }
    return inputs;
}

} // namespace rebound

#include "rebound/detail/illuminance_composition.inl"
