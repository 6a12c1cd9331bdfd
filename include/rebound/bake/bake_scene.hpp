// SPDX-License-Identifier: MIT
// Bakes static geometry for illuminance composition.
#pragma once

#include "rebound/bake/bake.hpp"
#include "rebound/bake/bake_crew.hpp"
#include "rebound/bake/geometry.hpp"
#include "rebound/bake/rays.hpp"
#include "rebound/result.hpp"

#include <functional>
#include <optional>
#include <string_view>

namespace rebound {

enum class BakeHierarchy {
    cluster, // the two nearest clusters join, by place, normal, what they see of the open, and whether they emit
    kdTree, // halves of what is furthest apart by the same; faster to build, coarser light
    paper,  // the two nearest clusters join, by place, normal and size   [PIC, sec. 4.3]; to compare
};

struct BakeSettings {
    uint32_t surfels = 32768; // about so many, 1 to 2^20; sides that light can reach
    uint32_t caches = 10000;  // at most so many, 8 to 2^24: the grid's spacing follows from it
    float spacing = 0.0f;     // of the grid [m]; 0: as fine as `caches` allows
    uint32_t lightMap =
        0; // caches on surfaces beside those of the grid, about so many, 0 to 2^20; 0: no light map
    uint32_t links = 128;     // of each cache, 1 to 4096
    uint32_t bands = 3;       // of spherical harmonics, 2 to 4
    uint32_t raysPerLink = 8; // that tell how much of its sender a cache sees, 1 to 1024   [PIC, N']
    LinkForm linkForm = LinkForm::coefficients;
    BakeHierarchy hierarchy = BakeHierarchy::cluster;
    uint32_t seed = 0;
    int threads = 0; // 0: one a core; the bake is the same for any number
    // Called now and then with what is being done and which share of it is, 0 to 1; by one thread at a time.
    std::function<void(std::string_view, double)> progress = {};
};

// Fails where a setting is out of range; names it.
Result<> validate(const BakeSettings&);

Result<Bake> bakeScene(const BakeGeometry&, const RayCaster&, const BakeSettings&);

// The same bits, with the costly work done by a crew: each process of it calls this with the same arguments. Nothing in a
// process that only helps.
Result<std::optional<Bake>> bakeScene(const BakeGeometry&, const RayCaster&, const BakeSettings&, BakeCrew&);

} // namespace rebound
