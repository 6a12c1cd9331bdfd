// SPDX-License-Identifier: MIT
// Indirect light between visible surfaces, gathered from the screen at every scale at once.
// Soler, Hoel, Rochet, Holzschuch: Hierarchical Screen-Space Indirect Illumination, INRIA RR-7162.
#pragma once

#include "rebound/camera.hpp"
#include "rebound/device.hpp"
#include "rebound/plan.hpp"

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rebound {

// Where gathering begins: at the G-buffer's resolution, at half of it, or at a quarter.
enum class StartResolution { full, half, quarter };

// Which of the four finer texels lends a coarser one its place and normal. Light and area are those of all four.
enum class Reduction {
    nearest, // the one nearest the eye                                   [RR-7162, sec. 4]
    voting,  // the one that its neighbours resemble most                 [Soler and Hoel, eq. 5]
};

enum class FormFactor {
    pointToDisc,  // bounded where surfaces meet                          [RR-7162, eq. 4]
    pointToPoint, // unbounded: bright spots in corners; for comparison   [RR-7162, eq. 1]
};

// As samplesPerLevel: every texel of every ring. Some hundred times as slow as 64 samples; the yardstick of all patterns.
inline constexpr int wholeRings = std::numeric_limits<int>::max();

struct ScreenIndirectSettings {
    Extent2D resolution;            // of the G-buffer, 1x1 to 16384x16384 [pixels]
    GBufferConventions conventions; // how the G-buffer is to be read
    StartResolution start = StartResolution::quarter;
    int levels = 4; // 1 to 8
    int samplesPerLevel =
        64; // of level 0, 4 to 256, or wholeRings; each coarser one takes half as many again
    float ringRadius = 40.0f; // outer radius of every ring, 1 to 1024 [texels of its level]
    bool coverScreen = true;  // the outermost ring has no outer end: it reaches the screen's corners
    Reduction reduction = Reduction::voting;
    FormFactor formFactor = FormFactor::pointToDisc;
    float minimumCosine = 0.05f;  // a pixel's area is taken as if seen at no less, 0.001 to 1: grazing pixels
                                  // would stand for areas without bound
    bool smooth = true;           // four sample patterns a level, and a 5x5 joint bilateral mean over them
    bool writeIndirect = true;    // hand out irradiance over pi
    bool compose = true;          // hand out lit + albedo * indirect
    std::optional<int> onlyLevel; // show what this level alone contributes, 0 to levels - 1
};

// Settings by name: quarter-64, quarter-256, half-64, half-256, and each of them with "-5" for five levels instead of
// four; ring radius 40 at 720 rows, scaled with them so that the rings cover the same part of the view at any size.
Result<ScreenIndirectSettings> screenIndirectPreset(std::string_view name, Extent2D resolution);
std::span<const std::string_view> screenIndirectPresetNames();

// The smallest ring radius whose rings reach every texel of the screen from every other without coverScreen.
float coveringRingRadius(const ScreenIndirectSettings&);

// Fails where a setting is out of its range; the message names it.
//
// Inputs  depth     1 channel, as the conventions say
//         normal    3 channels, as the conventions say
//         radiance  diffuse radiance that each pixel sends to others, no specular, up to 65504: albedo * E / pi, and
//                   emission that E does not hold [W m^-2 sr^-1, or any unit: the output is in the same]
//         albedo    diffuse reflectance, 0 to 1 (compose only)
//         lit       the picture that indirect light is added to (compose only)
// Outputs indirect  3 channels: irradiance over pi of light that met one other surface (writeIndirect only)
//         composed  3 channels: lit + albedo * indirect (compose only)
//
// A pixel whose depth, normal or radiance is not a number, or that has no surface at 1e-6 to 1e7 m, neither sends nor
// receives: its indirect is 0 and its composed is lit.
Result<Plan> planScreenIndirect(const ScreenIndirectSettings&);

// One frame's camera and images; those that the settings leave out stay untouched.
template <class Image>
struct ScreenIndirectFrame {
    Camera camera;
    Image depth{}, normal{}, radiance{}, albedo{}, lit{};
    Image indirect{}, composed{};
};

// A frame as Program::record() takes it. Fails where the camera contradicts the settings' conventions.
template <class Image>
Result<FrameInputs<Image>> screenIndirectInputs(const ScreenIndirectSettings& settings,
                                                const ScreenIndirectFrame<Image>& frame) {
    auto camera = cameraConstants(frame.camera, settings.conventions, settings.resolution);
    if (!camera) return camera.error();
    FrameInputs<Image> inputs;
    inputs.images = {{"depth", frame.depth}, {"normal", frame.normal}, {"radiance", frame.radiance}};
    if (settings.writeIndirect) inputs.images.push_back({"indirect", frame.indirect});
    if (settings.compose) {
        inputs.images.push_back({"albedo", frame.albedo});
        inputs.images.push_back({"lit", frame.lit});
        inputs.images.push_back({"composed", frame.composed});
    }
    const std::byte* bytes = reinterpret_cast<const std::byte*>(&*camera);
    inputs.constants.push_back({"camera", {bytes, bytes + sizeof(CameraConstants)}});
    return inputs;
}

} // namespace rebound

#include "rebound/detail/screen_indirect.inl"
