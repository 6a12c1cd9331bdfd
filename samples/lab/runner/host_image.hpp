// SPDX-License-Identifier: MIT
// Images as an engine keeps them for the CPU device: a plane a channel, in half or single precision.
#pragma once

#include "lab/images/image.hpp"
#include "rebound/cpu/device.hpp"

#include <cstddef>
#include <vector>

namespace rebound::runner {

class HostImage {
public:
    HostImage() = default;
    // All zero.
    HostImage(Extent2D, int channels, cpu::Scalar);
    // Halves as halfOf() has them.
    HostImage(const lab::Image&, cpu::Scalar);

    // Valid as long as this image is neither changed nor destroyed; a move keeps it valid.
    cpu::Image view();

    // Replaces the contents by those of an image of the same size and number of channels.
    void assign(const lab::Image&);

    // Exact.
    lab::Image toLabImage() const;

private:
    Extent2D extent;
    int channels = 0;
    cpu::Scalar scalar = cpu::Scalar::float32;
    size_t planeSize = 0; // from one channel's plane to the next [bytes]
    std::vector<std::byte> bytes;
};

} // namespace rebound::runner
