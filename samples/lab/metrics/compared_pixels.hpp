// SPDX-License-Identifier: MIT
// Which pixels of two pictures are compared.
#pragma once

#include "lab/images/image.hpp"
#include "rebound/result.hpp"

#include <cstdint>
#include <vector>

namespace rebound::metrics {

enum class PixelState : uint8_t { counts, notFinite, maskedOut };

struct ComparedPixels {
    std::vector<PixelState> states; // row by row, from the top
    size_t counting = 0;
    size_t maskedOut = 0;
    size_t notFinite = 0; // in either picture, not masked out
    size_t notFiniteInTest = 0;
    size_t notFiniteInTruth = 0;
};

// Fails unless pictures and mask fit each other, as compareImages states, and at least one pixel counts. The
// mask may be null.
Result<ComparedPixels> classifyPixels(const lab::Image& test, const lab::Image& truth,
                                      const lab::Image* mask);

bool isFinite(const float* pixel, int channels);

} // namespace rebound::metrics
