// SPDX-License-Identifier: MIT
// Plans with the tests' kernels, run on every backend of this machine.
#pragma once

#include "lab/runner/runner.hpp"
#include "lab/runner/shared_bytes.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rebound {
namespace cpu {
std::span<const KernelEntry* const> testKernels(Isa);
}
std::span<const Shader* const> testShaders();
} // namespace rebound

namespace rebound::test {

using runner::sharedBytes;

inline std::vector<float> read(runner::PreparedPlan& plan, const std::string& name) {
    const auto image = plan.read(name);
    REQUIRE_MESSAGE(image, (image ? "" : image.error().message));
    return image->data;
}

inline void run(runner::PreparedPlan& plan, const runner::PlanInputs& inputs) {
    const auto done = plan.runFrame(inputs);
    REQUIRE_MESSAGE(done, (done ? "" : done.error().message));
}

inline std::unique_ptr<runner::PreparedPlan> prepare(runner::Backend& backend, const Plan& plan,
                                                     const runner::PlanInputs& inputs) {
    auto prepared = backend.prepare(plan, inputs, {runner::Precision::single, false});
    REQUIRE_MESSAGE(prepared, (prepared ? "" : prepared.error().message));
    return *std::move(prepared);
}

inline std::vector<runner::BackendChoice> choices() {
    std::vector<runner::BackendChoice> choices;
    for (cpu::Isa isa : cpu::availableIsas()) {
        runner::BackendChoice choice;
        choice.isa = isa;
        choice.threads = 2;
        choices.push_back(choice);
    }
    for (const char* name : {"vulkan", "opengl"}) {
        runner::BackendChoice choice;
        choice.backend = name;
        choice.validation = true;
        choices.push_back(choice);
    }
    for (runner::BackendChoice& choice : choices) {
        choice.moreKernels = {cpu::testKernels};
        choice.moreShaders = {testShaders()};
    }
    return choices;
}

template <class Body>
void onEachBackend(Body body) {
    for (const runner::BackendChoice& choice : choices()) {
        auto backend = runner::createBackend(choice);
        if (!backend) {
            MESSAGE("skipped: " << backend.error().message);
            continue;
        }
        INFO(runner::toText((*backend)->info()));
        body(**backend);
        for (const std::string& complaint : (*backend)->complaints()) FAIL_CHECK(complaint);
    }
}

} // namespace rebound::test
