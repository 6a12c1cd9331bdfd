// SPDX-License-Identifier: MIT
// The direct light of a scene on the surfels of its bake, as an engine's light shader would compute it.
#pragma once

#include "lab/rays/embree_scene.hpp"
#include "rebound/bake/bake.hpp"

#include <vector>

namespace rebound::lab {

struct SurfelLightOptions {
    int places = 8;  // on each surfel that light is averaged over, at least 1
    int samples = 4; // at each, of every light that is not a point, at least 1
    int threads = 0; // 0: one a core
};

// E / pi on the side of each surfel's normal, averaged over its disc [W m^-2 sr^-1]: three planes, red first, of
// BakeLayout::stride(surfels) numbers each. The same for any number of threads.
std::vector<float> directLightOnSurfels(const Bake&, const EmbreeScene&, const SurfelLightOptions&);

} // namespace rebound::lab
