// SPDX-License-Identifier: MIT
// A made-up technique that uses what a plan may have: history, buffers of each kind, items, integers. Its arithmetic is exact
// for pictures of small whole numbers, so that every device gives the same bits as a plain loop.
#pragma once

#include "rebound/device.hpp"

#include <glm/glm.hpp>

#include <cstring>
#include <string>
#include <vector>

namespace rebound::test {

// In this order, which blank lines keep.
#include "rebound/math/uniform_types.h"

#include "kernels/test_constants.h"

inline constexpr size_t weightCount = 16;
inline constexpr float shareOfFrame = 0.25f;

// Inputs         picture   whole numbers, 0 to 255
// Input buffers  weights   16 floats
// Outputs        shown     mean over frames, sum of weights over frames, low bits of the key and 4096 times the number of
//                          frames before, mean over the frames before
// Output buffers report    the sums, pixel by pixel
inline Plan planSums(Extent2D extent) {
    Plan plan{"sums", {}, {}};
    const int count = extent.width * extent.height;
    const size_t bytes = size_t(count) * 4;
    const auto image = [&](const char* name, ResourceKind kind, Format format, int channels) {
        return plan.add({name, kind, format, channels, extent, {}, 0});
    };
    const auto buffer = [&](const char* name, ResourceKind kind, Format format, size_t size) {
        return plan.add({name, kind, format, 1, {}, {}, size});
    };
    const auto picture = image("picture", ResourceKind::input, Format::r32f, 1);
    const auto weights = buffer("weights", ResourceKind::inputBuffer, Format::r32f, weightCount * 4);
    const auto keys = image("keys", ResourceKind::transient, Format::r32ui, 1);
    const auto list = buffer("list", ResourceKind::transientBuffer, Format::r32ui, bytes);
    const auto before = buffer("before", ResourceKind::persistentBuffer, Format::r32f, bytes);
    const auto after = buffer("after", ResourceKind::transientBuffer, Format::r32f, bytes);
    const auto mean = image("mean", ResourceKind::history, Format::rgba32f, 4);
    const auto frames = plan.add(frameStateResource());
    const auto shown = image("shown", ResourceKind::output, Format::rgba32f, 4);
    const auto report = buffer("report", ResourceKind::outputBuffer, Format::r32f, bytes);
    const auto k = plan.add(bufferResource(
        "constants",
        std::vector<SumConstants>{{{extent.width, extent.height, count, 0}, {shareOfFrame, 0, 0, 0}}}));
    constexpr Access write = Access::write;
    plan.passes = {
        {"keys", "sum_keys", {}, {{0, picture}, {1, keys, write}, {2, list, write}, {3, k}}, extent},
        {"items",
         "sum_items",
         {},
         {{0, list}, {1, weights}, {2, before}, {3, after, write}, {4, k}},
         {},
         count},
        {"keep", "sum_keep", {1, 0}, {{0, after}, {1, before, write}, {2, report, write}, {3, k}}, {}, count},
        {"mean",
         "sum_mean",
         {},
         {{0, picture},
          {1, mean, Access::readPrevious},
          {2, keys},
          {3, after},
          {4, mean, write},
          {5, frames},
          {6, k}},
         extent},
        {"show",
         "sum_show",
         {},
         {{0, mean}, {1, mean, Access::readPrevious}, {2, shown, write}, {3, k}},
         extent}};
    return plan;
}

// The same by a plain loop.
class SumsModel {
public:
    explicit SumsModel(size_t count) : sum(count), mean(count) {}

    // A frame; returns what "shown" holds, interleaved.
    std::vector<float> run(const std::vector<float>& picture, const std::vector<float>& weights) {
        std::vector<float> shown;
        for (size_t i = 0; i < picture.size(); ++i) {
            uint32_t key = uint32_t(picture[i]) * 2654435761u;
            key ^= key >> 16;
            sum[i] += weights[key % weightCount];
            const float previous = mean[i];
            mean[i] = frames > 0 ? previous * (1 - shareOfFrame) + picture[i] * shareOfFrame : picture[i];
            shown.insert(shown.end(), {mean[i], sum[i], float(key % 1024 + 4096 * frames), previous});
        }
        ++frames;
        return shown;
    }
    const std::vector<float>& report() const { return sum; }

private:
    std::vector<float> sum, mean;
    uint32_t frames = 0;
};

} // namespace rebound::test
