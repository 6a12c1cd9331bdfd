// SPDX-License-Identifier: MIT
// Text in pictures.
#pragma once

#include "lab/images/caption_font.hpp"
#include "lab/images/image_files.hpp"

#include <string_view>

namespace rebound::lab {

inline constexpr int textAdvance = glyphWidth + 1; // from one character to the next [dots of the font]

// Light letters over what is there, from the left and top [pixels], a dot of the font `scale` pixels wide.
// One place a byte; bytes that are not printable ASCII become question marks. The text has to fit in the
// picture.
void drawText(Picture&, std::string_view text, int left, int top, int scale);

} // namespace rebound::lab
