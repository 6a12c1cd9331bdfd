// SPDX-License-Identifier: MIT
// OpenEXR in and out, PNG out. Files are written to a temporary name beside their own and renamed.
#pragma once

#include "lab/images/image.hpp"
#include "rebound/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rebound::lab {

enum class ExrPrecision { half, full };

// Channels R, G, B (and A), or Y; zip compressed. Values beyond half's range are stored as its largest.
Result<> writeExr(const std::filesystem::path&, const Image&, ExrPrecision = ExrPrecision::half);

// What a picture's values stand for, and so in which channels they may be.
enum class ExrContent {
    any,    // Y, Z or V; R,G,B with or without A; X,Y,Z
    color,  // R,G,B, or Y for grey
    normal, // R,G,B or X,Y,Z
    depth,  // Y, Z or V, or a single channel of any name
};

struct ExrReading {
    ExrContent content = ExrContent::any;
    float outside = 0.0f; // of pixels of the display window that the file holds nothing of
    std::vector<std::string>* notes = nullptr; // gets sentences of what was converted or left out
};

// A picture of the size of the display window, half or float, of a file with one part and one layer. Colours become
// those of Rec. 709 where the header states other primaries. Channels that leave open which of them are meant are an
// error that names them.
Result<Image> readExr(const std::filesystem::path&, const ExrReading& = {});

// The lab's one tone curve, stated wherever a picture is shown: exposure, then 1 - exp(-x), then sRGB.
struct ToneCurve {
    float exposure = 1.0f; // factor on radiance
};

// What the curve makes of one finite channel: its sRGB-encoded value, 0 to 1.
float displayValue(float radiance, const ToneCurve&);

// An exposure that maps the 90th percentile of the finite positive luminance to 0.8 after the curve.
ToneCurve automaticToneCurve(const Image& radiance);

// 8-bit sRGB picture through the tone curve. NaN and infinities show as magenta.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<unsigned char> rgb;
};
Picture toneMap(const Image&, const ToneCurve&);
Result<> writePng(const std::filesystem::path&, const Picture&);

// Pictures side by side on a grid with a caption above each.
struct CaptionedPicture {
    std::string caption;
    Picture picture;
};
Picture contactSheet(const std::vector<CaptionedPicture>&, int columns);

} // namespace rebound::lab
