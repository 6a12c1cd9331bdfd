// SPDX-License-Identifier: MIT
#include "lab/baking/bake_of_scene.hpp"

#include "lab/baking/scene_geometry.hpp"
#include "rebound/embree/ray_caster.hpp"

namespace rebound::lab {

Result<Bake> bakeOfScene(std::shared_ptr<const EmbreeScene> scene, const BakeSettings& settings) {
    LocalBakeCrew alone;
    auto bake = bakeOfScene(std::move(scene), settings, alone);
    if (!bake) return bake.error();
    return **std::move(bake);
}

Result<std::optional<Bake>> bakeOfScene(std::shared_ptr<const EmbreeScene> scene,
                                        const BakeSettings& settings, BakeCrew& crew) {
    const BakeGeometry geometry = geometryOf(std::move(scene));
    auto rays = EmbreeRayCaster::build(geometry);
    if (!rays) return rays.error();
    return bakeScene(geometry, *rays, settings, crew);
}

} // namespace rebound::lab
