// SPDX-License-Identifier: MIT
// What the atrium is built of. Every part is a closed solid or a few of them.
#pragma once

#include "lab/scenes/mesh_builder.hpp"

#include <glm/glm.hpp>

namespace rebound::lab {

// A vertical plane to build on: `along` to the right of someone who looks against `through`.
struct WallPlane {
    glm::vec3 origin{0.0f};
    glm::vec3 along{1, 0, 0};
    glm::vec3 through{0, 0, 1};

    glm::vec3 at(float s, float height, float t) const {
        return origin + s * along + glm::vec3(0.0f, height, 0.0f) + t * through;
    }
};

// A wall from s = begin to end and from `spring` to `top`, cut from below by a half circle of that radius.
struct Arch {
    float begin = 0.0f;
    float end = 0.0f;
    float spring = 0.0f;
    float top = 0.0f;
    float radius = 0.0f;
    float thickness = 0.5f;
};
void addArch(MeshBuilder&, const WallPlane&, const Arch&);

// A round column on a square plinth under a square abacus. `radius`: of the shaft at its foot.
void addColumn(MeshBuilder&, const glm::vec3& foot, float height, float radius);

// Rails and balusters between s = begin and end.
void addBalustrade(MeshBuilder&, const WallPlane&, float begin, float end, float floor);

// A cloth that hangs from its upper edge and folds more the lower it is. `folds` and `phase` [rad] vary it.
struct Drape {
    float middle = 0.0f;
    float width = 1.0f;
    float top = 0.0f;
    float bottom = 0.0f;
    float folds = 5.0f;
    float phase = 0.0f;
};
void addDrape(MeshBuilder&, const WallPlane&, const Drape&);

// An open vase, and leaves in it.
void addVase(MeshBuilder&, const glm::vec3& foot, float height);
void addPlant(MeshBuilder&, const glm::vec3& foot, float height, int leaves, float phase);

} // namespace rebound::lab
