// SPDX-License-Identifier: MIT
#include "rebound/bake/bake_scene.hpp"

#include "baked_light.hpp"
#include "rooms.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>

using namespace rebound;

namespace {

// Of every place on the inner sides of a box, not too near its edges, where a cell's size decides.
template <class Body>
void forPlacesIn(glm::vec3 lower, glm::vec3 upper, const Body& body) {
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {0.0f, 1.0f})
            for (const float u : {0.11f, 0.37f, 0.5f, 0.71f, 0.93f})
                for (const float v : {0.09f, 0.33f, 0.52f, 0.77f, 0.95f}) {
                    glm::vec3 share(0.0f), normal(0.0f);
                    share[axis] = side;
                    share[(axis + 1) % 3] = u;
                    share[(axis + 2) % 3] = v;
                    normal[axis] = side > 0.5f ? -1.0f : 1.0f;
                    body(lower + share * (upper - lower), normal);
                }
}

std::string refusal(const BakeGeometry& geometry, const BakeSettings& settings) {
    const BakeGeometry castable = closedBox();
    const auto caster = EmbreeRayCaster::build(castable);
    REQUIRE(caster);
    const auto bake = bakeScene(geometry, *caster, settings);
    REQUIRE(!bake);
    CHECK(bake.error().message.find('\n') == std::string::npos);
    return bake.error().message;
}

} // namespace

TEST_CASE("a bake is the same for any number of threads") {
    BakeGeometry geometry = closedBox();
    addBox(geometry, {1.5f, 0, 2}, {2.5f, 2, 3});
    BakeSettings settings = smallSettings();
    settings.threads = 1;
    settings.lightMap = 200;
    const Bake one = bakeOf(geometry, settings);
    CHECK(validate(one));
    for (const int threads : {2, 5}) {
        settings.threads = threads;
        const Bake many = bakeOf(geometry, settings);
        CHECK(std::memcmp(&one.layout, &many.layout, sizeof(BakeLayout)) == 0);
        for (size_t i = 0; i < size_t(bakeSectionCount); ++i) {
            INFO("section ", name(BakeSection(i)));
            REQUIRE(one.sections[i].size() == many.sections[i].size());
            CHECK(std::ranges::equal(one.sections[i], many.sections[i]));
        }
    }
    settings.seed = 1; // surfels elsewhere
    CHECK(!std::ranges::equal(bakeOf(geometry, settings).section(BakeSection::surfels),
                              one.section(BakeSection::surfels)));
}

TEST_CASE("every number of bands, links and both forms make a valid bake") {
    for (const LinkForm form : {LinkForm::coefficients, LinkForm::direction})
        for (const uint32_t bands : {2u, 3u, 4u})
            for (const uint32_t links : {1u, 33u}) {
                BakeSettings settings = smallSettings();
                settings.linkForm = form;
                settings.bands = bands;
                settings.links = links;
                const Bake bake = bakeOf(closedBox(), settings);
                CHECK(validate(bake));
                CHECK(bake.layout.links == links);
            }
}

TEST_CASE("links by direction point to their senders") {
    BakeSettings settings = smallSettings();
    settings.linkForm = LinkForm::direction;
    const Bake bake = bakeOf(closedBox(), settings);
    const auto surfels = bake.section(BakeSection::surfels);
    const size_t surfelStride = BakeLayout::stride(bake.layout.surfels);
    const BakedLight light(bake, [](glm::vec3, glm::vec3) { return 1.0; });
    size_t single = 0;
    for (size_t cache = 0; cache < bake.layout.caches; ++cache)
        for (size_t link = 0; link < bake.layout.links; ++link) {
            const size_t at = BakeLayout::ofCache(cache, link, bake.layout.links);
            const uint32_t node = bake.section(BakeSection::linkNodes)[at];
            if (node >= bake.layout.surfels) continue;
            ++single;
            glm::vec3 sender;
            for (int k = 0; k < 3; ++k)
                sender[k] = std::bit_cast<float>(surfels[size_t(k) * surfelStride + node]);
            const float area = std::bit_cast<float>(surfels[4 * surfelStride + node]);
            const glm::vec3 towards = sender - light.place(cache);
            const glm::vec3 direction = unpackOctahedral(bake.section(BakeSection::linkShapes)[at]);
            // Few rays that meet a disc of that radius, or its surroundings.
            const float radius = std::sqrt(area / std::numbers::pi_v<float>);
            CHECK(glm::length(glm::cross(direction, towards)) < 2.0f * radius);
        }
    CHECK(single > 20);
}

TEST_CASE("constant radiance arrives as it is at every receiver, also where the grid ends in walls") {
    for (const float thickness : {0.0f, 0.05f, 0.6f}) {
        BakeGeometry geometry = closedBox();
        if (thickness > 0.0f) addBox(geometry, glm::vec3(-thickness), glm::vec3(4, 3, 5) + thickness);
        for (const float shift : {0.0f, 0.5f}) {
            const Bake bake = bakeOf(geometry, smallSettings(), shift);
            const BakedLight light(bake, [](glm::vec3 p, glm::vec3 n) {
                return glm::dot(p - glm::vec3(2, 1.5f, 2.5f), n) < 0.0f ? 1.0 : 0.0; // inner sides alone
            });
            forPlacesIn({0, 0, 0}, {4, 3, 5}, [&](glm::vec3 p, glm::vec3 n) {
                // As exact as caches are; see the test of links.
                CHECK(light.atReceiver(p, n) == doctest::Approx(1.0).epsilon(0.02));
            });
        }
    }
}

TEST_CASE("of a lit room's light, next to nothing is seen through the wall") {
    BakeSettings settings = smallSettings();
    settings.links = 128;
    for (const float wall : {0.2f, 0.6f})
        for (const float shift : {0.0f, 0.25f, 0.5f}) {
            const Bake bake = bakeOf(twoRooms(wall), settings, shift);
            const BakedLight light(
                bake, [&](glm::vec3 p, glm::vec3) { return p.x > 3.0f + 0.5f * wall ? 1.0 : 0.0; });
            double dark = 0.0, lit = 0.0;
            forPlacesIn({0, 0, 0}, {3, 3, 3},
                        [&](glm::vec3 p, glm::vec3 n) { dark += light.atReceiver(p, n); });
            forPlacesIn({3.0f + wall, 0, 0}, {6.0f + wall, 3, 3},
                        [&](glm::vec3 p, glm::vec3 n) { lit += light.atReceiver(p, n); });
            CHECK(dark < 1e-3 * lit);
        }
}

TEST_CASE("where the grid lies changes little") {
    BakeGeometry geometry;
    addBox(geometry, {0, 0, 0}, {8, 4, 8}, true);
    addBox(geometry, {3.5f, 0, 3.5f}, {4.5f, 3, 4.5f});
    BakeSettings settings = smallSettings();
    settings.caches = 1500;
    settings.links = 128;
    const auto radiance = [](glm::vec3 p, glm::vec3 n) {
        return n.y > 0.5f && p.x < 3.0f && p.y < 1.0f ? 1.0 : 0.05;
    };
    std::vector<double> sums[2];
    for (const int k : {0, 1}) {
        const Bake bake = bakeOf(geometry, settings, k == 0 ? 0.0f : 0.5f);
        const BakedLight light(bake, radiance);
        forPlacesIn({0, 0, 0}, {8, 4, 8},
                    [&](glm::vec3 p, glm::vec3 n) { sums[k].push_back(light.atReceiver(p, n)); });
    }
    double difference = 0.0, total = 0.0;
    for (size_t i = 0; i < sums[0].size(); ++i) {
        difference += std::pow(sums[0][i] - sums[1][i], 2.0);
        total += sums[0][i] * sums[0][i];
    }
    CHECK(std::sqrt(difference / total) < 0.15);
}

TEST_CASE("a million tiny triangles and a scene of one quad are baked") {
    BakeGeometry many;
    addSphere(many, {0, 1, 0}, 1.0f, 500); // 10^6 triangles
    addQuad(many, {-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
    REQUIRE(many.triangles() > 1000000);
    CHECK(validate(bakeOf(many)));

    BakeGeometry open;
    addQuad(open, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const auto caster = EmbreeRayCaster::build(open);
    REQUIRE(caster);
    const auto bake = bakeScene(open, *caster, smallSettings());
    if (bake) CHECK(validate(*bake));
    else CHECK(bake.error().message.find("geometry") != std::string::npos);
}

TEST_CASE("scenes of any size and place are baked alike") {
    const BakedLight::Coefficients expected{std::sqrt(4.0 * std::numbers::pi)};
    for (const float size : {2e-4f, 1.0f, 1e4f}) {
        BakeGeometry geometry;
        addBox(geometry, glm::vec3(3, 2, 1) * size, glm::vec3(7, 5, 6) * size, true);
        const Bake bake = bakeOf(geometry);
        CHECK(validate(bake));
        CHECK(bake.layout.caches > 100);
        const BakedLight light(bake, [](glm::vec3, glm::vec3) { return 1.0; });
        for (size_t cache = 0; cache < bake.layout.caches; ++cache)
            CHECK(light.atCache(cache)[0] == doctest::Approx(expected[0]).epsilon(1e-3));
    }
}

TEST_CASE("what cannot be baked is refused in one sentence") {
    const BakeGeometry box = closedBox();
    BakeSettings settings = smallSettings();
    settings.links = 0;
    CHECK(refusal(box, settings).find("settings.links is 0") != std::string::npos);
    settings = smallSettings();
    settings.bands = 9;
    CHECK(refusal(box, settings).find("settings.bands is 9") != std::string::npos);
    settings = smallSettings();
    settings.spacing = 1e-4f;
    CHECK(refusal(box, settings).find("GiB") != std::string::npos);
    BakeGeometry flat;
    flat.positions = {glm::vec3(0), glm::vec3(1), glm::vec3(2)};
    flat.indices = {0, 1, 2};
    CHECK(refusal(flat, smallSettings()).find("no area") != std::string::npos);
    BakeGeometry broken = box;
    broken.positions[3].y = std::numeric_limits<float>::quiet_NaN();
    CHECK(refusal(broken, smallSettings()).find("positions[3]") != std::string::npos);
}

TEST_CASE("progress goes from nothing to all") {
    BakeSettings settings = smallSettings();
    double last = 0.0;
    std::string stages;
    settings.progress = [&](std::string_view what, double share) {
        if (stages.find(what) == std::string::npos) {
            stages += std::string(what) + ";";
            last = 0.0;
        }
        CHECK(share >= last);
        CHECK(share <= 1.0);
        last = share;
    };
    bakeOf(closedBox(), settings);
    CHECK(stages.find("links;") != std::string::npos);
    CHECK(last == 1.0);
}
