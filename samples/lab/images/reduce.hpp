// SPDX-License-Identifier: MIT
// Smaller pictures.
#pragma once

#include "lab/images/image.hpp"
#include "lab/images/image_files.hpp"

namespace rebound::lab {

// The mean of factor x factor pixels, fewer at the right and lower edge. factor: at least 1.
Image reduced(const Image&, int factor);
Picture reduced(const Picture&, int factor);

} // namespace rebound::lab
