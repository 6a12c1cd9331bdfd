// SPDX-License-Identifier: MIT
// Screen space cannot see most of the light, so the yardstick is not the truth but how near to it the sum over every
// pixel of the start resolution comes.
#include "reference_frames.hpp"

#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>

using namespace rebound;
using namespace rebound::accuracy;

namespace {

// How much worse than brute force a preset's error may be. 64 samples at a quarter of the resolution trade accuracy for
// speed; 256 at half are to be as good as the sum over all pixels, give or take what the reduction of thin things costs.
double allowedError(std::string_view preset) {
    if (preset.starts_with("half-256")) return 1.08;
    return 1.2;
}
constexpr double allowedLoss = 0.9; // of brute force's mean

} // namespace

TEST_CASE("presets come near to brute force on the reference frames") {
    const char* shared = std::getenv("REBOUND_SHARED");
    const std::vector<ReferenceView> views = loadReferenceViews(shared ? shared : "");
    if (views.empty()) {
        MESSAGE("skipped: REBOUND_SHARED names no folder with reference/limits.json");
        return;
    }
    std::printf("relRMSE over brute force's, and mean over brute force's\n%-22s", "view");
    for (std::string_view preset : screenIndirectPresetNames())
        std::printf(" %14s", std::string(preset).c_str());
    for (const ReferenceView& view : views) {
        std::printf("\n%-22s", view.name.c_str());
        for (std::string_view preset : screenIndirectPresetNames()) {
            CAPTURE(view.name);
            CAPTURE(std::string(preset));
            const auto settings = screenIndirectPreset(preset, view.frame.depth.extent());
            REQUIRE(settings);
            const ImageError error = errorOf(gather(view, *settings), view);
            const double errorRatio = error.relativeRmse / view.bruteForce.relativeRmse;
            const double meanRatio = error.mean / view.bruteForce.mean;
            std::printf("   %5.3f %5.3f", errorRatio, meanRatio);
            CHECK(errorRatio < allowedError(preset));
            CHECK(meanRatio > allowedLoss);
        }
    }
    std::printf("\n");
}
