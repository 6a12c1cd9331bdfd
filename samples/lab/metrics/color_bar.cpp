// SPDX-License-Identifier: MIT
#include "lab/metrics/color_bar.hpp"

#include "lab/images/draw_text.hpp"
#include "lab/metrics/color_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace rebound::metrics {

namespace {

constexpr unsigned char background = 32;
constexpr unsigned char ink = 235;
constexpr int margin = 6;          // between picture, bar, labels and edge [pixels at a font scale of 1]
constexpr int barWidth = 12;       // likewise
constexpr int tickLength = 3;      // likewise
constexpr int leastBarHeight = 80; // labels do not touch
constexpr int heightForLargeText = 400;

std::string labelOf(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

struct Layout {
    int scale = 1;  // pixels a dot of the font
    int left = 0;   // of the bar
    int top = 0;    // of the bar: half a label stands above its end
    int height = 0; // of the bar

    int labelsLeft() const { return left + (barWidth + tickLength + margin / 2) * scale; }
    int row(double share) const { return top + int(std::lround((1.0 - share) * double(height - 1))); }
};

void fill(lab::Picture& picture, int left, int y, int width, const std::array<unsigned char, 3>& color) {
    for (int x = left; x < left + width; ++x)
        std::copy_n(color.data(), 3, &picture.rgb[(size_t(y) * size_t(picture.width) + size_t(x)) * 3]);
}

void drawBar(lab::Picture& picture, const Layout& layout, const std::vector<double>& ticks) {
    for (int y = 0; y < layout.height; ++y)
        fill(picture, layout.left, layout.top + y, barWidth * layout.scale,
             viridis(1.0 - double(y) / double(layout.height - 1)));
    for (const double tick : ticks) {
        const int row = layout.row(tick / ticks.back());
        fill(picture, layout.left + barWidth * layout.scale, row, tickLength * layout.scale, {ink, ink, ink});
        // Digits are seven dots high; their middle is the fourth.
        lab::drawText(picture, labelOf(tick), layout.labelsLeft(), row - 3 * layout.scale, layout.scale);
    }
}

void drawPicture(lab::Picture& canvas, const lab::Picture& picture) {
    const size_t rowBytes = size_t(picture.width) * 3;
    for (size_t y = 0; y < size_t(picture.height); ++y)
        std::copy_n(&picture.rgb[y * rowBytes], rowBytes, &canvas.rgb[y * size_t(canvas.width) * 3]);
}

} // namespace

double roundedUp(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0})
        if (value <=
            step * power * (1.0 + 1e-6)) // so that a difference of floats that should be 0.2 stays 0.2
            return step * power;
    return 10.0 * power;
}

std::vector<double> ticksUpTo(double largest) {
    const double step = roundedUp(largest / 5.0);
    std::vector<double> ticks;
    for (int i = 0; double(i) * step < largest - 0.5 * step; ++i) ticks.push_back(double(i) * step);
    ticks.push_back(largest);
    return ticks;
}

lab::Picture withColorBar(const lab::Picture& picture, double largest) {
    const std::vector<double> ticks = ticksUpTo(largest);
    size_t longest = 0;
    for (const double tick : ticks) longest = std::max(longest, labelOf(tick).size());
    Layout layout;
    layout.scale = picture.height >= heightForLargeText ? 2 : 1;
    layout.left = picture.width + margin * layout.scale;
    layout.top = lab::glyphHeight / 2 * layout.scale;
    layout.height = std::max(picture.height - 2 * layout.top, leastBarHeight);
    const int textWidth = int(longest) * lab::textAdvance * layout.scale;
    lab::Picture canvas{layout.labelsLeft() + textWidth + margin * layout.scale,
                        std::max(picture.height, layout.height + 2 * layout.top),
                        {}};
    canvas.rgb.assign(size_t(canvas.width) * size_t(canvas.height) * 3, background);
    drawPicture(canvas, picture);
    drawBar(canvas, layout, ticks);
    return canvas;
}

} // namespace rebound::metrics
