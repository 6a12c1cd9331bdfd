// SPDX-License-Identifier: MIT
// What the tests of the sample engines share: the CPU device's light, and pictures compared.
#pragma once

#include "lab/images/image.hpp"
#include "lab/runner/runner.hpp"
#include "rebound/techniques/screen_indirect.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace rebound::engine {

template <class T>
T require(Result<T> result) {
    REQUIRE_MESSAGE(result, (result ? "" : result.error().message));
    return *std::move(result);
}
inline void require(Result<> result) { REQUIRE_MESSAGE(result, (result ? "" : result.error().message)); }

inline double mean(const lab::Image& image) {
    double sum = 0.0;
    for (float value : image.data) sum += double(value);
    return sum / double(image.data.size());
}

// The mean and the root mean square of differences, relative to the second image's mean.
struct Difference {
    double average = 0.0, root = 0.0, largest = 0.0;
};
inline Difference difference(const lab::Image& image, const lab::Image& expected) {
    REQUIRE(image.data.size() == expected.data.size());
    Difference d;
    const double scale = mean(expected), count = double(image.data.size());
    for (size_t i = 0; i < image.data.size(); ++i) {
        const double e = std::abs(double(image.data[i]) - double(expected.data[i])) / scale;
        d.average += e / count;
        d.root += e * e / count;
        d.largest = std::max(d.largest, e);
    }
    d.root = std::sqrt(d.root);
    return d;
}

struct Light {
    lab::Image indirect, composed;
};

// The plan on the scalar CPU, its images in half precision as the engines' are.
inline Light onCpu(const ScreenIndirectSettings& settings, const ScreenIndirectFrame<lab::Image>& frame) {
    const auto inputs = require(screenIndirectInputs(settings, frame));
    runner::BackendChoice choice;
    choice.isa = cpu::Isa::scalar;
    const auto backend = require(runner::createBackend(choice));
    const auto prepared = require(backend->prepare(require(planScreenIndirect(settings)), inputs, {}));
    require(prepared->run());
    return {require(prepared->read("indirect")), require(prepared->read("composed"))};
}

} // namespace rebound::engine
