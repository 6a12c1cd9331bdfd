// SPDX-License-Identifier: MIT
#include "pictures.hpp"

#include "lab/images/luminance.hpp"
#include "lab/images/reduce.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rebound::cli {

namespace {

constexpr int largestSide = 800; // of a picture on the sheet [pixels]

unsigned char byteOf(float value) {
    return static_cast<unsigned char>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

unsigned char sRgbByteOf(float linear) {
    return byteOf(linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f);
}

template <class ToByte>
lab::Picture pictureOf(const lab::Image& image, const ToByte& toByte) {
    lab::Picture picture{image.width, image.height, {}};
    picture.rgb.reserve(image.data.size() / size_t(image.channels) * 3);
    for (size_t i = 0; i < image.data.size(); i += size_t(image.channels))
        for (size_t c = 0; c < 3; ++c)
            picture.rgb.push_back(toByte(image.data[i + (image.channels == 3 ? c : 0)]));
    return picture;
}

// Black where there is none.
lab::Picture normalPicture(const lab::Image& normals) {
    lab::Picture picture =
        pictureOf(normals, [](float component) { return byteOf(component * 0.5f + 0.5f); });
    for (size_t i = 0; i < normals.data.size(); i += 3)
        if (normals.data[i] == 0.0f && normals.data[i + 1] == 0.0f && normals.data[i + 2] == 0.0f)
            std::fill_n(&picture.rgb[i], 3, static_cast<unsigned char>(0));
    return picture;
}

// Black for nothing; of the rest, the nearest and a far surface that outliers do not set.
struct DepthSpan {
    float nearest = 0.0f;
    float far = 0.0f;
};

DepthSpan spanOf(const lab::Image& depth) {
    std::vector<float> sorted;
    std::copy_if(depth.data.begin(), depth.data.end(), std::back_inserter(sorted),
                 [](float d) { return d > 0.0f; });
    if (sorted.empty()) return {};
    std::sort(sorted.begin(), sorted.end());
    return {sorted.front(), sorted[(sorted.size() - 1) * 98 / 100]};
}

lab::Picture depthPicture(const lab::Image& depth, const DepthSpan& span) {
    constexpr float darkest = 0.15f;
    const float range = std::max(span.far - span.nearest, 1e-30f);
    return pictureOf(depth, [&](float d) {
        return d > 0.0f ? byteOf(std::max(1.0f - (1.0f - darkest) * (d - span.nearest) / range, darkest))
                        : byteOf(0);
    });
}

std::string depthCaption(const DepthSpan& span) {
    char text[80];
    std::snprintf(text, sizeof text, "depth, %.3g m (white) to %.3g m", double(span.nearest),
                  double(span.far));
    return text;
}

} // namespace

lab::Picture contactSheetOf(const RenderedImages& images, const lab::Frame& frame,
                            const lab::ToneCurve& curve) {
    const int factor = (std::max(frame.depth.width, frame.depth.height) + largestSide - 1) / largestSide;
    const auto shown = [&](const lab::Image& image) {
        return lab::toneMap(lab::reduced(image, factor), curve);
    };
    const DepthSpan span = spanOf(frame.depth);
    return lab::contactSheet({{"direct", shown(images.direct)},
                              {"indirect, albedo not in it", shown(images.indirect)},
                              {"final = direct + albedo * indirect", shown(images.final)},
                              {"albedo", pictureOf(lab::reduced(frame.albedo, factor), sRgbByteOf)},
                              {"normals, world space", normalPicture(lab::reduced(frame.normal, factor))},
                              {depthCaption(span), depthPicture(lab::reduced(frame.depth, factor), span)}},
                             3);
}

lab::Picture differencePicture(const lab::Image& difference, double scale) {
    // Ends of equal lightness (Moreland's cool-warm map).
    constexpr glm::vec3 cold(0.230f, 0.299f, 0.754f), warm(0.706f, 0.016f, 0.150f);
    lab::Picture picture{difference.width, difference.height, {}};
    for (size_t i = 0; i < difference.data.size(); i += 3) {
        const float value =
            lab::luminance({difference.data[i], difference.data[i + 1], difference.data[i + 2]});
        const float share = std::clamp(value / float(std::max(scale, 1e-30)), -1.0f, 1.0f);
        const glm::vec3 color = glm::mix(glm::vec3(0.97f), share < 0.0f ? cold : warm, std::abs(share));
        for (int c = 0; c < 3; ++c) picture.rgb.push_back(byteOf(color[c]));
    }
    return picture;
}

} // namespace rebound::cli
