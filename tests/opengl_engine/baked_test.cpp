// SPDX-License-Identifier: MIT
// Light from a bake: the engine's surfels, shadow map and pixels against the CPU device on the same.
#ifdef REBOUND_HAS_BAKING
#include "../engine/baked.hpp"
#include "engine_run.hpp"

namespace rebound::engine {

TEST_CASE(
    "a baked hall and a ball under lights that move and switch: the CPU device's light, frame by frame") {
    auto context = openContext();
    lab::Scene scene = hall();
    const Bake bake = bakeOfHall(scene);
    addBall(scene);
    const lab::CameraView& view = scene.cameras.at(0);
    const Extent2D size{160, 120};
    {
        const auto renderer = require(Renderer::create(host::OpenGLContext::functionNamed, scene, bake));
        require(renderer->resize(size, view));
        checkBakedFrames(
            bake, renderer->bakedLight()->lightSettings(), renderer->bakedLight()->settings(),
            [&](int frame) {
                const Moment moment = momentOf(scene, frame);
                renderer->set(moment);
                require(renderer->render(view));
                const Targets& t = renderer->targets();
                const auto read = [&](const auto& target) { return require(renderer->read(target, 3)); };
                return BakedFrame{
                    cameraOf(view, size), moment.lights, renderer->readDepth(),     read(t.normal),
                    read(t.albedo),       read(t.lit),   renderer->readShadowMap(), read(t.indirect),
                    read(t.composed)};
            });
    }
    checkSilence(context);
}

} // namespace rebound::engine
#else
#include <doctest/doctest.h>

TEST_CASE("a baked hall") { MESSAGE("not run: this build bakes nothing, as Embree or xxhash is missing"); }
#endif
