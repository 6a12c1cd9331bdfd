// SPDX-License-Identifier: MIT
// bakeScene() with what only tests ask for.
#pragma once

#include "rebound/bake/bake_scene.hpp"

namespace rebound::detail {

// gridShift: of the grid along each axis [spacings].
Result<Bake> bakeScene(const BakeGeometry&, const RayCaster&, const BakeSettings&, float gridShift);

} // namespace rebound::detail
