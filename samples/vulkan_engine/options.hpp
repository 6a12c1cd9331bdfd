// SPDX-License-Identifier: MIT
#pragma once

#include "rebound/extent.hpp"

#include <string>

namespace rebound::engine {

struct Options {
    std::string scene = "builtin:atrium", view, camera, preset = "quarter-64", out = "vulkan_engine.png", device;
    Extent2D size{1280, 720};
    int frames = 2;
    bool validation = false;
    bool window = false;
};

} // namespace rebound::engine
