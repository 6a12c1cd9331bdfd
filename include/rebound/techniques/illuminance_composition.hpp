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
#include <optional>
#include <string>

namespace rebound {

// Of glossy light, which is gathered around the direction in which a mirror would be looked through.
enum class GlossyLobe {
    none,       // there is none
    mirror,     // exponents are those of the angle off that direction, as Phong's
    halfVector, // of the angle between normal and half vector, as Blinn's: about as sharp as a quarter of them
};

struct IlluminanceCompositionSettings {
    Extent2D resolution;            // of the G-buffer, 1x1 to 16384x16384 [pixels]
    GBufferConventions conventions; // how the G-buffer is to be read
    BakeLayout bake;                // of the bake that comes with each frame
    bool bounces =
        true; // surfels also receive what caches received in the frame before: a bounce more each frame
    bool emission =
        true; // surfels send the emission that the bake holds; off where it is in their light already
    bool emissionOfFrame = false; // instead of the bake's, they send one that comes with each frame
    // What did not change costs next to nothing: surfels are lit anew where their light is not the frame before's to the last
    // bit or caches have changed, patches and caches where any surfel sends something else. The results are the same bits.
    // Takes persistent memory: nodes, caches, and four floats a surfel, seven with emissionOfFrame.
    bool skipUnchanged = false;
    // Static pixels read the bake's light map, finer than its grid, which then lights the others alone. For bakes that have
    // one.
    bool lightMap = false;
    bool writeIndirect = true; // hand out irradiance over pi
    bool compose = true;       // hand out lit + albedo * indirect
    GlossyLobe glossy = GlossyLobe::none;
    // Of the lobe max(0, cos)^exponent, 0 to 64; no value: an image of exponents comes with each frame. Four bands hold mirror
    // lobes up to about 5, and half vectors' up to about 20.
    std::optional<float> glossyExponent = 10.0f;
};

// Fails where a setting is out of its range, or the bake takes more memory than a buffer may; the message names it.
//
// Inputs  depth     1 channel, as the conventions say
//         normal    3 channels, as the conventions say
//         map place 2 channels: where a pixel lies in the light map [texels]; outside of it, such as negative, or no number:
//                   it is lit by the grid (lightMap only)
//         albedo    diffuse reflectance, 0 to 1 (compose only)
//         lit       the picture that indirect light is added to (compose only)
//         exponent  1 channel: the lobe's, those outside 0 to 64 the nearest (glossy without glossyExponent only)
// Buffers by name(BakeSection), the sections of a valid bake with that layout, as they are; those that are empty are left
//         out, as are mapTexels without lightMap, and mapCorners
//         surfel light   irradiance over pi that each surfel receives of all lights, three colours one behind the other,
//                        each of BakeLayout::stride(surfels) floats [W m^-2 sr^-1, or any unit: the output is in the
//                        same]. Up to 65504; more counts as that, less than nothing as nothing, and a surfel whose light
//                        is no number as unlit.
//         surfel emission   as surfel light: radiance that surfels send by themselves [W m^-2 sr^-1], for area lights that
//                        change (emissionOfFrame only)
// Outputs indirect  3 channels: irradiance over pi of light that surfels sent (writeIndirect only)
//         composed  3 channels: lit + albedo * indirect (compose only)
//         glossy    3 channels: mean radiance over the lobe, to be multiplied by a surface's specular reflectance (glossy only)
//
// A pixel whose depth or normal is not a number, or that has no surface at 1e-6 to 1e7 m, receives nothing: its indirect is
// 0 and its composed is lit. Pixels outside the grid receive what its border does.
//
// With bounces or skipUnchanged, caches keep their light from frame to frame; Program::reset() forgets it.
Result<Plan> planIlluminanceComposition(const IlluminanceCompositionSettings&);

// One frame's camera, images and buffers; those that the settings leave out stay untouched.
template <class Image>
struct IlluminanceCompositionFrame {
    Camera camera;
    Image depth{}, normal{}, mapPlace{}, albedo{}, lit{};
    Image exponent{};
    Image indirect{}, composed{}, glossy{};
    std::array<BufferOf<Image>, bakeSectionCount> sections{}; // by BakeSection; the same every frame
    BufferOf<Image> surfelLight{}, surfelEmission{};
};

namespace detail {
#include "rebound/math/uniform_types.h"

#include "rebound/techniques/shade_view_constants.h"

// Whether a kernel reads a section of the bake.
inline bool isRead(const IlluminanceCompositionSettings& settings, BakeSection section) {
    return section != BakeSection::mapCorners && (section != BakeSection::mapTexels || settings.lightMap);
}

#include "rebound/techniques/cache_update_feature.h"

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
    if (settings.lightMap && (settings.writeIndirect || settings.compose))
        inputs.images.push_back({"map place", frame.mapPlace});
    if (settings.writeIndirect) inputs.images.push_back({"indirect", frame.indirect});
    if (settings.compose) {
        inputs.images.push_back({"albedo", frame.albedo});
        inputs.images.push_back({"lit", frame.lit});
        inputs.images.push_back({"composed", frame.composed});
    }
    if (settings.glossy != GlossyLobe::none) inputs.images.push_back({"glossy", frame.glossy});
    if (settings.glossy != GlossyLobe::none && !settings.glossyExponent)
        inputs.images.push_back({"exponent", frame.exponent});
    for (int i = 0; i < bakeSectionCount; ++i)
        if (const BakeSection section{i};
            detail::isRead(settings, section) && sizeOf(settings.bake, section) > 0)
            inputs.buffers.push_back({name(section), frame.sections[size_t(i)]});
    inputs.buffers.push_back({"surfel light", frame.surfelLight});
    if (settings.emissionOfFrame) inputs.buffers.push_back({"surfel emission", frame.surfelEmission});
    const detail::ViewToWorldConstants world = detail::viewToWorld(frame.camera, settings.conventions);
    const auto addConstants = [&](const char* called, const auto& constants) {
        const std::byte* bytes = reinterpret_cast<const std::byte*>(&constants);
        inputs.constants.push_back({called, {bytes, bytes + sizeof constants}});
    };
    const bool isShaded = settings.writeIndirect || settings.compose;
    if (settings.lightMap && isShaded) addConstants("view", detail::ShadeViewConstants{*camera, world});
    if ((isShaded && !settings.lightMap) || settings.glossy != GlossyLobe::none) {
        addConstants("camera", *camera);
        addConstants("view to world", world);
    }
    return inputs;
}

} // namespace rebound

#include "rebound/detail/illuminance_composition.inl"
