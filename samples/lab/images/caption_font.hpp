// SPDX-License-Identifier: MIT
// A five by seven dot font for the captions of pictures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rebound::lab {

inline constexpr int glyphWidth = 5;
inline constexpr int glyphHeight = 8; // the lowest row is for descenders

// One byte a column, from the left; its lowest bit is the top row.
using Glyph = std::array<uint8_t, glyphWidth>;

// The glyph of a printable ASCII character, and of a question mark for every other.
const Glyph& glyphOf(char);

} // namespace rebound::lab
