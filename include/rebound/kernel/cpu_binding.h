// SPDX-License-Identifier: MIT
// What a CPU kernel is given to run on, and how a backend finds kernels. Plain data: files compiled for different
// instruction sets share it.
#pragma once

#include "rebound/kernel/kernel_interface.h"

#include <cstddef>

namespace rebound::cpu {

// A texture or image holds one plane of 32-bit floats a channel. Each row is followed, and the first one preceded, by
// padding that reads as zero: lanes may straddle an image's sides. Where a kernel reads it by sparse pixels, a row is two:
// its even columns, then its odd ones.
inline constexpr int rowPadding = 32;   // at least, behind a row [floats]
inline constexpr int apartPadding = 16; // the same behind a row of every other column [floats]
inline constexpr int planeMargin = 64;  // before the first row and behind the last [floats]
inline constexpr int rowAlignment = 16; // of the distance between rows [floats]

struct Binding {
    BindingKind kind = BindingKind::none;
    bool isHalf = false;       // input, output: half floats instead of floats
    bool holdsHalves = false;  // of the device's own: floats that stand for halves, and end where those do
    int width = 0, height = 0; // [texels]
    int channels = 0;
    size_t size = 0;             // of buffers and constants [bytes]
    void* data = nullptr;        // texel 0, 0 of channel 0; a buffer's or a constant block's first byte
    ptrdiff_t pixelStride = 0;   // [bytes]
    ptrdiff_t rowStride = 0;     // [bytes]
    ptrdiff_t channelStride = 0; // [bytes]
    ptrdiff_t oddColumns =
        0; // of the device's own: from an even column to the odd one behind it; 0: in order [bytes]
};

// Runs a kernel for the pixels of rows begin to end - 1 of a grid that is so many pixels wide; of a kernel for items, for
// items begin to end - 1 of so many. begin is a multiple of 64 then.
using RunRange = void (*)(const Binding* slots, int widthOrItems, int begin, int end);

// One kernel, compiled for one instruction set.
struct KernelEntry {
    const char* name;
    KernelInfo info;
    const RunRange* variants; // indexed as KernelInfo::combinations; null where the combination is not listed
};

} // namespace rebound::cpu
