// SPDX-License-Identifier: MIT
// Bakes a scene of the lab.
#pragma once

#include "lab/rays/embree_scene.hpp"
#include "rebound/bake/bake_scene.hpp"

#include <memory>

namespace rebound::lab {

Result<Bake> bakeOfScene(std::shared_ptr<const EmbreeScene>, const BakeSettings&);

// By a crew; nothing in a process that only helps.
Result<std::optional<Bake>> bakeOfScene(std::shared_ptr<const EmbreeScene>, const BakeSettings&, BakeCrew&);

} // namespace rebound::lab
