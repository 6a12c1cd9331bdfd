// SPDX-License-Identifier: MIT
// Joint bilateral filters where nothing agrees with the receiver: equal texels keep their value, however far they are.
#include "kernel_runner.hpp"

#include "rebound/techniques/screen_indirect.hpp"

#include <cmath>

namespace rebound::test {
namespace {

constexpr Extent2D fine{19, 5};
constexpr float light[4] = {0.5f, 3.0f, 40.0f, 0.0f};

// A quarter of a metre a texel at a distance of one metre; depth is linear, normals are in view space.
detail::CameraConstants testCamera() {
    return {
        {0.25f, 0.25f, -1.0f, -0.5f}, {0, 1, 1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 0}};
}

Picture filled(Extent2D extent, int channels, const float* value) {
    Picture p(extent, channels);
    for (size_t i = 0; i < p.values.size(); ++i) p.values[i] = value[i % size_t(channels)];
    return p;
}

// Copies every input into a texture and runs one kernel on them.
Picture filteredBy(cpu::Isa isa, const std::string& kernel, const std::vector<int>& features,
                   std::vector<std::pair<int, Picture*>> textures,
                   std::vector<std::pair<int, Picture*>> inputs, int outputSlot, int cameraSlot,
                   const detail::UpsampleConstants& k, bool toHost) {
    Plan plan{"test", {}, {}};
    std::vector<std::pair<ResourceIndex, Picture*>> images;
    Pass pass{"filter", kernel, features, {}, fine};
    for (auto [slot, picture] : textures) {
        const std::string name = "texture " + std::to_string(slot);
        const auto host = plan.add(
            {name + " of the host", ResourceKind::input, {}, picture->channels, picture->extent, {}, 0});
        const auto texture =
            plan.add({name, ResourceKind::transient, {}, picture->channels, picture->extent, {}, 0});
        const GridConstants grid{{picture->extent.width, picture->extent.height, 0, 0}};
        const auto constants = plan.add(bufferResource(name + " constants", std::vector{grid}));
        plan.passes.push_back({"copy " + name,
                               "copy",
                               {},
                               {{0, host}, {1, texture, Access::write}, {2, constants}},
                               picture->extent});
        pass.bindings.push_back({slot, texture});
        images.push_back({host, picture});
    }
    for (auto [slot, picture] : inputs) {
        const std::string name = "input " + std::to_string(slot);
        const auto host =
            plan.add({name, ResourceKind::input, {}, picture->channels, picture->extent, {}, 0});
        pass.bindings.push_back({slot, host});
        images.push_back({host, picture});
    }
    Picture result(fine, 4, -1.0f);
    const auto kind = toHost ? ResourceKind::output : ResourceKind::transient;
    pass.bindings.push_back({outputSlot, plan.add({"result", kind, {}, 4, fine, {}, 0}), Access::write});
    pass.bindings.push_back({cameraSlot, plan.add(bufferResource("camera", std::vector{testCamera()}))});
    pass.bindings.push_back({cameraSlot + 1, plan.add(bufferResource("constants", std::vector{k}))});
    plan.passes.push_back(pass);
    FrameInputs<cpu::Image> frame;
    for (auto [resource, picture] : images)
        frame.images.push_back({plan.resources[size_t(resource)].name, picture->image()});
    if (toHost) frame.images.push_back({"result", result.image()});
    auto program = deviceFor(isa).compile(plan);
    REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
    const auto recorded = program->record(frame);
    INFO((recorded ? std::string() : recorded.error().message));
    REQUIRE(recorded);
    if (!toHost) result.values = floatsOf(*program->read("result"));
    return result;
}

// Whether every pixel is the light, to the rounding of a few products.
void checkLight(const Picture& result, float factor = 1.0f) {
    double worst = 0.0;
    for (int y = 0; y < fine.height; ++y)
        for (int x = 0; x < fine.width; ++x)
            for (int c = 0; c < 3; ++c)
                worst =
                    std::max(worst, std::abs(double(result.at(x, y, c)) / double(factor * light[c]) - 1.0));
    CHECK(worst < 3e-6);
}

// Four texels are alike, at `ratio` times the receiver's distance, their normals `degrees` from the receiver's.
template <class Check>
void forEachBackground(Check check) {
    for (cpu::Isa isa : cpu::availableIsas())
        for (int projection : {0, 1})
            for (float degrees : {0.0f, 60.0f, 90.0f, 180.0f})
                for (float ratio : {1.0f, 1.5f, 6.0f, 25.0f, 1000.0f, 1e6f, 1e-3f}) {
                    CAPTURE(std::string(cpu::name(isa)));
                    CAPTURE(projection);
                    CAPTURE(degrees);
                    CAPTURE(ratio);
                    const float angle = degrees * 0.017453293f, area = 0.02f * ratio * ratio;
                    const float surface[4] = {area * std::sin(angle), 0.0f, -area * std::cos(angle), ratio};
                    check(isa, projection, surface);
                }
}

constexpr float nearSurface[4] = {0.0f, 0.0f, -0.02f, 1.0f};

} // namespace

TEST_CASE("combining levels: equal coarse texels give their own value, whatever their distance") {
    forEachBackground([](cpu::Isa isa, int projection, const float* background) {
        const Extent2D coarse{(fine.width + 1) / 2, (fine.height + 1) / 2};
        const float none[4] = {0, 0, 0, 0};
        Picture surfaces = filled(fine, 4, nearSurface), coarseSurfaces = filled(coarse, 4, background),
                coarseLight = filled(coarse, 4, light), gathered = filled(fine, 4, none);
        const detail::UpsampleConstants k{{fine.width, fine.height, 1, 0}, {1, 2, 0, 0}};
        for (int smoothing : {0, 1})
            checkLight(filteredBy(isa, "screen_indirect/combine", {projection, smoothing},
                                  {{0, &surfaces}, {1, &coarseSurfaces}, {2, &coarseLight}, {6, &gathered}},
                                  {}, 3, 4, k, false));
        checkLight(filteredBy(isa, "screen_indirect/carry", {projection},
                              {{0, &surfaces}, {1, &coarseSurfaces}, {2, &coarseLight}}, {}, 3, 4, k, false));
    });
}

TEST_CASE("upsampling to pixels: equal texels give their own value, whatever their distance") {
    forEachBackground([](cpu::Isa isa, int projection, const float* background) {
        const Extent2D coarse{(fine.width + 3) / 4, (fine.height + 3) / 4};
        const float facing[3] = {0, 0, -1}, distance = 1.0f, one[3] = {1, 1, 1},
                    third[3] = {0.5f, 0.5f, 0.5f}, none[3] = {0, 0, 0};
        Picture depth = filled(fine, 1, &distance), normal = filled(fine, 3, facing),
                radiance = filled(fine, 3, one), albedo = filled(fine, 3, third), lit = filled(fine, 3, none),
                surfaces = filled(coarse, 4, background), received = filled(coarse, 4, light);
        const detail::UpsampleConstants k{{fine.width, fine.height, 2, 0}, {1, 4, 0, 0}};
        checkLight(filteredBy(isa, "screen_indirect/upsample", {projection}, {{2, &surfaces}, {3, &received}},
                              {{0, &depth}, {1, &normal}, {7, &radiance}}, 6, 4, k, true));
        checkLight(filteredBy(isa, "screen_indirect/upsample_compose", {projection},
                              {{2, &surfaces}, {3, &received}},
                              {{0, &depth}, {1, &normal}, {6, &albedo}, {7, &lit}, {9, &radiance}}, 8, 4, k,
                              true),
                   0.5f);
    });
}

TEST_CASE("smoothing: a thin near texel in equal light keeps it") {
    forEachBackground([](cpu::Isa isa, int projection, const float* background) {
        Picture surfaces = filled(fine, 4, background), received = filled(fine, 4, light);
        for (int c = 0; c < 4; ++c) surfaces.at(4, 2, c) = surfaces.at(17, 0, c) = nearSurface[c];
        const detail::UpsampleConstants k{{fine.width, fine.height, 0, 0}, {1, 1, 0, 0}};
        checkLight(filteredBy(isa, "screen_indirect/smooth", {projection}, {{0, &surfaces}, {1, &received}},
                              {}, 2, 3, k, false));
    });
}

} // namespace rebound::test
