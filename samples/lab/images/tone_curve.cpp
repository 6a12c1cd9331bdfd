// SPDX-License-Identifier: MIT
#include "lab/images/image_files.hpp"

#include "lab/images/luminance.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::lab {

namespace {

constexpr unsigned char magenta[3] = {255, 0, 255};

float linearToSrgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float srgbToLinear(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

// Rec. 709 luminance; of an image of one or two channels, the first.
float brightness(const float* pixel, int channels) {
    return channels < 3 ? pixel[0] : luminance({pixel[0], pixel[1], pixel[2]});
}

unsigned char encode(float radiance, const ToneCurve& curve) {
    return static_cast<unsigned char>(std::lround(255.0f * displayValue(radiance, curve)));
}

void encodePixel(const float* pixel, int channels, const ToneCurve& curve, unsigned char* rgb) {
    const int colours = std::min(channels, 3);
    if (!std::all_of(pixel, pixel + colours, [](float value) { return std::isfinite(value); })) {
        std::copy_n(magenta, 3, rgb);
        return;
    }
    for (int c = 0; c < 3; ++c) {
        if (c < colours) rgb[c] = encode(pixel[c], curve);
        else rgb[c] = colours == 1 ? rgb[0] : static_cast<unsigned char>(0);
    }
}

} // namespace

float displayValue(float radiance, const ToneCurve& curve) {
    const float linear = 1.0f - std::exp(-std::max(radiance, 0.0f) * curve.exposure);
    return std::clamp(linearToSrgb(linear), 0.0f, 1.0f);
}

ToneCurve automaticToneCurve(const Image& image) {
    std::vector<float> luminances;
    luminances.reserve(image.data.size() / size_t(std::max(image.channels, 1)));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (const float l = brightness(image.at(x, y), image.channels); l > 0.0f && std::isfinite(l))
                luminances.push_back(l);
    if (luminances.empty()) return {};
    const auto percentile = luminances.begin() + std::ptrdiff_t((luminances.size() - 1) * 9 / 10);
    std::nth_element(luminances.begin(), percentile, luminances.end());
    // 0.8 is the picture's value, so the curve before sRGB has to reach what 0.8 decodes to.
    const double exposure = -std::log1p(-double(srgbToLinear(0.8f))) / double(*percentile);
    return {static_cast<float>(std::min(exposure, double(std::numeric_limits<float>::max())))};
}

Picture toneMap(const Image& image, const ToneCurve& curve) {
    Picture picture{image.width, image.height, {}};
    picture.rgb.resize(size_t(image.width) * size_t(image.height) * 3);
    unsigned char* rgb = picture.rgb.data();
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x, rgb += 3)
            encodePixel(image.at(x, y), image.channels, curve, rgb);
    return picture;
}

} // namespace rebound::lab
