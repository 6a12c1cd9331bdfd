// SPDX-License-Identifier: MIT
#include "lab/baking/map_places.hpp"

#include "../lab/frame_test_scene.hpp"
#include "lab/baking/bake_of_scene.hpp"
#include "lab/rays/camera_rays.hpp"
#include "lab/scenes/scene_files.hpp"

#include <bit>
#include <memory>

namespace rebound::lab {
namespace {

glm::vec3 placeOf(const Bake& bake, uint32_t cache) {
    const auto number = [&](uint32_t k) {
        return std::bit_cast<float>(bake.section(BakeSection::places)[4 * size_t(cache) + k]);
    };
    return {number(0), number(1), number(2)};
}

} // namespace

TEST_CASE("pixels lie where their texel's cache stands, and what has moved lies outside the light map") {
    const auto scene = loadScene("builtin:cornell");
    REQUIRE(scene);
    auto built = EmbreeScene::build(*scene);
    REQUIRE(built);
    const auto rays = std::make_shared<const EmbreeScene>(*std::move(built));
    BakeSettings settings;
    settings.surfels = 300;
    settings.caches = 100;
    settings.links = 4;
    settings.lightMap = 1200;
    const auto bake = bakeOfScene(rays, settings);
    REQUIRE_MESSAGE(bake, (bake ? "" : bake.error().message));
    FrameOptions options;
    options.extent = {64, 48};
    options.lightSamples = 1;
    const auto camera = findCamera(*scene, "");
    REQUIRE(camera);
    auto frame = renderFrame(*scene, *camera, options);
    REQUIRE(frame);
    // An object a centimetre before what was baked, in the left half.
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 32; ++x)
            if (float& depth = *frame->depth.at(x, y); depth > 0.0f) depth -= 0.01f;

    const Image places = mapPlacesOf(*bake, *rays, *frame, 2);
    const CameraRays cameraRays(*camera, options.extent);
    const auto positionAt = [&](int x, int y) {
        const CameraRay ray = cameraRays.throughPixel(x, y);
        return glm::vec3(ray.origin + double(*frame->depth.at(x, y)) * ray.direction);
    };
    int mapped = 0;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            const float* place = places.at(x, y);
            const float depth = *frame->depth.at(x, y);
            if (x < 32 || depth == 0.0f) {
                CHECK(place[0] == outsideMap);
                continue;
            }
            if (place[0] == outsideMap) continue; // a chart too small
            const uint32_t row = uint32_t(place[1]), column = uint32_t(place[0]);
            const uint32_t texel =
                bake->section(BakeSection::mapTexels)[row * bake->layout.mapSize.x + column];
            if (texel == BakeLayout::noMapTexel)
                continue; // the rim around the box, which sees the open alone
            if (texel >> 24 != 0) continue;
            if (x == 63 || places.at(x + 1, y)[0] == outsideMap) continue;
            const glm::vec2 step(places.at(x + 1, y)[0] - place[0], places.at(x + 1, y)[1] - place[1]);
            const glm::vec3 position = positionAt(x, y), beside = positionAt(x + 1, y);
            if (glm::length(step) > 1.0f || glm::distance(position, beside) > 0.5f) continue; // another chart
            // Charts that see little have wider texels: as wide as the way to the next pixel says.
            const float texelWidth = glm::distance(position, beside) / glm::length(step);
            // Half a diagonal, the cache's lift, and steps of coordinates.
            CHECK(glm::distance(position, placeOf(*bake, texel & 0xffffffu)) < 0.8f * texelWidth);
            ++mapped;
        }
    CHECK(mapped > 300);
}

} // namespace rebound::lab
