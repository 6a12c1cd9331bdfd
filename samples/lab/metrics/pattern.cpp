// SPDX-License-Identifier: MIT
#include "lab/metrics/pattern.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace rebound::metrics {

namespace {

constexpr int side = patternBlock;

// Cosine of 10 degrees: a round column 12 pixels wide turns by less from pixel to pixel in its middle; where walls meet, or
// leaves overlap, it is more.
constexpr float leastCosine = 0.985f;
// How far 1 / depth may bend from pixel to pixel, over itself: it is affine over the screen on a plane, however steeply
// that is seen.
constexpr double largestBend = 0.01;

bool isSurface(const Surfaces& s, int x, int y) {
    const float z = *s.depth->at(x, y);
    return z > 0.0f && std::isfinite(z) && isFinite(s.normal->at(x, y), 3);
}

// Of neighbours; what has no length has no direction, and turns.
bool turns(const Surfaces& s, int x, int y, int nextX, int nextY) {
    const float* a = s.normal->at(x, y);
    const float* b = s.normal->at(nextX, nextY);
    const auto dot = [](const float* u, const float* v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
    return !(dot(a, b) >= leastCosine * std::sqrt(dot(a, a) * dot(b, b)) && dot(a, b) > 0.0f);
}

// Of three pixels in a row or column, dx or dy apart.
bool bends(const Surfaces& s, int x, int y, int dx, int dy) {
    const auto inverse = [&](int i) { return 1.0 / double(*s.depth->at(x + i * dx, y + i * dy)); };
    return !(std::abs(inverse(0) - 2.0 * inverse(1) + inverse(2)) <= largestBend * inverse(1));
}

bool isSmooth(const Surfaces& s, const ComparedPixels& pixels, int left, int top) {
    const int right = left + side, bottom = top + side;
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
            if (pixels.states[size_t(y) * size_t(s.depth->width) + size_t(x)] != PixelState::counts ||
                !isSurface(s, x, y))
                return false;
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) {
            if (x + 1 < right && turns(s, x, y, x + 1, y)) return false;
            if (y + 1 < bottom && turns(s, x, y, x, y + 1)) return false;
            if (x + 2 < right && bends(s, x, y, 1, 0)) return false;
            if (y + 2 < bottom && bends(s, x, y, 0, 1)) return false;
        }
    return true;
}

Result<> checkFit(const Surfaces& surfaces, const lab::Image& truth) {
    const auto check = [&](const lab::Image& image, const char* name, int channels) -> Result<> {
        if (image.extent() == truth.extent() && image.channels == channels) return {};
        return Error{ErrorCode::invalidData,
                     std::string(name) + " is " + std::to_string(image.width) + "x" +
                         std::to_string(image.height) + " pixels with " + std::to_string(image.channels) +
                         (image.channels == 1 ? " channel" : " channels") + "; the pictures' " +
                         std::to_string(truth.width) + "x" + std::to_string(truth.height) + " with " +
                         std::to_string(channels) + " were expected"};
    };
    if (auto fits = check(*surfaces.depth, "depth", 1); !fits) return fits;
    return check(*surfaces.normal, "normal", 3);
}

double blockMean(const lab::Image& image, const std::array<int, 2>& block, int channel) {
    double sum = 0.0;
    for (int y = block[1]; y < block[1] + side; ++y)
        for (int x = block[0]; x < block[0] + side; ++x) sum += double(image.at(x, y)[channel]);
    return sum / double(side * side);
}

// Variance of the difference's block means; with halves of the truth their covariance, which has no noise in it.
double varianceOf(const lab::Image& test, const lab::Image& a, const lab::Image& b,
                  const std::vector<std::array<int, 2>>& blocks, int channel) {
    double sumA = 0.0, sumB = 0.0, products = 0.0;
    for (const std::array<int, 2>& block : blocks) {
        const double t = blockMean(test, block, channel);
        const double toA = t - blockMean(a, block, channel), toB = t - blockMean(b, block, channel);
        sumA += toA;
        sumB += toB;
        products += toA * toB;
    }
    const double count = double(blocks.size());
    return products / count - (sumA / count) * (sumB / count);
}

} // namespace

std::vector<std::array<int, 2>> smoothBlocks(const Surfaces& surfaces, const ComparedPixels& pixels) {
    std::vector<std::array<int, 2>> blocks;
    for (int y = 0; y + side <= surfaces.depth->height; y += side)
        for (int x = 0; x + side <= surfaces.depth->width; x += side)
            if (isSmooth(surfaces, pixels, x, y)) blocks.push_back({x, y});
    return blocks;
}

Result<> measurePattern(const lab::Image& test, const lab::Image& truth, const CompareOptions& options,
                        const ComparedPixels& pixels, ErrorMetrics& metrics) {
    if (!options.surfaces) return {};
    if (auto fits = checkFit(*options.surfaces, truth); !fits) return fits;
    const auto blocks = smoothBlocks(*options.surfaces, pixels);
    if (blocks.empty())
        return Error{ErrorCode::invalidData, "no block of 8x8 pixels that count lies on one smooth surface; "
                                             "at least one was expected"};
    metrics.smoothBlocks = blocks.size();
    const lab::Image& a = options.halves ? *options.halves->a : truth;
    const lab::Image& b = options.halves ? *options.halves->b : truth;
    double variance = 0.0, light = 0.0; // sums over channels; light: of the truth's means over all blocks
    for (int c = 0; c < test.channels; ++c) {
        variance += varianceOf(test, a, b, blocks, c);
        for (const std::array<int, 2>& block : blocks)
            light += blockMean(truth, block, c) / double(blocks.size());
    }
    const double channels = double(test.channels);
    if (light > 0.0) metrics.pattern = std::sqrt(std::max(variance / channels, 0.0)) / (light / channels);
    return {};
}

} // namespace rebound::metrics
