// SPDX-License-Identifier: MIT
#include "lab/images/draw_text.hpp"

#include <algorithm>

namespace rebound::lab {

namespace {

constexpr unsigned char ink = 235;

void drawDot(Picture& picture, int left, int top, int size) {
    for (int y = top; y < top + size; ++y)
        for (int x = left; x < left + size; ++x)
            std::fill_n(&picture.rgb[(size_t(y) * size_t(picture.width) + size_t(x)) * 3], 3, ink);
}

void drawGlyph(Picture& picture, const Glyph& glyph, int left, int top, int scale) {
    for (int column = 0; column < glyphWidth; ++column)
        for (int row = 0; row < glyphHeight; ++row)
            if ((glyph[size_t(column)] >> row) & 1)
                drawDot(picture, left + column * scale, top + row * scale, scale);
}

} // namespace

void drawText(Picture& picture, std::string_view text, int left, int top, int scale) {
    for (size_t i = 0; i < text.size(); ++i)
        drawGlyph(picture, glyphOf(text[i]), left + int(i) * textAdvance * scale, top, scale);
}

} // namespace rebound::lab
