// SPDX-License-Identifier: MIT
// Cameras that contradict the conventions are refused with a sentence that says how.
#include "test_camera.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace rebound::test {
namespace {

constexpr Extent2D extent{64, 36};

GBufferConventions deviceDepth() {
    GBufferConventions c;
    c.depthEncoding = DepthEncoding::device;
    return c;
}

void checkRefused(const std::string& part, const Camera& camera, const GBufferConventions& c) {
    const auto constants = cameraConstants(camera, c, extent);
    CAPTURE(part);
    REQUIRE_FALSE(constants);
    CHECK(constants.error().code == ErrorCode::invalidArgument);
    INFO(constants.error().message);
    CHECK(constants.error().message.find(part) != std::string::npos);
}

void checkSpoilt(const std::string& part, const GBufferConventions& c,
                 const std::function<void(Camera&)>& spoil) {
    Camera camera{viewOf(c, glm::mat4(1.0f)), projectionOf(c, {})};
    REQUIRE(cameraConstants(camera, c, extent));
    spoil(camera);
    checkRefused(part, camera, c);
}

} // namespace

TEST_CASE("cameras that follow their conventions are accepted, all of them") {
    int accepted = 0;
    for (const GBufferConventions& c : everyConvention()) {
        const auto constants = cameraConstants({viewOf(c, glm::mat4(1.0f)), projectionOf(c, {})}, c, extent);
        INFO((constants ? "" : constants.error().message));
        CHECK(constants);
        ++accepted;
    }
    // Device depth: 128 of perspective, 64 of orthographic; planar depth: 32.
    CHECK(accepted == 224);
}

TEST_CASE("GLM's projections are read as the conventions that GLM's names say") {
    struct Named {
        Handedness hand;
        DepthRange range;
        glm::mat4 perspective, orthographic;
    };
    const float a = 1.1f, w = 1.6f, n = 0.1f, f = 50.0f;
    const Named named[] = {
        {Handedness::right, DepthRange::zeroToOne, glm::perspectiveRH_ZO(a, w, n, f),
         glm::orthoRH_ZO(-2.f, 2.f, -1.f, 1.f, n, f)},
        {Handedness::right, DepthRange::minusOneToOne, glm::perspectiveRH_NO(a, w, n, f),
         glm::orthoRH_NO(-2.f, 2.f, -1.f, 1.f, n, f)},
        {Handedness::left, DepthRange::zeroToOne, glm::perspectiveLH_ZO(a, w, n, f),
         glm::orthoLH_ZO(-2.f, 2.f, -1.f, 1.f, n, f)},
        {Handedness::left, DepthRange::minusOneToOne, glm::perspectiveLH_NO(a, w, n, f),
         glm::orthoLH_NO(-2.f, 2.f, -1.f, 1.f, n, f)},
    };
    for (const Named& m : named) {
        GBufferConventions c = deviceDepth();
        c.handedness = m.hand;
        c.depthRange = m.range;
        CHECK(cameraConstants({glm::mat4(1.0f), m.perspective}, c, extent));
        c.projection = Projection::orthographic;
        CHECK(cameraConstants({glm::mat4(1.0f), m.orthographic}, c, extent));
        c.projection = Projection::perspective;
        c.depthDirection = DepthDirection::reversed;
        CHECK_FALSE(cameraConstants({glm::mat4(1.0f), m.perspective}, c, extent));
        // Near and far exchanged: GLM's way to a reversed depth.
        if (m.range == DepthRange::zeroToOne) {
            const bool right = m.hand == Handedness::right;
            CHECK(cameraConstants({glm::mat4(1.0f), right ? glm::perspectiveRH_ZO(a, w, f, n)
                                                          : glm::perspectiveLH_ZO(a, w, f, n)},
                                  c, extent));
        }
    }
    GBufferConventions infinite = deviceDepth();
    infinite.depthRange = DepthRange::minusOneToOne;
    infinite.farPlane = FarPlane::infinite;
    CHECK(cameraConstants({glm::mat4(1.0f), glm::infinitePerspectiveRH(a, w, n)}, infinite, extent));
}

TEST_CASE("projections that do not fit the conventions") {
    for (const GBufferConventions& c : everyConvention()) {
        if (c.depthEncoding == DepthEncoding::planar) continue;
        const Camera camera{viewOf(c, glm::mat4(1.0f)), projectionOf(c, {})};
        const bool perspective = c.projection == Projection::perspective;
        GBufferConventions other = c;
        other.projection = perspective ? Projection::orthographic : Projection::perspective;
        checkRefused(perspective ? "is perspective, but conventions.projection says orthographic"
                                 : "is orthographic, but conventions.projection says perspective",
                     camera, other);
        other = c;
        other.handedness = c.handedness == Handedness::right ? Handedness::left : Handedness::right;
        if (perspective)
            checkRefused(c.handedness == Handedness::right
                             ? "looks down -z, but conventions.handedness says left (+z)"
                             : "looks down +z, but conventions.handedness says right (-z)",
                         camera, other);
        else checkRefused("handedness", camera, other);
        other = c;
        other.depthDirection =
            c.depthDirection == DepthDirection::forward ? DepthDirection::reversed : DepthDirection::forward;
        checkRefused("depthDirection", camera, other);
        if (perspective) {
            other = c;
            other.farPlane = c.farPlane == FarPlane::finite ? FarPlane::infinite : FarPlane::finite;
            checkRefused(c.farPlane == FarPlane::finite
                             ? "has a finite far plane, but conventions.farPlane says infinite"
                             : "has an infinite far plane, but conventions.farPlane says finite",
                         camera, other);
        }
    }
}

TEST_CASE("projections of no use to any convention") {
    for (const GBufferConventions& c : everyConvention()) {
        const bool perspective = c.projection == Projection::perspective;
        for (int column = 0; column < 4; ++column)
            for (float value :
                 {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
                checkSpoilt("not finite", c,
                            [&](Camera& k) { k.projection[column][(column + 1) % 4] = value; });
        checkSpoilt("no width or no height", c, [](Camera& k) { k.projection[0][0] = 0.0f; });
        checkSpoilt("no width or no height", c, [](Camera& k) { k.projection[1][1] = 0.0f; });
        for (auto [column, row] : {std::pair{0, 1}, {1, 0}, {0, 2}, {1, 2}, {0, 3}, {1, 3}})
            checkSpoilt("sheared or rotated", c,
                        [&, col = column, r = row](Camera& k) { k.projection[col][r] = 0.01f; });
        if (perspective) {
            checkSpoilt("must give w = z or w = -z", c, [](Camera& k) { k.projection[2][3] *= 0.5f; });
            checkSpoilt("must give w = z or w = -z", c, [](Camera& k) { k.projection[3][3] = 0.1f; });
            checkSpoilt("must give w = z or w = -z", c, [](Camera& k) { k.projection[3][0] = 0.1f; });
        } else {
            checkSpoilt("must give w = 1", c, [](Camera& k) { k.projection[3][3] = 2.0f; });
            checkSpoilt("must give w = 1", c, [](Camera& k) { k.projection[2][1] = 0.1f; });
        }
    }
}

TEST_CASE("a depth range that does not fit: the far plane would lie behind the eye") {
    GBufferConventions c = deviceDepth();
    c.depthRange = DepthRange::minusOneToOne;
    // A forward matrix cannot be told so: read as [-1, 1], its near plane is at half the distance.
    const Camera reversed{glm::mat4(1.0f), glm::perspectiveRH_ZO(1.0f, 1.0f, 50.0f, 0.1f)};
    c.depthDirection = DepthDirection::reversed;
    checkRefused("depthRange", reversed, c);
}

TEST_CASE("views that are no rotation") {
    const GBufferConventions c;
    checkSpoilt("camera.view is not a rotation", c,
                [](Camera& k) { k.view = glm::scale(k.view, glm::vec3(1.01f)); });
    checkSpoilt("camera.view is not a rotation", c, [](Camera& k) { k.view[0][1] = 0.01f; });
    checkSpoilt("camera.view is not a rotation", c, [](Camera& k) { k.view[1][1] = NAN; });
    checkSpoilt("camera.view is not a rotation", c, [](Camera& k) { k.view = glm::mat4(0.0f); });
    Camera turned{glm::lookAt(glm::vec3(1e5f, -3, 2), glm::vec3(4, 5, 6), glm::vec3(0.1f, 1, 0)),
                  projectionOf(c, {})};
    CHECK(cameraConstants(turned, c, extent));
}

TEST_CASE("planar depth does not ask for a depth range, a direction or a far plane") {
    GBufferConventions c;
    const Camera camera{glm::mat4(1.0f), glm::perspectiveRH_NO(1.0f, 1.0f, 0.1f, 50.0f)};
    for (int bits = 0; bits < 8; ++bits) {
        c.depthRange = DepthRange(bits & 1);
        c.depthDirection = DepthDirection(bits >> 1 & 1);
        c.farPlane = FarPlane(bits >> 2);
        CHECK(cameraConstants(camera, c, extent));
    }
}

TEST_CASE("reprojection: where another camera's matrices put a point, pixel by pixel") {
    const glm::mat4 turn = glm::rotate(glm::mat4(1.0f), 0.3f, glm::vec3(0.2f, 1.0f, 0.1f));
    const Camera from{glm::translate(turn, glm::vec3(1.0f, -0.5f, -2.0f)),
                      glm::perspectiveRH_ZO(1.0f, 1.5f, 0.1f, 100.0f)},
        to{glm::translate(glm::mat4(1.0f), glm::vec3(0.8f, -0.4f, -2.2f)), from.projection};
    const Extent2D pictureSize{300, 200};
    for (FirstRow firstRow : {FirstRow::top, FirstRow::bottom})
        for (const glm::vec3 point : {glm::vec3(0, 0, -3), glm::vec3(1, 0.5f, -6), glm::vec3(-2, 1, -9)}) {
            GBufferConventions conventions;
            conventions.firstRow = firstRow;
            const ReprojectionConstants k = reprojection(from, to, conventions, pictureSize);
            glm::vec4 view = from.view * glm::vec4(point, 1.0f);
            view.z = -view.z; // a distance along the axis
            const float w = glm::dot(k.w, view);
            const glm::vec4 clip = to.projection * to.view * glm::vec4(point, 1.0f);
            const float x = (clip.x / clip.w * 0.5f + 0.5f) * 300.0f,
                        up = (clip.y / clip.w * 0.5f + 0.5f) * 200.0f;
            CHECK(w == doctest::Approx(clip.w));
            CHECK(glm::dot(k.x, view) / w == doctest::Approx(x));
            CHECK(glm::dot(k.y, view) / w == doctest::Approx(firstRow == FirstRow::top ? 200.0f - up : up));
        }
}

TEST_CASE("motion vectors of every convention become the same way in pixels") {
    const Extent2D pictureSize{300, 200};
    GBufferConventions top, bottom;
    bottom.firstRow = FirstRow::bottom;
    // To where the surface was: 30 columns right, 20 rows on.
    const glm::vec2 expected(30.0f, 20.0f);
    const auto check = [&](MotionUnit unit, glm::vec2 stored, const GBufferConventions& c) {
        for (auto [direction, sign] :
             {std::pair{MotionDirection::toPrevious, 1.0f}, {MotionDirection::fromPrevious, -1.0f}}) {
            const glm::vec2 way = stored * sign * motionToPixels({unit, direction}, c, pictureSize);
            CHECK(way.x == doctest::Approx(expected.x));
            CHECK(way.y == doctest::Approx(expected.y));
        }
    };
    check(MotionUnit::pixels, {30.0f, 20.0f}, top);
    check(MotionUnit::textureCoordinates, {0.1f, 0.1f}, top);
    check(MotionUnit::normalizedDevice, {0.2f, -0.2f}, top);
    check(MotionUnit::normalizedDevice, {0.2f, 0.2f}, bottom);
}

} // namespace rebound::test
