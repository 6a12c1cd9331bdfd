// SPDX-License-Identifier: MIT
// Rebound's kernels as GPUs take them, embedded at build time.
#pragma once

#include "rebound/kernel/kernel_interface.h"
#include "rebound/plan.hpp"

#include <cstdint>
#include <span>
#include <string_view>

namespace rebound {

struct Shader {
    std::string_view name;           // of the kernel, such as "screen_indirect/gather"
    std::span<const uint32_t> spirv; // a Vulkan 1.1 module; features are specialization constants 0 to 3
    // Expanded GLSL without a #version line, for 4.30 and ES 3.10; the backend writes "#version ..." and a line
    // "#define REBOUND_FEATURE_n value" for each feature before it.
    std::string_view glsl;
    KernelInfo info;
};

// The side of a shader's square workgroups [pixels], and how many items one of items has.
inline constexpr int shaderGroupSize = 8;
inline constexpr int shaderItemGroup = 64;

// Workgroups of a pass, along x and y. Where a row of them does not hold all items, further rows do.
struct GroupCounts {
    uint32_t x = 1, y = 1;
};
inline GroupCounts groupCounts(const Pass& pass) {
    if (pass.items > 0) {
        constexpr uint32_t most = 65535; // along an axis, which every GPU has
        const uint32_t groups = (uint32_t(pass.items) + shaderItemGroup - 1) / shaderItemGroup;
        const uint32_t rows = (groups + most - 1) / most;
        return {(groups + rows - 1) / rows, rows};
    }
    const auto groups = [](int side) { return uint32_t((side + shaderGroupSize - 1) / shaderGroupSize); };
    return {groups(pass.grid.width), groups(pass.grid.height)};
}

// Every kernel of the techniques.
std::span<const Shader* const> techniqueShaders();

} // namespace rebound
