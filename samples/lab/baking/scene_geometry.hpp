// SPDX-License-Identifier: MIT
// A scene of the lab as the baker takes it.
#pragma once

#include "lab/rays/embree_scene.hpp"
#include "rebound/bake/geometry.hpp"

#include <memory>
#include <vector>

namespace rebound::lab {

// All triangles of the scene, in the order of its meshes. The result refers to the scene, which has to outlive it.
BakeGeometry geometryOf(std::shared_ptr<const EmbreeScene>);

// Numbers there of each mesh's first triangle.
std::vector<uint32_t> firstTrianglesOf(const Scene&);

} // namespace rebound::lab
