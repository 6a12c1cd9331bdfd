// SPDX-License-Identifier: MIT
// Frames in flight, resizes, motion vectors, lights.
#include "../engine/lamp_scene.hpp"
#include "engine_run.hpp"

#include "vulkan_engine/frame_loop.hpp"

#include <cmath>
#include <numbers>

namespace rebound::engine {
TEST_CASE(
    "resizes between frames in flight: no message, and the picture of a renderer that was never resized") {
    const auto context = openContext();
    const lab::Scene scene = lab::makeCornellBox();
    const lab::CameraView& view = scene.cameras.at(0);
    {
        const auto renderer = rendererFor(context, scene, {64, 48}, view);
        {
            const auto loop = require(FrameLoop::create(context));
            for (Extent2D size :
                 {Extent2D{64, 48}, Extent2D{97, 33}, Extent2D{31, 57}, Extent2D{1, 1}, Extent2D{96, 64}}) {
                require(renderer->resize(size, view));
                for (int i = 0; i < 3; ++i) {
                    require(renderer->record(require(loop->begin()), loop->frame(), view));
                    require(loop->submit());
                }
            }
        }
        const auto fresh = rendererFor(context, scene, {96, 64}, view);
        renderFrame(context, *fresh, 0, view);
        CHECK(require(renderer->read(renderer->targets().composed, 3)).data ==
              require(fresh->read(fresh->targets().composed, 3)).data);
        CHECK(mean(require(fresh->read(fresh->targets().composed, 3))) > 0.0);
        const auto timings = require(renderer->indirectLight().timings());
        CHECK(timings.size() > 5);
        // A size that is refused leaves what was.
        CHECK_FALSE(renderer->resize({1 << 30, 8}, view));
        CHECK(renderer->targets().lit.extent == Extent2D{96, 64});
    }
    checkSilence(context);
}

TEST_CASE("motion is none for a camera that rests, and leads to where a surface was") {
    const auto context = openContext();
    const lab::Scene scene = lab::makeCornellBox();
    lab::CameraView view = scene.cameras.at(0);
    const Extent2D size{96, 64};
    {
        const auto renderer = rendererFor(context, scene, size, view);
        for (int i = 0; i < 2; ++i) renderFrame(context, *renderer, i, view);
        for (float value : require(renderer->read(renderer->targets().motion, 2)).data) CHECK(value == 0.0f);
        const Camera before = cameraOf(view, size);
        view.position.x += 0.3f;
        view.target.x += 0.3f;
        renderFrame(context, *renderer, 0, view);
        const lab::Image motion = require(renderer->read(renderer->targets().motion, 2));
        const lab::Image depth = require(renderer->read(renderer->targets().depth, 1));
        const Camera now = cameraOf(view, size);
        const glm::dmat4 back = glm::inverse(glm::dmat4(now.projection) * glm::dmat4(now.view));
        int checked = 0;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                if (*depth.at(x, y) == 0.0f) continue;
                const glm::dvec2 at((x + 0.5) / size.width, (y + 0.5) / size.height);
                glm::dvec4 world = back * glm::dvec4(2.0 * at - 1.0, double(*depth.at(x, y)), 1.0);
                const glm::dvec4 clip =
                    glm::dmat4(before.projection) * glm::dmat4(before.view) * (world / world.w);
                const glm::dvec2 was = glm::dvec2(clip) / clip.w * 0.5 + 0.5;
                // Halves of up to 0.04: 2^-16 apart; a difference of single-precision positions beside them.
                CHECK(std::abs(at.x + double(motion.at(x, y)[0]) - was.x) < 5e-5);
                CHECK(std::abs(at.y + double(motion.at(x, y)[1]) - was.y) < 5e-5);
                CHECK(motion.at(x, y)[0] > 0.01f); // the camera went right: surfaces came from the right
                ++checked;
            }
        CHECK(checked > size.width * size.height / 2);
    }
    checkSilence(context);
}

TEST_CASE("a spot light, a point light, emission and an alpha mask, against closed forms") {
    const auto context = openContext();
    lab::Scene scene = lampScene();
    const lab::CameraView& view = scene.cameras.at(0);
    for (const bool isDirectLight : {true, false}) {
        scene.emissiveMaterialsLight = isDirectLight;
        const auto renderer = rendererFor(context, scene, {65, 65}, view);
        renderFrame(context, *renderer, 0, view);
        checkLampLight(require(renderer->read(renderer->targets().lit, 3)),
                       require(renderer->read(renderer->targets().radiance, 3)), scene);
    }
    checkSilence(context);
}

} // namespace rebound::engine
