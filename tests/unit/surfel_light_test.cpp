// SPDX-License-Identifier: MIT
// Direct light on surfels against closed forms: sources, shadow maps by every convention, images of surfels.
#include "composition_frame.hpp"

#include "rebound/bake/read_surfel.hpp"
#include "rebound/techniques/surfel_light.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rebound::test {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

Bake bakeOf(std::vector<MadeSurfel> surfels) {
    MadeBake made = gridInView();
    made.surfels = std::move(surfels);
    return made.pack();
}

LightSource source(int kind, glm::vec3 position, glm::vec3 direction, glm::vec3 intensity) {
    return {
        glm::vec4(position, 0.0f), glm::vec4(direction, 0.0f), glm::vec4(intensity, 0.0f), {kind, 0, 0, 0}};
}

cpu::Buffer bufferOf(const void* data, size_t size) { return {const_cast<void*>(data), size, {}}; }

// What a plan's frame takes, and the light that it has written.
struct Scene {
    Bake bake;
    SurfelLightSettings settings;
    std::vector<LightSource> sources;
    std::vector<ShadowView> views;
    std::vector<Picture> maps;

    explicit Scene(Bake b) : bake(std::move(b)) {
        settings.surfels = bake.layout.surfels;
        settings.placesPerSurfel = 1;
    }

    // [3][surfel], by instruction set.
    std::vector<float> light(cpu::Isa isa) {
        settings.shadowMaps.clear();
        for (const Picture& map : maps) settings.shadowMaps.push_back(map.extent);
        sources.resize(size_t(settings.maximumSources));
        views.resize(size_t(settings.maximumShadowViews));
        auto plan = planSurfelLight(settings);
        REQUIRE_MESSAGE(plan, (plan ? "" : plan.error().message));
        auto program = deviceFor(isa, 2).compile(*plan);
        REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
        std::vector<float> result(3 * size_t(BakeLayout::stride(settings.surfels)), -7.0f);
        SurfelLightFrame<cpu::Image> frame;
        frame.sources = used;
        const auto surfels = bake.section(BakeSection::surfels);
        frame.surfels = bufferOf(surfels.data(), surfels.size_bytes());
        frame.lightSources = bufferOf(sources.data(), sources.size() * sizeof(LightSource));
        frame.shadowViews = bufferOf(views.data(), views.size() * sizeof(ShadowView));
        for (size_t i = 0; i < maps.size(); ++i) frame.shadowMaps[i] = maps[i].image();
        frame.surfelLight = bufferOf(result.data(), result.size() * sizeof(float));
        const auto inputs = surfelLightInputs(settings, frame);
        REQUIRE_MESSAGE(inputs, (inputs ? "" : inputs.error().message));
        const auto done = program->record(*inputs);
        REQUIRE_MESSAGE(done, (done ? "" : done.error().message));
        return result;
    }
    void add(const LightSource& s) {
        sources.resize(size_t(used));
        sources.push_back(s);
        ++used;
    }

private:
    int used = 0;
};

// A light's image of a world in which something stands at depth `near` where isHidden(texel), and nothing elsewhere.
template <class IsHidden>
Picture mapOf(Extent2D extent, const ShadowMapConventions& c, float near, IsHidden isHidden) {
    Picture map(extent, 1, c.depthDirection == DepthDirection::forward ? 1.0f : 0.0f);
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x)
            if (isHidden(x, y))
                map.at(x, y, 0) = c.depthDirection == DepthDirection::forward ? near : 1.0f - near;
    return map;
}

// As a matrix for one convention gives depth, for another one.
glm::mat4 withConventions(glm::mat4 zeroToOneForward, const ShadowMapConventions& c) {
    glm::mat4 depth(1.0f);
    if (c.depthDirection == DepthDirection::reversed) {
        depth[2][2] = -1.0f;
        depth[3][2] = 1.0f;
    }
    glm::mat4 range(1.0f);
    if (c.depthRange == DepthRange::minusOneToOne) {
        range[2][2] = 2.0f;
        range[3][2] = -1.0f;
    }
    return range * depth * zeroToOneForward;
}

} // namespace

TEST_CASE("surfel light: each kind of source against its closed form") {
    const glm::vec3 slope = glm::normalize(glm::vec3(1, 0, 1));
    Scene scene(
        bakeOf({{{0, 0, 0}, {0, 0, 1}, 1e-8f}, {{1, 0, 0}, slope, 1e-8f}, {{0, 0, 0}, {0, 0, -1}, 1e-8f}}));
    struct Case {
        LightSource light;
        float first, second; // E / pi
    };
    const glm::vec3 down(0, 0, -1);
    LightSource spot = source(spotSource, {0, 0, 2}, down, glm::vec3(8.0f));
    spot.direction.w = 0.8f;
    spot.intensity.w = 1.0f;
    LightSource hard = spot;
    hard.intensity.w = hard.direction.w = 0.95f;
    LightSource disc = source(discSource, {0, 0, 2}, down, glm::vec3(8.0f));
    disc.intensity.w = 3.0f;
    LightSource away = disc;
    away.direction.z = 1.0f;
    LightSource both = away;
    both.kind.x = twoSidedDiscSource;
    // The second surfel sees the light at (-1, 0, 2), at a distance of sqrt(5).
    const float cosine = glm::dot(slope, glm::vec3(-1, 0, 2)) / std::sqrt(5.0f), off = 2.0f / std::sqrt(5.0f);
    const float ramp = (off - 0.8f) / 0.2f;
    for (const Case& c :
         {Case{source(directionalSource, {}, down, glm::vec3(3.0f)), 3.0f / pi, 3.0f / pi * slope.z},
          {source(pointSource, {0, 0, 2}, {}, glm::vec3(8.0f)), 2.0f / pi, 8.0f / 5.0f * cosine / pi},
          {spot, 2.0f / pi, 8.0f / 5.0f * cosine * ramp * ramp / pi},
          {hard, 2.0f / pi, 0.0f},
          {disc, 8.0f / 7.0f / pi, 8.0f * cosine * off / (5.0f + 3.0f * off) / pi},
          {away, 0.0f, 0.0f},
          {both, 8.0f / 7.0f / pi, 8.0f * cosine * off / (5.0f + 3.0f * off) / pi}}) {
        Scene one = scene;
        one.add(c.light);
        for (cpu::Isa isa : cpu::availableIsas()) {
            const std::vector<float> light = one.light(isa);
            CAPTURE(c.light.kind.x);
            // Inverse square roots to 5e-7, places within the radius of 6e-5.
            CHECK(std::abs(light[0] - c.first) <= 1e-4f * c.first);
            CHECK(std::abs(light[1] - c.second) <= 2e-4f * std::max(c.second, 0.1f));
            CHECK(light[2] == 0.0f); // looks away
            CHECK(light[64] == light[0]);
        }
    }
}

TEST_CASE("surfel light: sources add up, and only those in use count") {
    Scene scene(bakeOf(std::vector<MadeSurfel>(70, {{0, 0, 0}, {0, 0, 1}})));
    scene.settings.maximumSources = 3;
    for (cpu::Isa isa : cpu::availableIsas()) CHECK(scene.light(isa)[69] == 0.0f);
    scene.add(source(directionalSource, {}, {0, 0, -1}, {1, 0, 0}));
    scene.add(source(directionalSource, {}, {0, 0, -1}, {1, 2, 0}));
    for (cpu::Isa isa : cpu::availableIsas()) {
        const std::vector<float> light = scene.light(isa);
        for (size_t i : {0u, 69u}) {
            CHECK(light[i] == doctest::Approx(2.0 / double(pi)));
            CHECK(light[128 + i] == doctest::Approx(2.0 / double(pi)));
            CHECK(light[256 + i] == 0.0f);
        }
    }
}

TEST_CASE("surfel light: shadow maps by every convention, in a tile of a larger one") {
    // Light comes down, and what lies at x > 0 is hidden by something 1 m above it.
    std::vector<MadeSurfel> surfels;
    for (float x : {-1.9f, -0.5f, 0.5f, 1.9f, 7.0f}) surfels.push_back({{x, 0.3f, 0}, {0, 0, 1}, 1e-8f});
    surfels.push_back({{0.5f, 0.3f, 1.5f}, {0, 0, 1}, 1e-8f}); // above what hides
    const glm::mat4 matrix = glm::orthoRH_ZO(-2.0f, 2.0f, -2.0f, 2.0f, 0.0f, 4.0f) *
                             glm::lookAtRH(glm::vec3(0, 0, 2), glm::vec3(0), glm::vec3(0, 1, 0));
    for (DepthRange range : {DepthRange::zeroToOne, DepthRange::minusOneToOne})
        for (DepthDirection direction : {DepthDirection::forward, DepthDirection::reversed})
            for (FirstRow row : {FirstRow::top, FirstRow::bottom}) {
                const ShadowMapConventions c{range, direction, row};
                Scene scene(bakeOf(surfels));
                // In the second of two maps, of which the tile's upper half, y > 0, is covered by nothing at x > 0 but
                // for the rows around 0.3 m.
                scene.maps.push_back(Picture({3, 2}, 1, 0.5f));
                scene.maps.push_back(mapOf({20, 11}, c, 0.25f, [&](int x, int y) {
                    const int up = row == FirstRow::bottom ? y - 2 : 9 - y;
                    return x >= 8 + 4 && up == 4; // 8 texels of 0.5 m a side, from (8, 2) on
                }));
                ShadowMapTile tile{1, {8, 2}, {8, 8}, 0.1f};
                if (row == FirstRow::top) tile.first.y = 2;
                scene.views.push_back(shadowView(withConventions(matrix, c), c, tile));
                LightSource sun = source(directionalSource, {}, {0, 0, -1}, glm::vec3(pi));
                sun.kind.z = 1;
                scene.add(sun);
                for (cpu::Isa isa : cpu::availableIsas()) {
                    const std::vector<float> light = scene.light(isa);
                    const float expected[] = {1, 1, 0, 0, 1, 1};
                    for (size_t i = 0; i < 6; ++i) {
                        CAPTURE(i);
                        CHECK(light[i] == doctest::Approx(expected[i]).epsilon(1e-5));
                    }
                }
            }
}

TEST_CASE("surfel light: a point source with a cube's six faces in one map") {
    const glm::vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    std::vector<MadeSurfel> surfels;
    for (const glm::vec3& axis : axes) {
        const glm::vec3 aside = glm::vec3(axis.y, axis.z, axis.x);
        surfels.push_back({2.0f * axis + 0.7f * aside, -axis, 1e-8f});
    }
    const ShadowMapConventions c;
    for (int hidden = 0; hidden < 6; ++hidden) {
        Scene scene(bakeOf(surfels));
        scene.maps.push_back(mapOf({48, 8}, c, 0.5f, [&](int x, int) { return x / 8 == hidden; }));
        for (int face = 0; face < 6; ++face) {
            const glm::vec3 up = std::abs(axes[face].y) > 0.5f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
            const glm::mat4 matrix = glm::perspectiveRH_ZO(0.5f * pi, 1.0f, 0.1f, 10.0f) *
                                     glm::lookAtRH(glm::vec3(0), axes[face], up);
            scene.views.push_back(shadowView(matrix, c, {0, {8 * face, 0}, {8, 8}, 0.5f}));
        }
        LightSource lamp = source(pointSource, {}, {}, glm::vec3(1.0f));
        lamp.kind = {pointSource, 0, 6, 0};
        scene.add(lamp);
        for (cpu::Isa isa : cpu::availableIsas()) {
            const std::vector<float> light = scene.light(isa);
            for (int i = 0; i < 6; ++i) {
                CAPTURE(i);
                // At 4 + 0.49 m^2, and the cosine of 2 m over that distance.
                const float expected = i == hidden ? 0.0f : 2.0f / std::pow(4.49f, 1.5f) / pi;
                CHECK(light[size_t(i)] == doctest::Approx(expected).epsilon(1e-4));
            }
        }
        // Views that the buffer does not hold hide nothing.
        scene.settings.maximumShadowViews = 5;
        for (cpu::Isa isa : cpu::availableIsas()) CHECK(scene.light(isa)[size_t(hidden)] > 0.0f);
    }
}

TEST_CASE("surfel light: a surfel at a shadow's edge is lit by the share of its places") {
    // A disc of radius 1 in the middle of the edge x = 0.
    const glm::mat4 matrix = glm::orthoRH_ZO(-2.0f, 2.0f, -2.0f, 2.0f, 0.0f, 4.0f) *
                             glm::lookAtRH(glm::vec3(0, 0, 2), glm::vec3(0), glm::vec3(0, 1, 0));
    for (int places : {1, 2, 4, 9, 16}) {
        Scene scene(bakeOf({{{0, 0, 0}, {0, 0, 1}, pi}}));
        scene.settings.placesPerSurfel = places;
        scene.maps.push_back(mapOf({1000, 64}, {}, 0.25f, [](int x, int) { return x >= 500; }));
        scene.views.push_back(shadowView(matrix, {}, {0, {0, 0}, {1000, 64}}));
        LightSource sun = source(directionalSource, {}, {0, 0, -1}, glm::vec3(pi));
        sun.kind.z = 1;
        scene.add(sun);
        for (cpu::Isa isa : cpu::availableIsas()) {
            const float share = scene.light(isa)[0] * float(places);
            CAPTURE(places);
            CHECK(share == doctest::Approx(std::round(share)).epsilon(1e-5));
            // As many on one side as on the other, but for one; alone, it lies on the edge.
            if (places > 1) CHECK(std::abs(share - 0.5f * float(places)) <= 1.0f);
        }
    }
}

TEST_CASE("surfel light: places lie on the disc, around its middle") {
    for (int count = 1; count <= detail::maximumPlacesPerSurfel; ++count) {
        glm::dvec2 mean(0.0);
        double square = 0.0;
        for (const auto& p : detail::placesOnSurfel(count)) {
            const glm::dvec2 at(p.place.x, p.place.y);
            CHECK(glm::length(at) <= 1.0);
            mean += at / double(count);
            square += glm::dot(at, at) / double(count);
        }
        CHECK(glm::length(mean) < 1e-6);
        if (count >= 4) CHECK(square == doctest::Approx(0.5).epsilon(0.1)); // of the whole disc, 1 / 2
    }
}

TEST_CASE("surfel light: settings out of range, and too many sources, are refused by name") {
    const auto refusal = [](auto change) {
        SurfelLightSettings settings;
        settings.surfels = 10;
        change(settings);
        const auto plan = planSurfelLight(settings);
        REQUIRE_FALSE(plan);
        return plan.error().message;
    };
    CHECK(refusal([](auto& s) { s.surfels = 0; }) == "settings.surfels is 0; 1 to 1048576 was expected");
    CHECK(refusal([](auto& s) { s.maximumSources = 0; }) ==
          "settings.maximumSources is 0; 1 to 4096 was expected");
    CHECK(refusal([](auto& s) { s.placesPerSurfel = 17; }) ==
          "settings.placesPerSurfel is 17; 1 to 16 was expected");
    CHECK(refusal([](auto& s) { s.maximumShadowViews = 4097; }) ==
          "settings.maximumShadowViews is 4097; 1 to 4096 was expected");
    CHECK(refusal([](auto& s) {
              s.shadowMaps.assign(5, {8, 8});
          }) == "settings.shadowMaps has 5 sizes; 0 to 4 were expected");
    CHECK(refusal([](auto& s) {
              s.shadowMaps = {{8, 8}, {0, 8}};
          }) == "settings.shadowMaps[1] is 0x8; 1x1 to 16384x16384 was expected");
    SurfelLightFrame<cpu::Image> frame;
    frame.sources = 65;
    const auto inputs = surfelLightInputs(SurfelLightSettings{}, frame);
    REQUIRE_FALSE(inputs);
    CHECK(inputs.error().message == "frame.sources is 65; 0 to 64, settings.maximumSources, was expected");
    CHECK(planSurfelImages(0).error().message == "surfels is 0; 1 to 1048576 was expected");
    CHECK(planSurfelLightFromImage(1u << 21, SurfelImageLight::irradianceOverPi).error().message ==
          "surfels is 2097152; 1 to 1048576 was expected");
    // The largest is as large as images may be.
    CHECK(validate(*planSurfelImages(1u << 20)));
}

TEST_CASE("surfel light: without shadow maps there is no view and no image") {
    SurfelLightSettings settings;
    settings.surfels = 10;
    const Plan plan = *planSurfelLight(settings);
    CHECK(plan.passes.size() == 1);
    CHECK(plan.find("shadow views") < 0);
    for (const Resource& r : plan.resources) CHECK_FALSE(isImage(r.kind));
}

TEST_CASE("surfel images hold what the bake says of each surfel, and take its light back") {
    std::vector<MadeSurfel> surfels;
    for (int i = 0; i < 70; ++i)
        surfels.push_back({glm::vec3(i, 2 * i, -i),
                           glm::normalize(glm::vec3(i - 30, 1, i % 7)),
                           0.5f + float(i),
                           {float(i % 3) / 2.0f, 1.0f, 0.25f}});
    const Bake bake = bakeOf(surfels);
    const auto section = bake.section(BakeSection::surfels);
    const Extent2D extent = surfelImageExtent(70);
    CHECK(extent == Extent2D{64, 2});
    for (cpu::Isa isa : cpu::availableIsas()) {
        Picture positions(extent, 4, -7.0f), normals(extent, 3, -7.0f), albedo(extent, 3, -7.0f);
        auto program = deviceFor(isa).compile(*planSurfelImages(70));
        REQUIRE(program);
        const cpu::Buffer packed = bufferOf(section.data(), section.size_bytes());
        REQUIRE(program->record({{{"surfel positions", positions.image()},
                                  {"surfel normals", normals.image()},
                                  {"surfel albedo", albedo.image()}},
                                 {},
                                 {{"surfels", packed}}}));
        Picture irradiance(extent, 3), reflected(extent, 3);
        for (int i = 0; i < 128; ++i) {
            const int x = i % 64, y = i / 64;
            const Surfel s = i < 70 ? surfelOf(bake, uint32_t(i))
                                    : Surfel{glm::vec3(0), glm::vec3(0), 0, glm::vec3(0), {}};
            for (int c = 0; c < 3; ++c) {
                CHECK(positions.at(x, y, c) == s.position[c]);
                CHECK(std::abs(normals.at(x, y, c) - s.normal[c]) < 1e-6f);
                CHECK(std::abs(albedo.at(x, y, c) - s.albedo[c]) < 1e-6f);
                irradiance.at(x, y, c) = float(100 * c + i);
                reflected.at(x, y, c) = albedo.at(x, y, c) * float(100 * c + i);
            }
            CHECK(positions.at(x, y, 3) == s.area);
        }
        for (SurfelImageLight meaning :
             {SurfelImageLight::irradianceOverPi, SurfelImageLight::reflectedRadiance}) {
            const bool isReflected = meaning == SurfelImageLight::reflectedRadiance;
            auto back = deviceFor(isa).compile(*planSurfelLightFromImage(70, meaning));
            REQUIRE(back);
            std::vector<float> light(3 * 128, -7.0f);
            REQUIRE(back->record(
                {{{"lit surfels", (isReflected ? reflected : irradiance).image()}},
                 {},
                 {{"surfels", packed}, {"surfel light", bufferOf(light.data(), 4 * light.size())}}}));
            for (size_t c = 0; c < 3; ++c)
                for (size_t i = 0; i < 70; ++i) {
                    const bool isBlack = isReflected && surfels[i].albedo[int(c)] == 0.0f;
                    CHECK(light[128 * c + i] ==
                          doctest::Approx(isBlack ? 0.0f : float(100 * c + i)).epsilon(1e-6));
                }
        }
    }
}

TEST_CASE("surfel light in front of composition is what the host would hand in") {
    MadeBake made = gridInView();
    made.surfels.assign(70, made.surfels[0]);
    for (size_t i = 0; i < 70; ++i) made.surfels[i].position = glm::vec3(float(i) * 0.1f, 0, 0);
    MadeBake probe = made;
    const uint32_t root = probe.pack().layout.nodes - 1;
    for (MadeCache& cache : made.caches) linkAround(cache, 0.01f, root);
    const Bake bake = made.pack();
    Scene scene(bake);
    scene.add(source(pointSource, {3, 1, 2}, {}, {8, 4, 2}));
    for (cpu::Isa isa : cpu::availableIsas()) {
        CompositionFrames handed(isa, bake, settingsFor(bake));
        handed.light = scene.light(isa);
        handed.run();
        CHECK(handed.indirectAt(3, 3).x > 0.0f);

        auto inside = scene.settings;
        inside.handOut = false;
        Plan plan = *planSurfelLight(inside);
        AppendOptions options;
        options.bindings = {{"surfel light", "surfel light"}};
        REQUIRE(append(plan, *planIlluminanceComposition(handed.settings), options));
        auto program = deviceFor(isa).compile(plan);
        REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
        SurfelLightFrame<cpu::Image> frame;
        frame.sources = 1;
        const auto section = bake.section(BakeSection::surfels);
        frame.surfels = bufferOf(section.data(), section.size_bytes());
        frame.lightSources = bufferOf(scene.sources.data(), scene.sources.size() * sizeof(LightSource));
        auto inputs = *surfelLightInputs(inside, frame);
        const Picture expected = handed.indirect;
        std::fill(handed.indirect.values.begin(), handed.indirect.values.end(), -1.0f);
        REQUIRE(append(inputs, handed.inputs(), options));
        const auto done = program->record(inputs);
        REQUIRE_MESSAGE(done, (done ? "" : done.error().message));
        CHECK(sameBits(handed.indirect, expected));
    }
}

} // namespace rebound::test
