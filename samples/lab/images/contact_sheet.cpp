// SPDX-License-Identifier: MIT
#include "lab/images/draw_text.hpp"
#include "lab/images/image_files.hpp"

#include <algorithm>
#include <string_view>

namespace rebound::lab {

namespace {

constexpr unsigned char background = 32;
constexpr int margin = 8; // around the sheet, between cells, and between a caption and its picture [pixels]
constexpr int largestFontScale = 2; // pixels a dot of the font

// Bytes that continue a UTF-8 character are dropped, so that each character takes one place.
std::string onePlaceACharacter(std::string_view text) {
    std::string places;
    for (const char c : text)
        if ((static_cast<unsigned char>(c) & 0xc0u) != 0x80u) places.push_back(c);
    return places;
}

struct Layout {
    int columns = 1;
    int rows = 1;
    int cellWidth = 0;
    int pictureHeight = 0;
    int fontScale = 1;

    int captionHeight() const { return glyphHeight * fontScale; }
    int cellHeight() const { return captionHeight() + margin / 2 + pictureHeight; }
    int width() const { return margin + columns * (cellWidth + margin); }
    int height() const { return margin + rows * (cellHeight() + margin); }
};

Layout layOut(const std::vector<CaptionedPicture>& pictures, int columns) {
    Layout layout;
    const int count = int(pictures.size());
    layout.columns = std::clamp(columns, 1, count);
    layout.rows = (count + layout.columns - 1) / layout.columns;
    size_t longest = 1;
    for (const CaptionedPicture& captioned : pictures) {
        layout.cellWidth = std::max(layout.cellWidth, captioned.picture.width);
        layout.pictureHeight = std::max(layout.pictureHeight, captioned.picture.height);
        longest = std::max(longest, onePlaceACharacter(captioned.caption).size());
    }
    const size_t fitting = size_t(layout.cellWidth) / (longest * size_t(textAdvance));
    layout.fontScale = std::clamp(int(fitting), 1, largestFontScale);
    return layout;
}

// A caption that is too long ends in three dots.
void drawCaption(Picture& sheet, const std::string& caption, int left, int top, const Layout& layout) {
    std::string text = onePlaceACharacter(caption);
    const size_t places = size_t(layout.cellWidth / (textAdvance * layout.fontScale));
    if (text.size() > places)
        text = text.substr(0, places > 3 ? places - 3 : 0) + std::string(std::min<size_t>(places, 3), '.');
    drawText(sheet, text, left, top, layout.fontScale);
}

void drawPicture(Picture& sheet, const Picture& picture, int left, int top) {
    const size_t rowBytes = size_t(picture.width) * 3;
    for (size_t y = 0; y < size_t(picture.height); ++y)
        std::copy_n(&picture.rgb[y * rowBytes], rowBytes,
                    &sheet.rgb[((size_t(top) + y) * size_t(sheet.width) + size_t(left)) * 3]);
}

bool drawable(const Picture& picture) {
    return picture.width > 0 && picture.height > 0 &&
           picture.rgb.size() == size_t(picture.width) * size_t(picture.height) * 3;
}

} // namespace

Picture contactSheet(const std::vector<CaptionedPicture>& pictures, int columns) {
    if (pictures.empty()) return {};
    const Layout layout = layOut(pictures, columns);
    Picture sheet{layout.width(), layout.height(), {}};
    sheet.rgb.assign(size_t(sheet.width) * size_t(sheet.height) * 3, background);
    for (int i = 0; i < int(pictures.size()); ++i) {
        const CaptionedPicture& captioned = pictures[size_t(i)];
        const int left = margin + i % layout.columns * (layout.cellWidth + margin);
        const int top = margin + i / layout.columns * (layout.cellHeight() + margin);
        drawCaption(sheet, captioned.caption, left, top, layout);
        if (drawable(captioned.picture))
            drawPicture(sheet, captioned.picture, left, top + layout.captionHeight() + margin / 2);
    }
    return sheet;
}

} // namespace rebound::lab
