// SPDX-License-Identifier: MIT
// What estimates of light at the visible surfaces have in common: paths from every pixel, and their means.
#pragma once

#include "lab/light/light_sampling.hpp"
#include "lab/light/path_tracer.hpp"
#include "lab/rays/camera_rays.hpp"

#include <optional>

namespace rebound::explain {

struct EstimateOptions {
    Extent2D extent{320, 180};
    int bounces = 8;   // of light of several bounces, 1 to 64
    int samples = 256; // paths a pixel, 1 to 2^20
    int threads = 0;   // 0: one a core
    lab::Progress progress = {};
};

// Fails as path tracing does.
Result<> validate(const EstimateOptions&, const lab::CameraView&);

// What is visible through a pixel's centre.
std::optional<lab::SurfaceHit> visibleThrough(const lab::EmbreeScene&, const lab::CameraView&,
                                              const lab::CameraRays&, int x, int y);

// Of the paths of a pixel.
uint32_t pathSeed(int x, int y);

// The surface that a path meets, as it reflects back along it.
lab::Reflector reflectorAt(const lab::EmbreeScene&, const lab::LocationHit&, glm::vec3 direction);

void storeMean(lab::Image&, int x, int y, glm::vec3 sum, int samples);

// Of the mean of values that have this sum and sum of squares, as if they were independent.
float standardErrorOf(double sum, double squared, int samples);

} // namespace rebound::explain
