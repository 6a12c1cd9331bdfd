// SPDX-License-Identifier: MIT
// A prepared plan that is handed one frame's inputs after the other's, on every backend of this machine.
#include "lab/conformance/gbuffer.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace rebound;
using namespace rebound::conformance;

namespace {

constexpr Extent2D extent{45, 31};

Case frameOf(uint64_t seed) {
    Random random(seed);
    ScreenIndirectSettings settings;
    settings.resolution = extent;
    settings.levels = 2;
    settings.samplesPerLevel = 16;
    auto made = caseOf(makeGBuffer(settings, {}, random), runner::Precision::half);
    REQUIRE(made);
    return *std::move(made);
}

std::vector<float> composed(runner::PreparedPlan& plan) {
    const auto image = plan.read("composed");
    REQUIRE(image);
    return image->data;
}

std::vector<float> aloneOn(runner::Backend& backend, const Case& c) {
    auto prepared = backend.prepare(c.plan, c.inputs, {});
    REQUIRE(prepared);
    REQUIRE((*prepared)->run());
    return composed(**prepared);
}

template <class Body>
void onEachBackend(Body body) {
    for (const std::string& name : runner::backendNames()) {
        runner::BackendChoice choice;
        choice.backend = name;
        auto backend = runner::createBackend(choice);
        if (!backend) {
            MESSAGE("skipped: " << backend.error().message);
            continue;
        }
        CAPTURE(name);
        body(**backend);
    }
}

} // namespace

TEST_CASE("each frame of a sequence is what its inputs alone give") {
    const Case first = frameOf(1), second = frameOf(2);
    onEachBackend([&](runner::Backend& backend) {
        auto prepared = backend.prepare(first.plan, first.inputs, {});
        REQUIRE(prepared);
        REQUIRE((*prepared)->run());
        CHECK(composed(**prepared) == aloneOn(backend, first));
        REQUIRE((*prepared)->runFrame(second.inputs));
        CHECK(composed(**prepared) == aloneOn(backend, second));
        CHECK(composed(**prepared) != aloneOn(backend, first));
        REQUIRE((*prepared)->run());
        CHECK(composed(**prepared) == aloneOn(backend, second));
    });
}

TEST_CASE("a frame that lacks something is refused, and the one before stays") {
    const Case first = frameOf(1);
    runner::PlanInputs second = frameOf(2).inputs, noDepth = second, noCamera = second, small = second;
    std::erase_if(noDepth.images, [](const auto& image) { return image.name == "depth"; });
    noCamera.constants.clear();
    for (auto& named : small.images) named.image = lab::Image({3, 3}, named.image.channels);
    onEachBackend([&](runner::Backend& backend) {
        auto prepared = backend.prepare(first.plan, first.inputs, {});
        REQUIRE(prepared);
        const auto refused = [&](const runner::PlanInputs& inputs) {
            const auto done = (*prepared)->runFrame(inputs);
            REQUIRE(!done);
            return done.error().message;
        };
        CHECK(refused(noDepth) == "inputs: the plan screen_indirect needs depth");
        CHECK(refused(noCamera) == "inputs: the plan screen_indirect needs camera");
        CHECK(refused(small) == "inputs: depth has 3 x 3 pixels; 45 x 31 were expected");
        REQUIRE((*prepared)->run());
        CHECK(composed(**prepared) == aloneOn(backend, first));
    });
}
