// SPDX-License-Identifier: MIT
#pragma once

namespace rebound {

// Width and height of an image [pixels].
struct Extent2D {
    int width = 0;
    int height = 0;
    friend bool operator==(const Extent2D&, const Extent2D&) = default;
};

// The largest width or height of an image that any technique accepts [pixels].
inline constexpr int maximumExtent = 16384;

} // namespace rebound
