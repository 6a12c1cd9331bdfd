// SPDX-License-Identifier: MIT
// What a kernel declares to the outside: slots and features. Plain data: files compiled for different instruction sets
// share it, and GPU backends have it beside each shader.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rebound {

// What a slot takes: a texture is an image of the device's own that is read, an input any image that is read; an image
// is one of the device's own that is written, an output any that is written.
enum class BindingKind : uint8_t { none, texture, input, image, output, buffer, constants };

inline constexpr int slotCount = 16;
inline constexpr int featureCapacity = 4;

struct KernelInfo {
    BindingKind kinds[slotCount];       // what the kernel declares in each slot
    int featureCounts[featureCapacity]; // number of values of each feature; 1: no such feature
    size_t sizes[slotCount]; // of what a slot of constants or of a buffer holds at least; 0: unknown [bytes]
    uint16_t grids = 0;      // a bit a slot: its texture has a texel at every pixel of the grid; 0: unknown
};

} // namespace rebound
