// SPDX-License-Identifier: MIT
// Images of the lab: interleaved 32-bit floats in host memory, row 0 on top.
#pragma once

#include "rebound/extent.hpp"

#include <cstddef>
#include <vector>

namespace rebound::lab {

struct Image {
    int width = 0;
    int height = 0;
    int channels = 0; // 1 to 4, interleaved
    std::vector<float> data;

    Image() = default;
    Image(Extent2D extent, int channelCount, float value = 0.0f)
        : width(extent.width), height(extent.height), channels(channelCount),
          data(size_t(extent.width) * size_t(extent.height) * size_t(channelCount), value) {}

    Extent2D extent() const { return {width, height}; }
    bool empty() const { return data.empty(); }
    float* at(int x, int y) {
        return data.data() + (size_t(y) * size_t(width) + size_t(x)) * size_t(channels);
    }
    const float* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
};

} // namespace rebound::lab
