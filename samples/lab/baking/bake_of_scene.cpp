// SPDX-License-Identifier: MIT
#include "lab/baking/bake_of_scene.hpp"

#include "lab/baking/scene_geometry.hpp"
#include "rebound/embree/ray_caster.hpp"

namespace rebound::lab {

Result<Bake> bakeOfScene(std::shared_ptr<const EmbreeScene> scene, const BakeSettings& settings) {
    const BakeGeometry geometry = geometryOf(std::move(scene));
    auto rays = EmbreeRayCaster::build(geometry);
    if (!rays) return rays.error();
    return bakeScene(geometry, *rays, settings);
}

} // namespace rebound::lab
