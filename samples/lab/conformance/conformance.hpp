// SPDX-License-Identifier: MIT
// Backends held against the scalar CPU. Pass by pass: every pass of every backend gets the inputs that the scalar CPU's
// passes had, so that no difference outlives the pass that made it. And whole frames, with nothing in between, as
// barriers and shared memory are only then what engines have.
#pragma once

#include "lab/conformance/cases.hpp"
#include "lab/conformance/difference.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rebound::conformance {

struct Contender {
    std::string name; // in the report, such as "avx2" or "vulkan"
    std::unique_ptr<runner::Backend> backend;
};

// One image of one pass of one case.
struct Finding {
    std::string contender, caseName, pass, kernel, resource;
    Difference difference;
    lab::Image reference, value; // of those that disagree
};

// The outputs of whole frames: root mean square of the differences over that of the scalar CPU's values.
struct FrameRow {
    std::string contender;
    double median = 0, maximum = 0; // over cases and outputs
    std::string worstCase;
    size_t disagreements = 0; // above allowedFrameDifference
};
// The few texels whose reduction decides otherwise: measured up to 0.004 on pictures of some hundred pixels.
inline constexpr double allowedFrameDifference = 0.01;

struct Report {
    // By contender, in their order, and kernel, over all cases.
    struct Row {
        std::string contender, kernel;
        Difference difference;
        size_t images = 0, disagreements = 0;
        std::string worstCase, worstPass;
    };
    std::vector<Row> rows;
    std::vector<FrameRow> frames;
    std::vector<Finding> disagreements;  // the first of each row
    std::vector<std::string> complaints; // of drivers' checks, with the contender's name
    int cases = 0;

    bool agrees() const;
};

// Runs every case, all of its frames, on the scalar CPU and on each contender. progress: called with the share that is done,
// 0 to 1. yardstick: which kernels the scalar CPU has beside the techniques' own; what else it says does not matter.
Result<Report> run(const std::vector<NamedCase>&, std::vector<Contender>&,
                   const std::function<void(double)>& progress = {}, runner::BackendChoice yardstick = {});

} // namespace rebound::conformance
