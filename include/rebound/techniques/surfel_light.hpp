// SPDX-License-Identifier: MIT
// Direct light on a bake's surfels, for illuminance_composition: by Rebound's kernels, from the engine's lights and shadow
// maps, or by the engine's own light shader, to which surfels are pixels.
#pragma once

#include "rebound/bake/bake.hpp"
#include "rebound/camera.hpp"
#include "rebound/device.hpp"
#include "rebound/plan.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace rebound {

namespace detail {
#include "rebound/math/uniform_types.h"

#include "rebound/techniques/surfel_light_constants.h"
} // namespace detail

// As buffers hold them; explained in surfel_light_constants.h.
using LightSource = detail::LightSource;
using ShadowView = detail::ShadowView;
using detail::directionalSource, detail::pointSource, detail::spotSource, detail::discSource,
    detail::twoSidedDiscSource;

// How an engine's shadow maps are to be read.
struct ShadowMapConventions {
    DepthRange depthRange = DepthRange::zeroToOne; // of clip space; maps hold 0 to 1 either way
    DepthDirection depthDirection = DepthDirection::forward;
    FirstRow firstRow = FirstRow::bottom;
};

// Where a view lies in its shadow map.
struct ShadowMapTile {
    int map = 0;           // 0 to 3, of SurfelLightSettings::shadowMaps
    glm::ivec2 first{0};   // [texels]
    Extent2D extent{1, 1}; // [texels]
    float clearance =
        1.5f; // how far places are moved off their surface [texels]; too little shows as stripes
};

// A view from the matrix with which the map was drawn, world to clip space. Whether it is a perspective is in its last row.
ShadowView shadowView(const glm::mat4& worldToClip, const ShadowMapConventions&, const ShadowMapTile&);

inline constexpr int maximumShadowMaps = 4;

struct SurfelLightSettings {
    uint32_t surfels = 0;    // of the bake that comes with each frame, 1 to 1048576
    int maximumSources = 64; // that the buffer of light sources holds, 1 to 4096
    int placesPerSurfel =
        4; // that light is averaged over, 1 to 16: edges of shadows and cones are that smooth
    std::vector<Extent2D> shadowMaps; // their sizes, at most 4; none: no source casts shadows
    int maximumShadowViews = 16;      // that the buffer of views holds, 1 to 4096; shadowMaps only
    bool handOut = true;              // off: the light stays within the program, for a plan that is appended
};

// Fails where a setting is out of its range; the message names it.
//
// Inputs  shadow map 0 ... 3   1 channel: stored depth (as many as settings.shadowMaps)
// Buffers surfels        section of the bake
//         light sources  settings.maximumSources of LightSource
//         shadow views   settings.maximumShadowViews of ShadowView (shadowMaps only)
//         surfel light   written: as planIlluminanceComposition() takes it (handOut only)
//
// To run it in front of illuminance_composition in one program: without handOut, and append() with "surfel light" bound to
// "surfel light". A program of its own need not be recorded while no light changes.
Result<Plan> planSurfelLight(const SurfelLightSettings&);

template <class Image>
struct SurfelLightFrame {
    int sources = 0; // in use, 0 to settings.maximumSources
    std::array<Image, maximumShadowMaps> shadowMaps{};
    BufferOf<Image> surfels{}, lightSources{}, shadowViews{};
    BufferOf<Image> surfelLight{};
};

// A frame as Program::record() takes it. Fails where there are more sources than the settings allow.
template <class Image>
Result<FrameInputs<Image>> surfelLightInputs(const SurfelLightSettings&, const SurfelLightFrame<Image>&);

// Images of surfels: surfel i is texel (i % 64, i / 64); those behind the last one are zero.
inline constexpr int surfelImageWidth = 64;
inline Extent2D surfelImageExtent(uint32_t surfels) {
    return {surfelImageWidth, int(BakeLayout::stride(surfels) / uint32_t(surfelImageWidth))};
}

// Images that an engine's light shader runs over as it does over a G-buffer; to be made once.
//
// Buffers surfels           section of the bake
// Outputs surfel positions  4 channels, single precision: position [m], area [m^2]
//         surfel normals    3 channels: unit
//         surfel albedo     3 channels: diffuse reflectance, 0 to 1
Result<Plan> planSurfelImages(uint32_t surfels);

// What a light shader's image holds.
enum class SurfelImageLight {
    irradianceOverPi,  // [W m^-2 sr^-1]
    reflectedRadiance, // albedo times that: direct light as it is seen
};

// Carries that image over to where illuminance_composition reads it.
//
// Inputs  lit surfels   3 channels, of surfelImageExtent()
// Buffers surfels       section of the bake
//         surfel light  written
Result<Plan> planSurfelLightFromImage(uint32_t surfels, SurfelImageLight);

} // namespace rebound

#include "rebound/detail/surfel_light.inl"
