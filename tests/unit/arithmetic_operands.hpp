// SPDX-License-Identifier: MIT
// What the kernel arithmetic is given, on every backend.
#pragma once

#include "kernel_runner.hpp"

#include <vector>

namespace rebound::test {

struct Operands {
    Picture x, y, z;
};

// Every pair of the values, and a third that cycles through them, in an image 33 texels wide: lanes meet its
// side. Further channels begin elsewhere.
inline Operands everyPair(const std::vector<float>& values, int channels = 1) {
    const int n = int(values.size());
    const Extent2D extent{33, (n * n + 32) / 33};
    Operands o{Picture(extent, channels), Picture(extent, channels), Picture(extent, channels)};
    for (int i = 0; i < extent.width * extent.height; ++i)
        for (int c = 0; c < channels; ++c) {
            const size_t at = size_t(channels * i + c);
            o.x.values[at] = values[size_t((i + c) % n)];
            o.y.values[at] = values[size_t((i / n + 5 * c) % n)];
            o.z.values[at] = values[size_t((i * 7 + 3 + c) % n)];
        }
    return o;
}

// For the operators of integers, which cut off what is behind the point.
inline std::vector<float> wholeNumbers() {
    std::vector<float> values;
    for (int i = -9; i <= 9; ++i) values.push_back(float(i));
    for (float v : {4096.0f, -4096.0f, 1000.0f, -1000.0f, 32767.0f, -2.9f, 2.9f, 12345.0f})
        values.push_back(v);
    return values;
}

// Small multiples of powers of two, of which products and sums are exact.
inline Operands exactVectors() {
    Operands o{Picture({17, 3}, 4), Picture({17, 3}, 4), Picture({17, 3}, 4)};
    for (size_t i = 0; i < o.x.values.size(); ++i) {
        o.x.values[i] = float(int(i * 5 % 23) - 11) / 4.0f;
        o.y.values[i] = float(int(i * 7 % 19) - 9) / 8.0f;
        o.z.values[i] = float(int(i % 3) - 1);
    }
    return o;
}

inline KernelCall arithmetic(int operation, Operands& o) {
    const GridConstants k{{o.x.extent.width, o.x.extent.height, 0, 0}};
    return {"arithmetic", {operation}, {{0, &o.x}, {1, &o.y}, {2, &o.z}}, {{4, bytesOf(k)}}, 3, o.x.extent};
}

} // namespace rebound::test
