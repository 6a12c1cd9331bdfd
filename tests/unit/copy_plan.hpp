// SPDX-License-Identifier: MIT
// A plan of two passes, and a frame for it.
#pragma once

#include "kernel_runner.hpp"

namespace rebound::test {

// host -> copy -> source -> access -> result
inline Plan copyPlan(Extent2D extent) {
    const AccessConstants k{{extent.width, extent.height, 0, 0}, {0, 0, 0, 0}};
    Plan plan{"test", {}, {}};
    plan.add({"host", ResourceKind::input, {}, 4, extent, {}, 0});
    plan.add({"source", ResourceKind::transient, {}, 4, extent, {}, 0});
    plan.add({"result", ResourceKind::output, {}, 4, extent, {}, 0});
    plan.add({"grid", ResourceKind::frameConstants, {}, 1, {}, {}, sizeof(AccessConstants)});
    plan.add(bufferResource("constants", std::vector{k}));
    plan.passes.push_back({"copy", "copy", {}, {{0, 0}, {1, 1, Access::write}, {2, 4}}, extent});
    plan.passes.push_back(
        {"access", "access", {accessOffset}, {{0, 1}, {1, 0}, {2, 2, Access::write}, {3, 3}}, extent});
    return plan;
}

struct CopyFrame {
    Picture host, result;
    AccessConstants constants;

    explicit CopyFrame(Extent2D extent)
        : host(numbered(extent)),
          result(extent, 4, -1.0f), constants{{extent.width, extent.height, 0, 0}, {2, 1, 0, 0}} {}
    FrameInputs<cpu::Image> inputs() {
        return {{{"host", host.image()}, {"result", result.image()}}, {{"grid", bytesOf(constants)}}};
    }
};

inline cpu::DeviceOptions withTestKernels() {
    cpu::DeviceOptions options;
    options.threads = 2;
    options.moreKernels = {cpu::testKernels};
    return options;
}

} // namespace rebound::test
