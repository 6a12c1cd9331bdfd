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

// Any of Y | R,G,B | R,G,B,A, half or float.
Result<Image> readExr(const std::filesystem::path&);

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
