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
    KernelInfo info;           // sizes unknown
    Format formats[slotCount]; // of images and outputs, as the shader declares them
};

// The side of a shader's square workgroups [pixels].
inline constexpr int shaderGroupSize = 8;

// Every kernel of the techniques.
std::span<const Shader* const> techniqueShaders();

} // namespace rebound
