// SPDX-License-Identifier: MIT
// Whether a frame's images hold what their names promise: most wrong pictures come from wrong inputs.
#pragma once

#include "lab/rays/frame.hpp"

#include <functional>
#include <string>

namespace rebound::lab {

// Direct light, albedo and emission have to be finite and not negative, albedo at most 1, depth finite and
// not negative, and normals unit vectors wherever there is a surface, but for the few that averaging
// over an edge has shortened. The error names the image, by what nameOfImage makes of depth, normal, albedo,
// direct or emission, the number of wrong pixels and the first of them.
Result<> checkFrame(const Frame&, const std::function<std::string(const char*)>& nameOfImage);

} // namespace rebound::lab
