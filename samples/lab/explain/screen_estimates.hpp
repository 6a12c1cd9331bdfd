// SPDX-License-Identifier: MIT
// Light at the visible surfaces under rules that step by step give up what the screen cannot know.
#pragma once

#include "lab/explain/estimates.hpp"

namespace rebound::explain {

// E / pi at every pixel, 3 channels, 0 where nothing is visible. All come from the same paths, so that what
// two of them share cancels in their difference. A surface is seen where the camera sees that side of it.
struct ScreenEstimates {
    lab::Image
        withoutVisibility; // one bounce from all that is seen, whatever lies in between: the exact integral
    lab::Image withVisibility; // one bounce from what is seen and the receiver sees too
    lab::Image inView; // and from what lies within the view, but is hidden from the camera or turned away
    lab::Image firstBounce;   // and from what lies outside: all light of one bounce
    lab::Image allBounces;    // and of up to `bounces`
    lab::Image screenBounces; // up to `bounces`, but only of light that met nothing but what is seen
    // 1 channel: standard error of the luminance of allBounces, as if the paths were independent: they do
    // better.
    lab::Image standardError;
};

// Fails as path tracing does.
Result<ScreenEstimates> estimateFromScreen(const lab::Scene&, const lab::CameraView&, const EstimateOptions&);

} // namespace rebound::explain
