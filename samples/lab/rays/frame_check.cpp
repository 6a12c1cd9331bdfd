// SPDX-License-Identifier: MIT
#include "lab/rays/frame_check.hpp"

#include <cmath>
#include <cstdio>

namespace rebound::lab {

namespace {

// Normals in half precision, or in 8 bits a component, are of unit length to within 1 %.
constexpr float normalTolerance = 0.02f;
// Shorter ones are averages over the edge of a surface; that many of the pixels may be such.
constexpr double shortNormalShare = 0.01;
constexpr float shortestNormal = 0.01f;
// Albedo of 1 in half precision, filtered.
constexpr float albedoTolerance = 0.002f;

struct WrongPixels {
    size_t count = 0;
    int x = 0;
    int y = 0;
};

template <class IsWrong>
WrongPixels findWrong(const Image& image, const IsWrong& isWrong) {
    WrongPixels wrong;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (isWrong(x, y, image.at(x, y)) && wrong.count++ == 0) {
                wrong.x = x;
                wrong.y = y;
            }
    return wrong;
}

std::string valueText(const float* value, int channels) {
    std::string text;
    for (int c = 0; c < channels; ++c) {
        char number[32];
        std::snprintf(number, sizeof number, "%g", double(value[c]));
        text.append(c == 0 ? "" : " ").append(number);
    }
    return text;
}

Error wrongImage(const std::string& name, const Image& image, const WrongPixels& wrong,
                 const std::string& what) {
    return {ErrorCode::invalidData,
            name + ": " + std::to_string(wrong.count) + (wrong.count == 1 ? " pixel is " : " pixels are ") +
                what + ", the first at " + std::to_string(wrong.x) + ", " + std::to_string(wrong.y) + " (" +
                valueText(image.at(wrong.x, wrong.y), image.channels) + ")"};
}

bool anyOf(const float* pixel, int channels, bool (*test)(float)) {
    for (int c = 0; c < channels; ++c)
        if (test(pixel[c])) return true;
    return false;
}

Result<> checkRange(const std::string& name, const Image& image) {
    const int channels = image.channels;
    const auto notFinite = findWrong(image, [&](int, int, const float* pixel) {
        return anyOf(pixel, channels, [](float value) { return !std::isfinite(value); });
    });
    if (notFinite.count > 0) return wrongImage(name, image, notFinite, "not finite");
    const auto negative = findWrong(image, [&](int, int, const float* pixel) {
        return anyOf(pixel, channels, [](float value) { return value < 0.0f; });
    });
    if (negative.count > 0) return wrongImage(name, image, negative, "negative");
    return {};
}

Result<> checkAlbedo(const std::string& name, const Image& image) {
    if (auto inRange = checkRange(name, image); !inRange) return inRange;
    const auto above = findWrong(image, [](int, int, const float* pixel) {
        return anyOf(pixel, 3, [](float value) { return value > 1.0f + albedoTolerance; });
    });
    if (above.count > 0) return wrongImage(name, image, above, "above 1");
    return {};
}

float lengthOf(const float* n) { return std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]); }

Result<> checkNormals(const std::string& name, const Image& image, const Image& depth) {
    const auto findLengths = [&](auto isWrong) {
        return findWrong(image, [&](int x, int y, const float* n) {
            return *depth.at(x, y) > 0.0f && isWrong(lengthOf(n));
        });
    };
    const auto unusable = findLengths(
        [](float length) { return !(length >= shortestNormal && length <= 1.0f + normalTolerance); });
    if (unusable.count > 0)
        return wrongImage(name, image, unusable,
                          "zero, too long or not finite where unit vectors were expected");
    const auto tooShort = findLengths([](float length) { return length < 1.0f - normalTolerance; });
    if (double(tooShort.count) > shortNormalShare * double(depth.data.size()))
        return wrongImage(name, image, tooShort, "too short where unit vectors were expected");
    return {};
}

} // namespace

Result<> checkFrame(const Frame& frame, const std::function<std::string(const char*)>& nameOfImage) {
    if (auto complete = validate(frame); !complete) return complete;
    if (auto depth = checkRange(nameOfImage("depth"), frame.depth); !depth) return depth;
    if (auto normal = checkNormals(nameOfImage("normal"), frame.normal, frame.depth); !normal) return normal;
    if (auto albedo = checkAlbedo(nameOfImage("albedo"), frame.albedo); !albedo) return albedo;
    if (auto direct = checkRange(nameOfImage("direct"), frame.direct); !direct) return direct;
    return frame.emission.empty() ? Result<>() : checkRange(nameOfImage("emission"), frame.emission);
}

} // namespace rebound::lab
