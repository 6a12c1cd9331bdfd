// SPDX-License-Identifier: MIT
// What a bake holds, drawn into a view of its scene.
#pragma once

#include "lab/images/image_files.hpp"
#include "lab/rays/frame.hpp"
#include "rebound/bake/bake.hpp"

#include <string>
#include <vector>

namespace rebound::lab {

struct NamedPicture {
    std::string name; // of a file, without its ending
    std::string caption;
    Picture picture;
};

// surfels, patches of three levels of the tree, caches of the grid, the links of the cache nearest to the picture's middle,
// and the light map's texels. mapPlaces: as mapPlacesOf() gives them; empty: there is no map.
std::vector<NamedPicture> picturesOf(const Bake&, const Frame&, const Image& mapPlaces);

} // namespace rebound::lab
