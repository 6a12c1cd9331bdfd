// SPDX-License-Identifier: MIT
// Bakes of the lab's scenes: from a file, or baked once and kept under the hash of what they depend on.
#pragma once

#include "lab/rays/embree_scene.hpp"
#include "rebound/bake/bake.hpp"
#include "rebound/bake/bake_scene.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace rebound::lab {

// Of a scene and settings, and of the baker's own code: 32 hexadecimal digits.
std::string bakeKey(const Scene&, const BakeSettings&);

// Where bakes are kept: REBOUND_CACHE of the environment, or XDG_CACHE_HOME/rebound, or ~/.cache/rebound, or, where none
// of them is set, a folder for temporary files.
std::filesystem::path bakeFolder();

struct ObtainedBake {
    Bake bake;
    std::filesystem::path file;
    double seconds = 0.0; // that baking took; 0: it was there
};

// <folder>/<bakeKey>.bake, which is made where it is missing, damaged or of another version.
Result<ObtainedBake> keptBake(std::shared_ptr<const EmbreeScene>, const BakeSettings&,
                              const std::filesystem::path& folder);

} // namespace rebound::lab
