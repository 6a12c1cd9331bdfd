// SPDX-License-Identifier: MIT
// Light from a bake: the engine's surfels, shadow map and pixels against the CPU device on the same.
#ifdef REBOUND_HAS_BAKING
#include "../engine/baked.hpp"
#include "engine_run.hpp"

namespace rebound::engine {

TEST_CASE(
    "a baked hall and a ball under lights that move and switch: the CPU device's light, frame by frame") {
    const auto context = openContext();
    lab::Scene scene = hall();
    const Bake bake = bakeOfHall(scene);
    addBall(scene);
    const lab::CameraView& view = scene.cameras.at(0);
    const Extent2D size{160, 120};
    {
        const auto renderer = require(Renderer::create(context, scene, bake));
        require(renderer->resize(size, view));
        checkBakedFrames(bake, renderer->bakedLight()->lightSettings(), renderer->bakedLight()->settings(),
                         [&](int frame) {
                             const Moment moment = momentOf(scene, frame);
                             renderer->set(moment, frame % framesInFlight);
                             renderFrame(context, *renderer, frame % framesInFlight, view);
                             const Targets& t = renderer->targets();
                             const auto read = [&](const auto& target, int channels) {
                                 return require(renderer->read(target, channels));
                             };
                             return BakedFrame{cameraOf(view, size),
                                               moment.lights,
                                               read(t.depth, 1),
                                               read(t.normal, 3),
                                               read(t.albedo, 3),
                                               read(t.lit, 3),
                                               read(renderer->shadows(), 1),
                                               read(t.indirect, 3),
                                               read(t.composed, 3)};
                         });
    }
    checkSilence(context);
}

} // namespace rebound::engine
#else
#include <doctest/doctest.h>

TEST_CASE("a baked hall") { MESSAGE("not run: this build bakes nothing, as Embree or xxhash is missing"); }
#endif
