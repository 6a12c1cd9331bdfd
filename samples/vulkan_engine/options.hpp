// SPDX-License-Identifier: MIT
#pragma once

#include "rebound/extent.hpp"

#include <optional>
#include <string>

namespace rebound::engine {

struct Options {
    std::string scene = "builtin:atrium", view, camera, preset = "quarter-64", out = "vulkan_engine.png", device;
    Extent2D size{1280, 720};
    std::optional<int> frames; // absent: 2, or in a window as many as it takes until it is closed
    bool validation = false;
    bool window = false;
};

} // namespace rebound::engine
