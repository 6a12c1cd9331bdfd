// SPDX-License-Identifier: MIT
// Primaries that an OpenEXR file's header states.
#pragma once

#include "lab/images/image.hpp"
#include "rebound/result.hpp"

#include <ImfHeader.h>

#include <glm/glm.hpp>

#include <optional>

namespace rebound::lab {

// From the header's primaries to those of Rec. 709, its white staying white (Bradford's adaptation; Lindbloom). Nothing
// where the header states none, or Rec. 709's. Fails where they span no colours.
Result<std::optional<glm::dmat3>> toRec709(const Imf::Header&);

// Applies it to the first three channels.
void convertColors(Image&, const glm::dmat3&);

} // namespace rebound::lab
