// SPDX-License-Identifier: MIT
// What a kernel declares to the outside: slots and features. Plain data: files compiled for different instruction sets
// share it, and GPU backends have it beside each shader.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rebound {

// Formats of images, as GPUs store them. A CPU stores 32 bits a channel, and only the channels in use. Those in "ui" hold
// unsigned integers.
enum class Format : uint8_t { r32f, rgba16f, rgba32f, r32ui, rgba32ui };

// What a slot takes.
enum class BindingKind : uint8_t {
    none,
    texture,     // an image of the device's own that is read
    input,       // any image that is read
    uintTexture, // the same two, of unsigned integers
    uintInput,
    image,        // an image of the device's own that is written
    output,       // any image that is written
    buffer,       // a table of structs that is read
    values,       // a buffer of numbers that is read
    outputValues, // a buffer of numbers that is written
    constants,    // one struct
};

inline constexpr int slotCount = 16;
inline constexpr int featureCapacity = 4;

struct KernelInfo {
    BindingKind kinds[slotCount];       // what the kernel declares in each slot
    int featureCounts[featureCapacity]; // number of values of each feature; 1: no such feature
    size_t sizes[slotCount];            // of what a slot of constants or of a buffer holds at least [bytes]
    Format formats[slotCount];          // of images that are written, and of buffers of numbers
    const char* names[slotCount];       // as the kernel calls its slots; null: none
    uint16_t grids;                     // a bit a slot: its texture has a texel at every pixel of the grid
    uint16_t sparse;                    // a bit a slot: its texture is read by sparse pixels
    bool forItems;                      // runs for items instead of pixels
    // Whether a combination of features is among those that the kernel lists, by feature 0 + count 0 * (feature 1 + ...).
    const bool* combinations;
};

} // namespace rebound
