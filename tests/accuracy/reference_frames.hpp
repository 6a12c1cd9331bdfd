// SPDX-License-Identifier: MIT
// Runs presets on the reference frames, whose one-bounce light an independent renderer traced, and measures the error.
#pragma once

#include "lab/rays/frame.hpp"
#include "rebound/techniques/screen_indirect.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace rebound::accuracy {

// Over pixels that count and all three channels.
struct ImageError {
    double relativeRmse = 0; // root of the mean squared error over the truth's mean
    double mean = 0;         // the result's mean over the truth's
};

struct ReferenceView {
    std::string name; // scene/camera
    lab::Frame frame;
    lab::Image truth; // E / pi of light that met exactly one other surface
    // Where they are not empty: two estimates of independent noise, whose mean is the truth.
    std::array<lab::Image, 2> halves;
    ImageError
        bruteForce; // of the sum over every pixel of the start resolution, as published with the references
};

// Those below <shared>/reference that limits.json lists, in its order; empty where it is not there.
std::vector<ReferenceView> loadReferenceViews(const std::filesystem::path& shared);

// E / pi by the technique at these settings on the CPU, from radiance albedo * direct.
lab::Image gather(const ReferenceView&, ScreenIndirectSettings);

// 1 where results can be compared with the reference's indirect light. Where two of a scene's triangles coincide, rays of the
// reference that leave one end at its twin, and the pixel is black.
lab::Image comparablePixels(const lab::Frame&, const lab::Image& indirect);

// Of pixels that see a surface, or of those where the mask is above 0. Halves take the truth's noise out of the relative RMSE.
ImageError errorOf(const lab::Image& result, const ReferenceView&);
ImageError errorOf(const lab::Image& result, const ReferenceView&, const lab::Image& mask);

} // namespace rebound::accuracy
