// SPDX-License-Identifier: MIT
// Bakes of small scenes.
#pragma once

#include "rebound/bake/bake_scene.hpp"
#include "rebound/embree/ray_caster.hpp"

#include "bake_parts.hpp"
#include "shapes.hpp"

#include <doctest/doctest.h>

inline rebound::BakeSettings smallSettings() {
    rebound::BakeSettings settings;
    settings.surfels = 1500;
    settings.caches = 300;
    settings.links = 32;
    settings.threads = 2;
    return settings;
}

// Of 4 x 3 x 5 m, a corner at the origin.
inline rebound::BakeGeometry closedBox() {
    rebound::BakeGeometry geometry;
    addBox(geometry, {0, 0, 0}, {4, 3, 5}, true);
    return geometry;
}

// Rooms of 3 x 3 x 3 m, and a wall of that thickness between [m]; the first ends at x = 3.
inline rebound::BakeGeometry twoRooms(float wall) {
    rebound::BakeGeometry geometry;
    addBox(geometry, {0, 0, 0}, {3, 3, 3}, true);
    addBox(geometry, {3 + wall, 0, 0}, {6 + wall, 3, 3}, true);
    return geometry;
}

inline rebound::Bake bakeOf(const rebound::BakeGeometry& geometry,
                            const rebound::BakeSettings& settings = smallSettings(), float shift = 0.0f,
                            const rebound::detail::MapRemedies& remedies = {}) {
    const auto caster = rebound::EmbreeRayCaster::build(geometry);
    REQUIRE_MESSAGE(caster, caster.error().message);
    rebound::LocalBakeCrew alone;
    auto bake = rebound::detail::bakeScene(geometry, *caster, settings, {shift, remedies}, alone);
    REQUIRE_MESSAGE(bake, bake.error().message);
    return **bake;
}
