// SPDX-License-Identifier: MIT
// Frames in flight, resizes, motion vectors, lights.
#include "engine_run.hpp"

#include "vulkan_engine/frame_loop.hpp"

#include <cmath>
#include <numbers>

namespace rebound::engine {
TEST_CASE("resizes between frames in flight: no message, and the picture of a renderer that was never resized") {
    const auto context = openContext();
    if (!context) return;
    const lab::Scene scene = lab::makeCornellBox();
    const lab::CameraView& view = scene.cameras.at(0);
    {
        const auto renderer = rendererFor(*context, scene, {64, 48}, view);
        {
            const auto loop = require(FrameLoop::create(*context));
            for (Extent2D size : {Extent2D{64, 48}, Extent2D{97, 33}, Extent2D{31, 57}, Extent2D{1, 1}, Extent2D{96, 64}}) {
                require(renderer->resize(size, view));
                for (int i = 0; i < 3; ++i) {
                    require(renderer->record(require(loop->begin()), loop->frame(), view));
                    require(loop->submit());
                }
            }
        }
        const auto fresh = rendererFor(*context, scene, {96, 64}, view);
        renderFrame(*context, *fresh, 0, view);
        CHECK(require(renderer->read(renderer->targets().composed, 3)).data ==
              require(fresh->read(fresh->targets().composed, 3)).data);
        CHECK(mean(require(fresh->read(fresh->targets().composed, 3))) > 0.0);
        const auto timings = require(renderer->indirectLight().timings(0));
        CHECK(timings.size() > 5);
        // A size that is refused leaves what was.
        CHECK_FALSE(renderer->resize({1 << 30, 8}, view));
        CHECK(renderer->targets().lit.extent == Extent2D{96, 64});
    }
    checkSilence(*context);
}

TEST_CASE("motion is none for a camera that rests, and leads to where a surface was") {
    const auto context = openContext();
    if (!context) return;
    const lab::Scene scene = lab::makeCornellBox();
    lab::CameraView view = scene.cameras.at(0);
    const Extent2D size{96, 64};
    {
        const auto renderer = rendererFor(*context, scene, size, view);
        for (int i = 0; i < 2; ++i) renderFrame(*context, *renderer, i, view);
        for (float value : require(renderer->read(renderer->targets().motion, 2)).data) CHECK(value == 0.0f);
        const Camera before = cameraOf(view, size);
        view.position.x += 0.3f;
        view.target.x += 0.3f;
        renderFrame(*context, *renderer, 0, view);
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
                const glm::dvec4 clip = glm::dmat4(before.projection) * glm::dmat4(before.view) * (world / world.w);
                const glm::dvec2 was = glm::dvec2(clip) / clip.w * 0.5 + 0.5;
                // Halves of up to 0.04: 2^-16 apart; a difference of single-precision positions beside them.
                CHECK(std::abs(at.x + double(motion.at(x, y)[0]) - was.x) < 5e-5);
                CHECK(std::abs(at.y + double(motion.at(x, y)[1]) - was.y) < 5e-5);
                CHECK(motion.at(x, y)[0] > 0.01f); // the camera went right: surfaces came from the right
                ++checked;
            }
        CHECK(checked > size.width * size.height / 2);
    }
    checkSilence(*context);
}

TEST_CASE("a spot light, a point light, emission and an alpha mask, against closed forms") {
    const auto context = openContext();
    if (!context) return;
    // A floor of 8 m x 8 m seen from above; half of it is masked away by its base colour's opacity.
    lab::Scene scene;
    lab::Material floor, hole;
    floor.baseColor = {0.5f, 0.5f, 0.5f, 1.0f};
    floor.emission = {0.25f, 0.0f, 0.0f};
    hole.alphaMasked = true;
    hole.baseColor.a = 0.2f;
    scene.materials = {floor, hole};
    const auto plane = [](int material, float height) {
        lab::Mesh m;
        m.material = material;
        m.positions = {{-4, height, -4}, {4, height, -4}, {4, height, 4}, {-4, height, 4}};
        m.normals.assign(4, {0, 1, 0});
        m.indices = {0, 1, 2, 0, 2, 3};
        return m;
    };
    scene.meshes = {plane(0, 0.0f), plane(1, 1.0f)};
    scene.emissiveMaterialsLight = true;
    lab::Light light;
    light.type = lab::LightType::spot;
    light.position = {0, 3, 0};
    light.intensity = glm::vec3(9.0f);
    light.outerCone = light.innerCone = 0.5f;
    scene.lights = {light};
    light.type = lab::LightType::point;
    light.intensity = {0, 0, 18.0f};
    scene.lights.push_back(light);
    lab::CameraView view;
    view.position = {0, 6, 0};
    view.target = {0, 0, 0};
    view.up = {0, 0, -1};
    const Extent2D size{65, 65};
    {
        const auto renderer = rendererFor(*context, scene, size, view);
        renderFrame(*context, *renderer, 0, view);
        const lab::Image lit = require(renderer->read(renderer->targets().lit, 3));
        const float pi = std::numbers::pi_v<float>;
        // Straight below: intensity over squared height; the mask above neither is seen nor casts a shadow.
        const float* middle = lit.at(32, 32);
        CHECK(middle[1] == doctest::Approx(0.5f * 1.0f / pi).epsilon(2e-3)); // a half
        CHECK(middle[0] == doctest::Approx(0.25f + 0.5f * 1.0f / pi).epsilon(2e-3));
        CHECK(middle[2] == doctest::Approx(0.5f * 3.0f / pi).epsilon(2e-3));
        // At 2 m to the side the spot's hard edge, at 3 tan(0.5) = 1.64 m, has been passed; the point light reaches on:
        // the pixel's centre lies 20 pixels of 6 m tan(0.5) / 32.5 off the middle.
        const float* side = lit.at(52, 32);
        const float distance = 20.0f * 6.0f * std::tan(0.5f) / 32.5f, squared = 9.0f + distance * distance;
        CHECK(distance > 3.0f * std::tan(0.5f));
        CHECK(side[1] == 0.0f);
        CHECK(side[2] == doctest::Approx(0.5f / pi * 18.0f * 3.0f / std::pow(squared, 1.5f)).epsilon(2e-3));
    }
    checkSilence(*context);
}

} // namespace rebound::engine
