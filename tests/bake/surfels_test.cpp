// SPDX-License-Identifier: MIT
#include "rebound/bake/surfels.hpp"
#include "rebound/embree/ray_caster.hpp"

#include "shapes.hpp"
#include "triangle.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

using namespace rebound;

namespace {

std::vector<Surfel> surfelsOf(const BakeGeometry& geometry, const BakeSettings& settings) {
    const auto caster = EmbreeRayCaster::build(geometry);
    REQUIRE_MESSAGE(caster, caster.error().message);
    auto surfels = placeSurfels(geometry, *caster, settings);
    REQUIRE_MESSAGE(surfels, surfels.error().message);
    return *surfels;
}

std::vector<Surfel> surfelsOf(const BakeGeometry& geometry, uint32_t count = 2000) {
    BakeSettings settings;
    settings.surfels = count;
    return surfelsOf(geometry, settings);
}

double areaOf(const std::vector<Surfel>& surfels) {
    double sum = 0.0;
    for (const Surfel& surfel : surfels) sum += double(surfel.area);
    return sum;
}

double areaOf(const BakeGeometry& geometry) {
    double sum = 0.0;
    for (uint32_t i = 0; i < geometry.triangles(); ++i) sum += detail::Triangle(geometry, i).area();
    return sum;
}

std::string errorOf(const BakeGeometry& geometry, const BakeSettings& settings) {
    struct NoRays : RayCaster {
        void intersect(std::span<const BakeRay>, std::span<BakeHit>) const override {
            FAIL("a ray was cast");
        }
        void occluded(std::span<const BakeRay>, std::span<uint8_t>) const override { FAIL("a ray was cast"); }
    };
    const auto surfels = placeSurfels(geometry, NoRays(), settings);
    return surfels ? "no error" : surfels.error().message;
}

constexpr double rounding = 1e-5; // of thousands of areas in single precision

} // namespace

TEST_CASE(
    "Areas add up to those of the sides that can be lit: a box's and a sphere's outer, both of a quad") {
    BakeGeometry box, sphere, quad;
    addBox(box, {-1, -1, -1}, {1, 2, 3});
    addSphere(sphere, {0, 5, 0}, 2.0f, 12);
    addQuad(quad, {0, 0, 0}, {3, 0, 0}, {1, 2, 0});
    for (const BakeGeometry* closed : {&box, &sphere}) {
        const std::vector<Surfel> surfels = surfelsOf(*closed);
        CHECK(areaOf(surfels) == doctest::Approx(areaOf(*closed)).epsilon(rounding));
        CHECK(double(surfels.size()) == doctest::Approx(2000).epsilon(0.05));
    }
    for (const Surfel& surfel : surfelsOf(box))
        CHECK(glm::dot(surfel.normal, surfel.position - glm::vec3(0.0f, 0.5f, 1.0f)) > 0.0f);
    const std::vector<Surfel> both = surfelsOf(quad);
    CHECK(areaOf(both) == doctest::Approx(2.0 * 6.0).epsilon(rounding));
    CHECK(double(both.size()) == doctest::Approx(2000).epsilon(0.05));
}

TEST_CASE("Sides between the two skins of a wall see back faces alone and are dropped") {
    BakeGeometry geometry;
    addBox(geometry, {-1, -1, -1}, {1, 1, 1}, true);
    addBox(geometry, {-1.1f, -1.1f, -1.1f}, {1.1f, 1.1f, 1.1f}, false);
    const std::vector<Surfel> surfels = surfelsOf(geometry);
    CHECK(areaOf(surfels) == doctest::Approx(6 * 4.0 + 6 * 2.2 * 2.2).epsilon(rounding));
    for (const Surfel& surfel : surfels) {
        const float furthest =
            std::max({std::abs(surfel.position.x), std::abs(surfel.position.y), std::abs(surfel.position.z)});
        CHECK(glm::dot(surfel.normal, surfel.position) * (furthest - 1.05f) > 0.0f);
    }
}

TEST_CASE("A side that sees the open alone has few surfels, and its whole area") {
    BakeGeometry room;
    addBox(room, {-1, -1, -1}, {1, 1, 1}, true);
    const std::vector<Surfel> surfels = surfelsOf(room);
    CHECK(double(surfels.size()) == doctest::Approx(2000).epsilon(0.05));
    double inside = 0.0;
    size_t count = 0;
    for (const Surfel& surfel : surfels) {
        if (glm::dot(surfel.normal, surfel.position) > 0.0f) continue;
        inside += double(surfel.area);
        ++count;
    }
    CHECK(inside == doctest::Approx(24.0).epsilon(rounding));
    CHECK(areaOf(surfels) == doctest::Approx(48.0).epsilon(rounding));
    // 1 outside for 16 inside, and no less than one for each of six walls.
    CHECK(double(count) == doctest::Approx(2000.0 * 16.0 / 17.0).epsilon(0.05));
}

TEST_CASE("No two surfels of one side are near each other, and none is far from all") {
    BakeGeometry geometry;
    addBox(geometry, {0, 0, 0}, {4, 4, 4}, true);
    const std::vector<Surfel> surfels = surfelsOf(geometry, 3000);
    // 96 m^2 for 3000 * 16 / 17 surfels inside: when no more fit in, discs of half the distance cover 0.547 of an area
    // (Renyi's parking constant in the plane), and a few percent less of what only 16 points a surfel stand for.
    const double spacing = std::sqrt(0.5 * 4.0 / 3.14159 * 96.0 * 17.0 / 16.0 / 3000.0);
    size_t inside = 0;
    for (const Surfel& a : surfels) {
        if (glm::dot(a.normal, glm::vec3(2.0f) - a.position) < 0.0f) continue;
        ++inside;
        double nearest = std::numeric_limits<double>::infinity();
        for (const Surfel& b : surfels)
            if (&a != &b && glm::dot(a.normal, b.normal) > 0.9f)
                nearest = std::min(nearest, double(glm::length(a.position - b.position)));
        CHECK(nearest > 0.9 * spacing);
        CHECK(nearest < 2.0 * spacing);
    }
    CHECK(inside > 2500);
}

TEST_CASE("The two sides of a thin wall do not reject each other") {
    BakeGeometry geometry;
    addBox(geometry, {-2, -2, -2}, {2, 2, 2}, true);
    addBox(geometry, {-2, -2, -0.0005f}, {2, 2, 0.0005f});
    const std::vector<Surfel> surfels = surfelsOf(geometry, 3000);
    std::array<int, 2> sides{};
    double area = 0.0;
    for (const Surfel& surfel : surfels)
        if (std::abs(surfel.position.z) < 0.001f && std::abs(surfel.normal.z) > 0.5f) {
            ++sides[surfel.normal.z > 0.0f];
            area += double(surfel.area);
        }
    CHECK(area ==
          doctest::Approx(32.0).epsilon(0.01)); // samples at its four edges may see through between the boxes
    // 128 m^2 inside altogether, 16 on each side of the wall, and some outside.
    for (const int side : sides) CHECK(side == doctest::Approx(3000.0 * 16.0 / 128.0).epsilon(0.1));
}

TEST_CASE("Albedo and emission are means over what a surfel stands for, and holes have no area") {
    BakeGeometry board;
    addQuad(board, {0, 0, 0}, {8, 0, 0}, {0, 8, 0});
    const auto field = [](uint32_t triangle, glm::vec2 place) {
        // The quad's second triangle has the diagonal as its first side.
        const glm::vec2 at =
            triangle == 0 ? glm::vec2(place.x + place.y, place.y) : glm::vec2(place.x, place.x + place.y);
        return glm::ivec2(glm::floor(at * 64.0f));
    };
    board.surface = [&](uint32_t triangle, glm::vec2 place) {
        const glm::ivec2 at = field(triangle, place);
        BakeSurface surface;
        surface.albedo = (at.x + at.y) % 2 ? glm::vec3(0.9f, 0.1f, 0.5f) : glm::vec3(0.1f, 0.9f, 0.5f);
        surface.emission = glm::vec3(at.y < 32 ? 2.0f : 0.0f);
        return surface;
    };
    // Fields of 1/8 m under surfels of about 1/3 m^2: some 20 fields each, seen by 16 x 4096 / 400 samples.
    const std::vector<Surfel> surfels = surfelsOf(board, 400);
    glm::dvec3 mean(0.0), emitted(0.0);
    for (const Surfel& surfel : surfels) {
        mean += double(surfel.area) * glm::dvec3(surfel.albedo) / areaOf(surfels);
        emitted += double(surfel.area) * glm::dvec3(surfel.emission);
        CHECK(surfel.albedo.x == doctest::Approx(0.5).epsilon(0.45));
        CHECK(surfel.albedo.z == doctest::Approx(0.5).epsilon(1e-6));
    }
    CHECK(mean.x == doctest::Approx(0.5).epsilon(0.01)); // 16384 low-discrepancy points over 4096 fields
    CHECK(mean.y == doctest::Approx(0.5).epsilon(0.01));
    CHECK(emitted.x == doctest::Approx(2.0 * 64.0).epsilon(0.005)); // half of 64 m^2, both sides

    board.surface = [&](uint32_t triangle, glm::vec2 place) {
        const glm::ivec2 at = field(triangle, place);
        BakeSurface surface;
        surface.hole = (at.x + at.y) % 2 == 0 || at.y < 32;
        return surface;
    };
    const std::vector<Surfel> leaves = surfelsOf(board, 400);
    // 16384 samples of which a quarter counts: a random choice would deviate by 1.4 % in the mean.
    CHECK(areaOf(leaves) == doctest::Approx(2.0 * 64.0 / 4.0).epsilon(0.03));
    for (const Surfel& surfel : leaves) CHECK(surfel.position.y >= 4.0f);
}

TEST_CASE("Without a function of surfaces everything is white and nothing emits") {
    BakeGeometry box;
    addBox(box, {0, 0, 0}, {1, 1, 1});
    for (const Surfel& surfel : surfelsOf(box, 50)) {
        CHECK(surfel.albedo == glm::vec3(1.0f));
        CHECK(surfel.emission == glm::vec3(0.0f));
    }
}

TEST_CASE("Surfels are the same bits for any number of threads, and others for another seed") {
    BakeGeometry geometry;
    addBox(geometry, {-2, -2, -2}, {2, 2, 2}, true);
    addSphere(geometry, {0, 0, 0}, 1.0f, 16);
    BakeSettings settings;
    settings.surfels = 5000;
    settings.threads = 1;
    const std::vector<Surfel> one = surfelsOf(geometry, settings);
    const auto isSame = [&](const std::vector<Surfel>& other) {
        return other.size() == one.size() &&
               std::memcmp(other.data(), one.data(), one.size() * sizeof(Surfel)) == 0;
    };
    for (const int threads : {2, 5}) {
        settings.threads = threads;
        CHECK(isSame(surfelsOf(geometry, settings)));
    }
    settings.seed = 1;
    CHECK(!isSame(surfelsOf(geometry, settings)));
}

TEST_CASE("A million triangles and two give as many surfels of the same area") {
    BakeGeometry fine, coarse;
    constexpr uint32_t cells = 708;
    for (uint32_t y = 0; y <= cells; ++y)
        for (uint32_t x = 0; x <= cells; ++x)
            fine.positions.emplace_back(10.0f * float(x) / cells, 10.0f * float(y) / cells, 0.0f);
    for (uint32_t y = 0; y < cells; ++y)
        for (uint32_t x = 0; x < cells; ++x) {
            const uint32_t a = y * (cells + 1) + x, b = a + cells + 1;
            for (const uint32_t index : {a, a + 1, b, a + 1, b + 1, b}) fine.indices.push_back(index);
        }
    REQUIRE(fine.triangles() > 1000000);
    addQuad(coarse, {0, 0, 0}, {10, 0, 0}, {0, 10, 0});
    for (const BakeGeometry* geometry : {&fine, &coarse}) {
        const std::vector<Surfel> surfels = surfelsOf(*geometry, 4000);
        CHECK(double(surfels.size()) == doctest::Approx(4000).epsilon(0.05));
        CHECK(areaOf(surfels) == doctest::Approx(200.0).epsilon(rounding));
        double deviation = 0.0;
        const double mean = 200.0 / double(surfels.size());
        for (const Surfel& surfel : surfels) deviation += std::pow(double(surfel.area) / mean - 1.0, 2.0);
        // Cells of dart throwing vary by about a quarter.
        CHECK(std::sqrt(deviation / double(surfels.size())) < 0.35);
    }
}

TEST_CASE("Scenes of 1 mm and of 100 km have surfels; smaller, larger and distant ones are refused") {
    const auto room = [](float size) {
        BakeGeometry geometry;
        addBox(geometry, glm::vec3(0.0f), glm::vec3(size), true);
        addBox(geometry, glm::vec3(0.3f * size), glm::vec3(0.7f * size));
        return geometry;
    };
    for (const double diagonal : {1e-3, 1.0, 1e5}) {
        const double size = diagonal / std::sqrt(3.0);
        const std::vector<Surfel> surfels = surfelsOf(room(float(size)), 1000);
        CHECK(double(surfels.size()) == doctest::Approx(1000).epsilon(0.05));
        CHECK(areaOf(surfels) == doctest::Approx(size * size * (12.0 + 6.0 * 0.16)).epsilon(1e-4));
    }
    CHECK(errorOf(room(0.0005f), {}) ==
          "geometry is 0.000866025 m from corner to corner; 0.001 to 100000 m were expected");
    CHECK(errorOf(room(60000.0f), {}) ==
          "geometry is 103923 m from corner to corner; 0.001 to 100000 m were expected");
    BakeGeometry distant = room(1.0f);
    for (glm::vec3& position : distant.positions) position.x += 4096.0f;
    CHECK(errorOf(distant, {}) ==
          "geometry of 1.73205 m lies 4097 m from the origin; at most 1000 times its size was "
          "expected");
}

TEST_CASE("What is no geometry is refused, with a sentence that names it") {
    BakeGeometry geometry;
    CHECK(errorOf(geometry, {}) ==
          "geometry.indices has 0 numbers; three a triangle, and at least one triangle, "
          "were expected");
    addQuad(geometry, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    BakeGeometry broken = geometry;
    broken.indices.pop_back();
    CHECK(errorOf(broken, {}) ==
          "geometry.indices has 5 numbers; three a triangle, and at least one triangle, "
          "were expected");
    broken = geometry;
    broken.indices[4] = 4;
    CHECK(errorOf(broken, {}) ==
          "geometry.indices[4] is 4; less than 4, the number of positions, was expected");
    broken = geometry;
    broken.positions[2] = {0, std::numeric_limits<float>::infinity(), 0};
    CHECK(errorOf(broken, {}) == "geometry.positions[2] is (0, inf, 0); finite coordinates were expected");
    broken = geometry;
    for (glm::vec3& position : broken.positions) position.y = 0.0f;
    CHECK(errorOf(broken, {}) ==
          "geometry has 2 triangles of no area; at least one that has an area was expected");
}

TEST_CASE("Geometry of holes alone, or of back faces, is refused") {
    BakeGeometry geometry;
    addQuad(geometry, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    geometry.surface = [](uint32_t, glm::vec2) {
        BakeSurface surface;
        surface.hole = true;
        return surface;
    };
    const auto caster = EmbreeRayCaster::build(geometry);
    REQUIRE(caster);
    const auto surfels = placeSurfels(geometry, *caster, {});
    REQUIRE(!surfels);
    CHECK(surfels.error().message ==
          "geometry has 2 triangles of which no side sees anything but back faces or holes; "
          "one that does was expected");
}

TEST_CASE("Settings out of range are refused, with a sentence that names them") {
    BakeGeometry geometry;
    addQuad(geometry, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const auto error = [&](auto change) {
        BakeSettings settings;
        change(settings);
        return errorOf(geometry, settings);
    };
    CHECK(error([](BakeSettings& s) { s.surfels = 0; }) ==
          "settings.surfels is 0; 1 to 1048576 was expected");
    CHECK(error([](BakeSettings& s) { s.surfels = 1048577; }) ==
          "settings.surfels is 1048577; 1 to 1048576 was expected");
    CHECK(error([](BakeSettings& s) { s.caches = 7; }) == "settings.caches is 7; 8 to 16777216 was expected");
    CHECK(error([](BakeSettings& s) { s.links = 0; }) == "settings.links is 0; 1 to 4096 was expected");
    CHECK(error([](BakeSettings& s) { s.links = 4097; }) == "settings.links is 4097; 1 to 4096 was expected");
    CHECK(error([](BakeSettings& s) { s.bands = 9; }) == "settings.bands is 9; 2 to 4 was expected");
    CHECK(error([](BakeSettings& s) { s.raysPerLink = 0; }) ==
          "settings.raysPerLink is 0; 1 to 1024 was expected");
    CHECK(error([](BakeSettings& s) { s.threads = -1; }) == "settings.threads is -1; 0 to 1024 was expected");
    CHECK(error([](BakeSettings& s) { s.spacing = -1.0f; }) ==
          "settings.spacing is -1.000000; 0, or up to 100000 m, was expected");
    CHECK(error([](BakeSettings& s) { s.spacing = std::numeric_limits<float>::quiet_NaN(); }) ==
          "settings.spacing is nan; 0, or up to 100000 m, was expected");
    CHECK(error([](BakeSettings& s) { s.linkForm = LinkForm(7); }) ==
          "settings.linkForm is 7; coefficients or direction was expected");
    CHECK(error([](BakeSettings& s) { s.hierarchy = BakeHierarchy(7); }) ==
          "settings.hierarchy is 7; cluster, kdTree or paper was expected");
}

TEST_CASE("A lamp that is a millionth of all surfaces sends what it emits") {
    BakeGeometry hall;
    addBox(hall, {-10, -10, -10}, {10, 10, 10}, true);
    addSphere(hall, {1, 2, 3}, 0.014f, 8); // 1e-6 of 2400 m^2
    BakeGeometry lamp;
    addSphere(lamp, {1, 2, 3}, 0.014f, 8);
    hall.surface = [](uint32_t triangle, glm::vec2) {
        BakeSurface surface;
        surface.albedo = glm::vec3(0.5f);
        surface.emission = triangle >= 12 ? glm::vec3(1000.0f, 500.0f, 0.0f) : glm::vec3(0.0f);
        return surface;
    };
    const std::vector<Surfel> surfels = surfelsOf(hall);
    double emitted = 0.0, emitters = 0.0, others = 0.0;
    size_t count = 0;
    for (const Surfel& surfel : surfels) {
        emitted += double(surfel.area) * double(surfel.emission.x);
        (surfel.emission.x > 0.0f ? emitters : others) += double(surfel.area);
        count += surfel.emission.x > 0.0f;
    }
    CHECK(emitted == doctest::Approx(1000.0 * areaOf(lamp)).epsilon(1e-4));
    CHECK(emitters == doctest::Approx(areaOf(lamp)).epsilon(1e-4));
    CHECK(others == doctest::Approx(2.0 * 2400.0).epsilon(1e-4));
    CHECK(count >= 4);   // that a sphere sends to all sides
    CHECK(count <= 250); // and no more than an eighth
}

TEST_CASE("Where everything emits, surfels are as dense everywhere as without") {
    BakeGeometry furnace;
    addBox(furnace, {-1, -1, -1}, {1, 1, 1}, true);
    furnace.surface = [](uint32_t, glm::vec2) {
        BakeSurface surface;
        surface.emission = glm::vec3(1.0f);
        return surface;
    };
    const std::vector<Surfel> surfels = surfelsOf(furnace);
    CHECK(double(surfels.size()) == doctest::Approx(2000).epsilon(0.05));
    CHECK(areaOf(surfels) == doctest::Approx(48.0).epsilon(rounding));
}

TEST_CASE("What a surfel sees of the open is its half space's part, and nothing in a closed room") {
    BakeGeometry room, street;
    addBox(room, {-1, -1, -1}, {1, 1, 1}, true);
    // A floor between two walls of front faces, each as high as the floor is wide, and much longer.
    addQuad(street, {-1, 0, 100}, {2, 0, 0}, {0, 0, -200});
    addQuad(street, {-1, 0, 100}, {0, 0, -200}, {0, 2, 0});
    addQuad(street, {1, 0, -100}, {0, 0, 200}, {0, 2, 0});
    for (const Surfel& surfel : surfelsOf(room, 500)) {
        const bool isInside = glm::dot(surfel.normal, surfel.position) < 0.0f;
        // The mean of cosine-weighted directions is 2/3 of the normal; of 64 of them, within some percent.
        CHECK(glm::length(surfel.open - (isInside ? 0.0f : 2.0f / 3.0f) * surfel.normal) < 0.04f);
    }
    int count = 0;
    for (const Surfel& surfel : surfelsOf(street, 2000)) {
        if (surfel.normal.y < 0.5f || std::abs(surfel.position.z) > 80.0f) continue;
        ++count;
        // 1 / pi times the integral of y^2 over the strip of the sky from angle a on the left of straight up to b on
        // the right: 4/3 for the integral of sin^3 along the street, times that of cos^2 across it.
        const double x = double(surfel.position.x);
        const double a = std::atan((1.0 + x) / 2.0), b = std::atan((1.0 - x) / 2.0);
        const double expected =
            2.0 / 3.0 / 3.14159265 * (a + b + std::sin(a) * std::cos(a) + std::sin(b) * std::cos(b));
        CHECK(std::abs(double(surfel.open.y) - expected) <
              0.12); // a random choice of 64 rays would deviate by 0.05
    }
    CHECK(count > 100);
}
