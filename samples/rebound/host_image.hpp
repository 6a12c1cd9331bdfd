// SPDX-License-Identifier: MIT
// Images as an engine keeps them for the CPU device: a plane a channel, in half or single precision.
#pragma once

#include "lab/image.hpp"
#include "rebound/cpu/device.hpp"

#include <cstddef>
#include <vector>

namespace rebound::cli {

// The largest finite value of half precision.
inline constexpr float largestHalf = 65504.0f;

class HostImage {
public:
    HostImage() = default;
    // All zero.
    HostImage(Extent2D, int channels, cpu::Scalar);
    // In half precision, values beyond its range become its largest.
    HostImage(const lab::Image&, cpu::Scalar);

    // Valid as long as this image is neither changed nor destroyed; a move keeps it valid.
    cpu::Image view();

    // Exact.
    lab::Image toLabImage() const;

private:
    Extent2D extent;
    int channels = 0;
    cpu::Scalar scalar = cpu::Scalar::float32;
    std::vector<std::byte> bytes;
};

} // namespace rebound::cli
