// SPDX-License-Identifier: MIT
// Two pictures as a display shows them, for measures that model an observer.
#pragma once

#include "lab/images/image_files.hpp"
#include "lab/metrics/compared_pixels.hpp"
#include "lab/metrics/plane.hpp"

namespace rebound::metrics {

// sRGB-encoded red, green and blue, 0 to 1; of pictures with one channel, three times the same. A pixel that
// does not count is the same in both, so that it adds no difference to its neighbours: the truth's, or the
// test's where the truth's is not finite, or black.
struct DisplayedPair {
    ColorPlanes test;
    ColorPlanes truth;
};

DisplayedPair displayedPair(const lab::Image& test, const lab::Image& truth, const ComparedPixels&,
                            const lab::ToneCurve&);

// Rec. 709's weights on encoded values.
Plane lumaOf(const ColorPlanes&);

} // namespace rebound::metrics
