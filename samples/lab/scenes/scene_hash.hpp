// SPDX-License-Identifier: MIT
// Hashes of what scenes hold, for keys of what is computed from them.
#pragma once

#include "lab/scenes/content_hash.hpp"
#include "lab/scenes/scene.hpp"

namespace rebound::lab {

// Meshes, materials and textures: what a bake depends on.
void addGeometry(ContentHash&, const Scene&);
// Lights, the environment, and whether emissive surfaces are lights.
void addLights(ContentHash&, const Scene&);
void add(ContentHash&, const CameraView&);

} // namespace rebound::lab
