// SPDX-License-Identifier: MIT
// Where the pixels of a frame lie in the light map of its scene's bake.
#pragma once

#include "lab/rays/embree_scene.hpp"
#include "lab/rays/frame.hpp"
#include "rebound/bake/bake.hpp"

namespace rebound::lab {

inline constexpr float outsideMap = -1.0f;

// 2 channels [texels]; outsideMap where a pixel shows nothing, or something that is not in the map, or that does not stand
// where it was baked. Precondition: the bake is one of that scene, and has a light map. threads: 0: one a core.
Image mapPlacesOf(const Bake&, const EmbreeScene&, const Frame&, int threads);

} // namespace rebound::lab
