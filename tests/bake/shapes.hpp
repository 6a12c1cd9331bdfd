// SPDX-License-Identifier: MIT
// Geometry for tests.
#pragma once

#include "rebound/bake/geometry.hpp"

#include <array>
#include <cmath>
#include <numbers>

// A parallelogram of two triangles; its front is where `right` x `up` points.
inline void addQuad(rebound::BakeGeometry& geometry, glm::vec3 corner, glm::vec3 right, glm::vec3 up) {
    const auto first = uint32_t(geometry.positions.size());
    for (const glm::vec3 offset : {glm::vec3(0), right, right + up, up})
        geometry.positions.push_back(corner + offset);
    for (const uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) geometry.indices.push_back(first + index);
}

// Six quads; fronts outside, or inside.
inline void addBox(rebound::BakeGeometry& geometry, glm::vec3 lower, glm::vec3 upper,
                   bool frontsInside = false) {
    const glm::vec3 size = upper - lower;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 u(0), v(0), w(0);
        u[(axis + 1) % 3] = size[(axis + 1) % 3];
        v[(axis + 2) % 3] = size[(axis + 2) % 3];
        w[axis] = size[axis];
        if (frontsInside) std::swap(u, v);
        addQuad(geometry, lower + w, u, v);
        addQuad(geometry, lower, v, u);
    }
}

// Of rings of quads between its poles, fronts outside.
inline void addSphere(rebound::BakeGeometry& geometry, glm::vec3 centre, float radius, uint32_t rings) {
    const uint32_t sectors = 2 * rings;
    const auto first = uint32_t(geometry.positions.size());
    for (uint32_t ring = 0; ring <= rings; ++ring)
        for (uint32_t sector = 0; sector < sectors; ++sector) {
            const double polar = std::numbers::pi * double(ring) / double(rings);
            const double around = 2.0 * std::numbers::pi * double(sector) / double(sectors);
            geometry.positions.push_back(centre + radius * glm::vec3(std::sin(polar) * std::cos(around),
                                                                     std::cos(polar),
                                                                     std::sin(polar) * std::sin(around)));
        }
    for (uint32_t ring = 0; ring < rings; ++ring)
        for (uint32_t sector = 0; sector < sectors; ++sector) {
            const uint32_t a = first + ring * sectors + sector;
            const uint32_t b = first + ring * sectors + (sector + 1) % sectors;
            for (const uint32_t index : {a, b, a + sectors, b, b + sectors, a + sectors})
                geometry.indices.push_back(index);
        }
}
