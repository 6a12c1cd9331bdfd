// SPDX-License-Identifier: MIT
// A bake with the direct light on its surfels.
#pragma once

#include "rebound/bake/bake.hpp"

#include <vector>

namespace rebound::lab {

struct LitBake {
    Bake bake;
    std::vector<float> direct; // as directLightOnSurfels() gives it
    bool emission = true;      // whether surfels send the emission that the bake holds
};

} // namespace rebound::lab
