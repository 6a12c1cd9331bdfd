// SPDX-License-Identifier: MIT
// A workshop that measures nothing: what it gives is made up, and what it was asked for is counted.
#pragma once

#include "lab/charts/run.hpp"

#include <string>
#include <vector>

namespace rebound::charts {

class MadeWorkshop : public Workshop {
public:
    explicit MadeWorkshop(Extent2D s) : size(s) {}

    Result<Truth> truth(const View&, const lab::Progress&) override {
        Truth truth;
        truth.light = lab::Image(size, 3, 2.0f);
        truth.visible = lab::Image(size, 1, 1.0f);
        truth.direct = lab::Image(size, 3, 1.0f);
        truth.samples = 8;
        return truth;
    }

    // Light that is a fifth too bright, in 1, 2 and 3 ms.
    Result<Trial> measure(const View& view, const techniques::Configured& technique, ChartBackend&,
                          const lab::Progress&) override {
        if (int(measured.size()) == failsAfter) return Error{ErrorCode::deviceLost, "the device was lost"};
        measured.push_back(view.label + " " + technique.name);
        lab::Image light(size, 3, 2.4f);
        light.data[0] = firstValue;
        return Trial{{3.0, 1.0, 2.0}, light};
    }

    std::vector<std::string> measured;
    int failsAfter = -1;
    float firstValue = 2.4f;

private:
    Extent2D size;
};

inline Sweep madeSweep() {
    return *parseSweep(
        R"({"techniques": {"screen_indirect": [{"samples": [16, 32]}]}, "size": "8x4", "frames": 3})",
        "sweep");
}

inline std::vector<View> madeViews() {
    lab::CameraView front, side;
    front.name = "front";
    side.name = "side";
    return {{"box front", "builtin:box", nullptr, front, "key-of-front"},
            {"box side", "builtin:box", nullptr, side, "key-of-side"}};
}

inline std::vector<ChartBackend> madeBackends() {
    std::vector<ChartBackend> backends;
    backends.push_back({"cpu", "scalar on 1 thread", "hash-of-its-source", nullptr});
    return backends;
}

} // namespace rebound::charts
