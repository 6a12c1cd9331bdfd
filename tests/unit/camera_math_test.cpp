// SPDX-License-Identifier: MIT
// From stored depth and normal to view space, and the area that a pixel stands for.
#include "kernel_runner.hpp"
#include "test_camera.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace rebound::test {
namespace {

constexpr double pi = std::numbers::pi;

Picture cameraMath(cpu::Isa isa, int mode, const GBufferConventions& c, const CameraConstants& camera,
                   Picture& depth, Picture& normal, float minimumCosine = 0.001f) {
    const Extent2D extent = depth.extent;
    const CameraMathConstants k{{extent.width, extent.height, 0, 0}, {minimumCosine, 0, 0, 0}};
    return runKernel(isa, {"camera_math",
                           {mode, c.projection == Projection::orthographic ? 1 : 0},
                           {{0, &depth}, {1, &normal}},
                           {{3, bytesOf(camera)}, {4, bytesOf(k)}},
                           2,
                           extent});
}

CameraConstants constantsOf(const GBufferConventions& c, const Camera& camera, Extent2D extent) {
    auto constants = cameraConstants(camera, c, extent);
    REQUIRE_MESSAGE(constants, (constants ? "" : constants.error().message));
    return *constants;
}

// A pinhole camera in the origin that looks along the axis.
GBufferConventions planar(Projection projection = Projection::perspective) {
    GBufferConventions c;
    c.projection = projection;
    return c;
}

const glm::mat4 someView = glm::lookAt(glm::vec3(3, 1, -2), glm::vec3(-1, 0.5f, 4), glm::vec3(0.2f, 1, 0.1f));

} // namespace

TEST_CASE("stored depth and pixel lead back to the point that was projected, under every convention") {
    const Extent2D extent{37, 11};
    const Lens lens;
    for (const GBufferConventions& c : everyConvention()) {
        const glm::mat4 view = viewOf(c, someView), projection = projectionOf(c, lens);
        const CameraConstants camera = constantsOf(c, {view, projection}, extent);
        Picture depth(extent, 1), normal(extent, 3);
        const double forward = c.handedness == Handedness::right ? -1.0 : 1.0;
        for (int i = 0; i < extent.width * extent.height; ++i)
            depth.values[size_t(i)] = storedDepth(c, lens, 0.6 + 0.05 * double(i));
        for (cpu::Isa isa : {cpu::Isa::scalar, deviceFor(cpu::Isa::automatic).isa()}) {
            const Picture points = cameraMath(isa, cameraPosition, c, camera, depth, normal);
            double worst = 0.0;
            for (int y = 0; y < extent.height; ++y)
                for (int x = 0; x < extent.width; ++x) {
                    const double distance = 0.6 + 0.05 * double(y * extent.width + x);
                    const glm::dvec4 p(points.at(x, y, 0), points.at(x, y, 1), forward * points.at(x, y, 2),
                                       1.0);
                    glm::dvec4 clip = glm::dmat4(projection) * p;
                    const double ndcY = clip.y / clip.w,
                                 row = c.firstRow == FirstRow::top ? 1.0 - ndcY : 1.0 + ndcY;
                    worst =
                        std::max(worst, std::abs((clip.x / clip.w + 1.0) * 0.5 * extent.width - (x + 0.5)));
                    worst = std::max(worst, std::abs(row * 0.5 * extent.height - (y + 0.5)));
                    // A step of stored depth close to 1 is z^2 / n * 2^-24: 5e-5 m at 20 m, a relative 2e-6;
                    // mapping it back in single precision costs a few times that.
                    CHECK(points.at(x, y, 2) == doctest::Approx(distance).epsilon(1e-4));
                }
            CHECK(worst < 1e-3); // pixels: single precision leaves 37 * 1e-6
        }
    }
}

TEST_CASE("stored normals lead back to view space, with z along the viewing axis") {
    const Extent2D extent{19, 3};
    for (const GBufferConventions& c : everyConvention()) {
        const glm::mat4 view = viewOf(c, someView);
        const CameraConstants camera = constantsOf(c, {view, projectionOf(c, {})}, extent);
        Picture depth(extent, 1, 2.0f), normal(extent, 3);
        std::vector<glm::vec3> expected;
        const float forward = c.handedness == Handedness::right ? -1.0f : 1.0f;
        for (int i = 0; i < extent.width * extent.height; ++i) {
            const glm::vec3 world =
                glm::normalize(glm::vec3(std::sin(float(i)), std::cos(1.7f * float(i)), 0.3f));
            const glm::vec3 stored = storedNormal(c, view, world);
            for (int k = 0; k < 3; ++k) normal.values[size_t(3 * i + k)] = stored[k];
            expected.push_back(glm::mat3(view) * world * glm::vec3(1, 1, forward));
        }
        for (cpu::Isa isa : {cpu::Isa::scalar, deviceFor(cpu::Isa::automatic).isa()}) {
            const Picture result = cameraMath(isa, cameraNormal, c, camera, depth, normal);
            for (size_t i = 0; i < expected.size(); ++i)
                for (size_t k = 0; k < 3; ++k)
                    // A few roundings of numbers of at most 2.
                    CHECK(std::abs(result.values[4 * i + k] - expected[i][int(k)]) < 2e-6f);
        }
    }
}

TEST_CASE("pixels' areas add up to a tilted plane's, perspective") {
    // The plane z = 5 + x seen through a window of half sizes w, h at distance 1: with u = x / z, z = 5 / (1
    // - u), and its area is the integral of sqrt(2) * 25 / (1 - u)^3 du dv = sqrt(2) * 25 h (1 / (1 - w)^2 -
    // 1 / (1 + w)^2).
    const Extent2D extent{1024, 16};
    Lens lens;
    lens.halfWidth = 0.5;
    lens.halfHeight = 0.3;
    lens.shiftX = lens.shiftY = 0.0;
    GBufferConventions c = planar();
    c.normalSpace = NormalSpace::view;
    const CameraConstants camera = constantsOf(c, {glm::mat4(1.0f), projectionOf(c, lens)}, extent);
    Picture depth(extent, 1), normal(extent, 3);
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            const double u = ((x + 0.5) / extent.width * 2.0 - 1.0) * lens.halfWidth;
            depth.at(x, y, 0) = float(5.0 / (1.0 - u));
            // Towards the eye, in a view space that looks down -z: the plane is -z = 5 + x.
            normal.at(x, y, 0) = float(std::sqrt(0.5));
            normal.at(x, y, 2) = float(std::sqrt(0.5));
        }
    const double exact = std::sqrt(2.0) * 25.0 * 0.3 * (1.0 / 0.25 - 1.0 / 2.25);
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Picture areas = cameraMath(isa, cameraArea, c, camera, depth, normal);
        double sum = 0.0;
        for (size_t i = 0; i < depth.values.size(); ++i) sum += areas.values[4 * i];
        // The midpoint rule's error is of order (1 / 1024)^2.
        CHECK(sum == doctest::Approx(exact).epsilon(1e-5));
    }
}

TEST_CASE("pixels' areas add up to a tilted plane's, orthographic") {
    const Extent2D extent{40, 30};
    Lens lens;
    lens.halfWidth = 3.0;
    lens.halfHeight = 2.0;
    GBufferConventions c = planar(Projection::orthographic);
    c.normalSpace = NormalSpace::view;
    const CameraConstants camera = constantsOf(c, {glm::mat4(1.0f), projectionOf(c, lens)}, extent);
    const float tilt = 1.1f; // radians; the plane's area is the window's over its cosine
    Picture depth(extent, 1, 3.0f), normal(extent, 3);
    for (int i = 0; i < extent.width * extent.height; ++i) {
        normal.values[size_t(3 * i)] = std::sin(tilt);
        normal.values[size_t(3 * i + 2)] = std::cos(tilt);
    }
    for (cpu::Isa isa : cpu::availableIsas()) {
        double sum = 0.0;
        const Picture areas = cameraMath(isa, cameraArea, c, camera, depth, normal);
        for (size_t i = 0; i < depth.values.size(); ++i) sum += areas.values[4 * i];
        CHECK(sum ==
              doctest::Approx(24.0 / std::cos(double(tilt))).epsilon(1e-5)); // single precision of each pixel
    }
}

TEST_CASE("pixels' areas add up to a sphere's cap") {
    // A sphere of radius 1 around a point 3 m ahead, within a cone around the axis.
    const Extent2D extent{600, 600};
    Lens lens;
    lens.halfWidth = lens.halfHeight = 0.36;
    lens.shiftX = lens.shiftY = 0.0;
    GBufferConventions c = planar();
    c.normalSpace = NormalSpace::view;
    const CameraConstants camera = constantsOf(c, {glm::mat4(1.0f), projectionOf(c, lens)}, extent);
    const double limit = 0.3; // tangent of the cone's half angle; the outline's is 1 / sqrt(8)
    Picture depth(extent, 1), normal(extent, 3);
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            const glm::dvec2 u = (glm::dvec2(x + 0.5, -(y + 0.5)) / 600.0 * 2.0 - glm::dvec2(1, -1)) * 0.36;
            if (glm::length(u) >= limit) continue;
            const glm::dvec3 ray(u, -1.0), center(0, 0, -3);
            const double a = glm::dot(ray, ray), b = glm::dot(ray, center);
            const double t = (b - std::sqrt(b * b - a * 8.0)) / a;
            const glm::dvec3 n = ray * t - center;
            depth.at(x, y, 0) = float(t);
            for (int k = 0; k < 3; ++k) normal.at(x, y, k) = float(n[k]);
        }
    // The cap between the axis and where the cone's ray meets the sphere: 2 pi (1 - cos).
    const double a = 1.0 + limit * limit, t = (3.0 - std::sqrt(9.0 - 8.0 * a)) / a;
    const double exact = 2.0 * pi * (1.0 - (3.0 - t));
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Picture areas = cameraMath(isa, cameraSurfaceArea, c, camera, depth, normal);
        double sum = 0.0;
        for (size_t i = 0; i < depth.values.size(); ++i) sum += areas.values[4 * i] * pi;
        // The cone's edge is 1570 pixels long; that each of them counts whole or not leaves about its root,
        // 40 pixels of 200000.
        CHECK(sum == doctest::Approx(exact).epsilon(1e-3));
    }
}

TEST_CASE("grazing pixels' areas are bounded by the smallest cosine") {
    const Extent2D extent{5, 5};
    for (Projection projection : {Projection::perspective, Projection::orthographic}) {
        GBufferConventions c = planar(projection);
        c.normalSpace = NormalSpace::view;
        Lens lens;
        lens.shiftX = lens.shiftY = 0.0;
        const CameraConstants camera = constantsOf(c, {glm::mat4(1.0f), projectionOf(c, lens)}, extent);
        Picture depth(extent, 1, 2.0f), edgeOn(extent, 3), facing(extent, 3);
        for (size_t i = 0; i < 25; ++i) edgeOn.values[3 * i] = facing.values[3 * i + 2] = 1.0f;
        for (cpu::Isa isa : cpu::availableIsas()) {
            const float front = cameraMath(isa, cameraArea, c, camera, depth, facing).at(2, 2, 0);
            const float edge = cameraMath(isa, cameraArea, c, camera, depth, edgeOn, 0.05f).at(2, 2, 0);
            CHECK(edge == doctest::Approx(front / 0.05f).epsilon(1e-5)); // two roundings more
        }
    }
}

TEST_CASE("surfaces that are none are zero, whatever depth and normal hold") {
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const Extent2D extent{17, 1};
    struct Bad {
        float depth;
        glm::vec3 normal;
    };
    const glm::vec3 good(0, 0, 1);
    const Bad bads[] = {{0.0f, good},
                        {-1.0f, good},
                        {-0.0f, good},
                        {nan, good},
                        {inf, good},
                        {-inf, good},
                        {1e30f, good},
                        {2.0f, {0, 0, 0}},
                        {2.0f, {nan, 0, 1}},
                        {2.0f, {0, inf, 1}},
                        {2.0f, {0, 0, -inf}},
                        {2.0f, {1e-20f, 0, 0}},
                        {2.0f, {1e30f, 1e30f, 0}}};
    for (Projection projection : {Projection::perspective, Projection::orthographic}) {
        GBufferConventions c = planar(projection);
        c.normalSpace = NormalSpace::view;
        const CameraConstants camera = constantsOf(c, {glm::mat4(1.0f), projectionOf(c, {})}, extent);
        for (const Bad& bad : bads) {
            Picture depth(extent, 1, 2.0f), normal(extent, 3);
            for (int x = 0; x < 17; ++x) normal.at(x, 0, 2) = 2.5f; // of any length
            depth.at(9, 0, 0) = bad.depth;
            for (int k = 0; k < 3; ++k) normal.at(9, 0, k) = bad.normal[k];
            for (cpu::Isa isa : cpu::availableIsas()) {
                const Picture surface = cameraMath(isa, cameraSurface, c, camera, depth, normal);
                const Picture area = cameraMath(isa, cameraSurfaceArea, c, camera, depth, normal);
                INFO(std::string(cpu::name(isa)), ": depth ", bad.depth, ", normal ", bad.normal.x, " ",
                     bad.normal.y, " ", bad.normal.z);
                for (int k = 0; k < 4; ++k) CHECK(surface.at(9, 0, k) == 0.0f);
                CHECK(area.at(9, 0, 0) == 0.0f);
                for (int x : {8, 10}) {
                    CHECK(surface.at(x, 0, 2) == doctest::Approx(-1.0).epsilon(1e-6));
                    CHECK(surface.at(x, 0, 3) == doctest::Approx(2.0).epsilon(1e-6)); // a reciprocal to 5e-7
                    CHECK(area.at(x, 0, 0) > 0.0f);
                }
            }
        }
    }
}

TEST_CASE("device depth of the far plane is no surface; any other is") {
    const Extent2D extent{2, 1};
    for (const GBufferConventions& c : everyConvention()) {
        if (c.depthEncoding == DepthEncoding::planar) continue;
        const CameraConstants camera =
            constantsOf(c, {viewOf(c, glm::mat4(1.0f)), projectionOf(c, {})}, extent);
        Picture depth(extent, 1), normal(extent, 3);
        depth.at(0, 0, 0) = c.depthDirection == DepthDirection::reversed ? 0.0f : 1.0f;
        depth.at(1, 0, 0) = storedDepth(c, {}, 10.0);
        for (int x = 0; x < 2; ++x) {
            const glm::vec3 n = storedNormal(c, viewOf(c, glm::mat4(1.0f)), glm::vec3(0, 0, 1));
            for (int k = 0; k < 3; ++k) normal.at(x, 0, k) = n[k];
        }
        const Picture surface = cameraMath(cpu::Isa::automatic, cameraSurface, c, camera, depth, normal);
        CHECK(surface.at(0, 0, 3) == 0.0f);
        CHECK(surface.at(1, 0, 3) == doctest::Approx(10.0).epsilon(1e-4)); // 24 bits of stored depth
        CHECK(surface.at(1, 0, 2) == doctest::Approx(-1.0).epsilon(1e-5));
    }
}

TEST_CASE("surfaces at every finite depth have finite areas") {
    const Extent2D extent{64, 3};
    GBufferConventions c = planar();
    c.normalSpace = NormalSpace::view;
    const CameraConstants camera = constantsOf(c, {glm::mat4(1.0f), projectionOf(c, {})}, extent);
    Picture depth(extent, 1), normal(extent, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 64; ++x) {
            depth.at(x, y, 0) = std::ldexp(1.0f, 4 * x - 126);
            normal.at(x, y, 2) = y == 0 ? 1.0f : 0.0f;
            normal.at(x, y, 0) = y == 1 ? 1.0f : 0.0f;
            normal.at(x, y, 1) = y == 2 ? 1.0f : 0.0f;
        }
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Picture area = cameraMath(isa, cameraSurfaceArea, c, camera, depth, normal);
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 64; ++x) {
                INFO(std::string(cpu::name(isa)));
                CAPTURE(depth.at(x, y, 0));
                CHECK(std::isfinite(area.at(x, y, 0)));
            }
    }
}

} // namespace rebound::test
