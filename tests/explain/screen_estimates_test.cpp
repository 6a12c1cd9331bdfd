// SPDX-License-Identifier: MIT
#include "explain_scenes.hpp"

#include "lab/explain/screen_estimates.hpp"
#include "lab/scenes/scene_files.hpp"

using namespace rebound;
using namespace rebound::explain;

namespace {

ScreenEstimates estimated(const lab::Scene& scene, const lab::CameraView& camera,
                          const EstimateOptions& options) {
    auto estimates = estimateFromScreen(scene, camera, options);
    REQUIRE_MESSAGE(estimates, (estimates ? "" : estimates.error().message));
    return *std::move(estimates);
}

double meanOf(const lab::Image& image) {
    double sum = 0.0;
    for (const float value : image.data) sum += double(value);
    return sum / double(image.data.size());
}

} // namespace

TEST_CASE("with nothing left out they are the path tracer's light") {
    const lab::Scene scene = lab::makeCornellBox();
    const Extent2D extent{48, 48};
    const auto estimates = estimated(scene, scene.cameras[0], {extent, 4, 256});
    const auto light =
        lab::tracePaths(scene, scene.cameras[0], {.extent = extent, .bounces = 4, .samples = 256});
    REQUIRE(light);
    // 2304 pixels of 256 paths each: about 0.1 % of the mean for either.
    CHECK(meanOf(estimates.firstBounce) == doctest::Approx(meanOf(light->firstBounce)).epsilon(0.006));
    CHECK(meanOf(estimates.allBounces) == doctest::Approx(meanOf(light->indirect)).epsilon(0.006));
    // Both say how noisy a pixel is; the path tracer's stratified paths are less so.
    CHECK(meanOf(estimates.standardError) > meanOf(light->standardError));
    CHECK(meanOf(estimates.standardError) < 2.0 * meanOf(light->standardError));
}

TEST_CASE("each rule leaves out no more than the one before it") {
    const lab::Scene scene = lab::makeAtrium();
    const auto estimates = estimated(scene, scene.cameras[0], {{48, 27}, 3, 32});
    for (size_t i = 0; i < estimates.firstBounce.data.size(); ++i) {
        CHECK(estimates.withVisibility.data[i] <= estimates.withoutVisibility.data[i]);
        CHECK(estimates.withVisibility.data[i] <= estimates.inView.data[i]);
        CHECK(estimates.inView.data[i] <= estimates.firstBounce.data[i]);
        CHECK(estimates.firstBounce.data[i] <= estimates.allBounces.data[i]);
        CHECK(estimates.screenBounces.data[i] <= estimates.allBounces.data[i]);
        CHECK(estimates.withVisibility.data[i] <= estimates.screenBounces.data[i] * 1.0001f);
    }
    CHECK(meanOf(estimates.inView) < 0.99 * meanOf(estimates.firstBounce));
    CHECK(meanOf(estimates.withVisibility) < 0.99 * meanOf(estimates.inView));
}

TEST_CASE("threads change nothing, in either projection") {
    const lab::Scene scene = lab::makeAtrium();
    lab::CameraView camera = scene.cameras[0];
    for (const bool orthographic : {false, true}) {
        camera.orthographic = orthographic;
        camera.orthographicHeight = 4.0f;
        const auto one = estimated(scene, camera, {{16, 9}, 2, 8, 1});
        const auto three = estimated(scene, camera, {{16, 9}, 2, 8, 3});
        CHECK(one.withoutVisibility.data == three.withoutVisibility.data);
        CHECK(one.screenBounces.data == three.screenBounces.data);
        CHECK(meanOf(one.withVisibility) > 0.0);
    }
}
