// SPDX-License-Identifier: MIT
// Wrong depth, normals and cameras, each provoked: the input check names them, and nothing else.
#include "input_check_frame.hpp"

#include <functional>

namespace rebound::test {
namespace {

constexpr Extent2D extent{61, 37};
using Names = std::set<std::string>;

void checkFound(CheckFrame& f, const Names& expected, const std::string& part = {}) {
    const auto findings = findingsOf(f, deviceFor(cpu::Isa::automatic));
    INFO(sentences(findings));
    CHECK(problems(findings) == expected);
    CHECK(sentences(findings).find(part) != std::string::npos);
}

// The provoked mistakes do not depend on the rest of the conventions.
std::vector<GBufferConventions> someConventions(DepthEncoding encoding) {
    std::vector<GBufferConventions> some;
    for (const GBufferConventions& c : everyConvention())
        if (c.depthEncoding == encoding && c.normalEncoding == NormalEncoding::signedUnit &&
            c.normalSpace == NormalSpace::world)
            some.push_back(c);
    return some;
}

// Without motion, which a wrong depth contradicts as well.
CheckFrame frameWithoutMotion(const GBufferConventions& c) {
    CheckFrame f = correctFrame(c, extent);
    f.settings.motion = false;
    return f;
}

void changeNormals(CheckFrame& f, const std::function<glm::vec3(glm::vec3)>& change) {
    for (size_t i = 0; i < f.normal.values.size(); i += 3) {
        float* n = &f.normal.values[i];
        const glm::vec3 changed = change({n[0], n[1], n[2]});
        for (int k = 0; k < 3; ++k) n[k] = changed[k];
    }
}

// Depth as another convention stores it.
void storeDepthAs(CheckFrame& f, GBufferConventions c) {
    c.projection = f.settings.conventions.projection;
    c.handedness = f.settings.conventions.handedness;
    c.firstRow = f.settings.conventions.firstRow;
    f.depth = sceneFrame(c, extent, tiltedWorld).depth;
}

// The length of a pixel's ray for each metre along the axis.
float rayLength(const CheckFrame& f, int x, int y) {
    const auto k = cameraConstants(f.camera, f.settings.conventions, extent);
    REQUIRE(k);
    const glm::vec2 ray((float(x) + 0.5f) * k->ray.x + k->ray.z, (float(y) + 0.5f) * k->ray.y + k->ray.w);
    return std::sqrt(1.0f + glm::dot(ray, ray));
}

} // namespace

TEST_CASE("normals that are not unit") {
    for (float factor : {0.5f, 3.0f, 0.0f}) {
        CheckFrame f = correctFrame({}, extent);
        changeNormals(f, [factor](glm::vec3 n) { return factor * n; });
        checkFound(f, {"normalsNotUnit"}, "length other than 1 at 100 %");
    }
    // A few, as after filtering, are nobody's concern.
    CheckFrame f = correctFrame({}, extent);
    for (int x = 0; x < extent.width; ++x) f.normal.at(x, 20, 0) *= 1.5f;
    checkFound(f, {});
}

TEST_CASE("normals of the other encoding") {
    for (NormalSpace space : {NormalSpace::view, NormalSpace::world})
        for (bool isSigned : {false, true}) {
            GBufferConventions c;
            c.normalSpace = space;
            c.normalEncoding = isSigned ? NormalEncoding::signedUnit : NormalEncoding::unsignedUnit;
            CheckFrame f = correctFrame(c, extent);
            f.settings.conventions.normalEncoding =
                isSigned ? NormalEncoding::unsignedUnit : NormalEncoding::signedUnit;
            checkFound(f, {"normalsEncoding"}, "probably conventions.normalEncoding should be that");
        }
}

TEST_CASE("normals of the other space") {
    for (const GBufferConventions& convention : someConventions(DepthEncoding::planar))
        for (bool isWorld : {false, true}) {
            GBufferConventions c = convention;
            c.normalSpace = isWorld ? NormalSpace::world : NormalSpace::view;
            CheckFrame f = correctFrame(c, extent);
            f.settings.conventions.normalSpace = isWorld ? NormalSpace::view : NormalSpace::world;
            checkFound(f, {"normalsSpace"},
                       isWorld ? "read as one of world space" : "read as one of view space");
        }
}

TEST_CASE("normals with a wrong sign, and worlds of other axes") {
    for (const GBufferConventions& c : someConventions(DepthEncoding::planar)) {
        const auto provoke = [&](const char* problem, const char* part, NormalSpace space, glm::mat3 change) {
            GBufferConventions own = c;
            own.normalSpace = space;
            CheckFrame f = correctFrame(own, extent);
            changeNormals(f, [&](glm::vec3 n) { return change * n; });
            checkFound(f, {problem}, part);
        };
        const auto mirror = [](int axis) {
            glm::mat3 m(1.0f);
            m[axis][axis] = -1.0f;
            return m;
        };
        const auto world = NormalSpace::world, view = NormalSpace::view;
        provoke("normalsFlipped", "point into the surfaces", world, glm::mat3(-1.0f));
        provoke("normalsFlipped", "point into the surfaces", view, glm::mat3(-1.0f));
        provoke("normalsFlipped", "view-space x mirrored", view, mirror(0));
        provoke("normalsFlipped", "view-space y mirrored", view, mirror(1));
        provoke("normalsFlipped", "view-space z mirrored", view, mirror(2));
        provoke("normalsFlipped", "world-space x mirrored", world, mirror(0));
        provoke("normalsFlipped", "world-space y mirrored", world, mirror(1));
        provoke("normalsFlipped", "world-space z mirrored", world, mirror(2));
        // A world with z up, x to the right and y to the front: y up is its z.
        provoke("normalsSpace", "of a world with z up", world, glm::mat3({1, 0, 0}, {0, 0, 1}, {0, -1, 0}));
        provoke("normalsSpace", "of a world with y up", world, glm::mat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0}));
    }
}

TEST_CASE("normals that point into surfaces, of a picture that has no inside") {
    for (const GBufferConventions& c : someConventions(DepthEncoding::planar)) {
        CheckFrame f = correctFrame(c, {61, 2});
        changeNormals(f, [](glm::vec3 n) { return -n; });
        checkFound(f, {"normalsFlipped"}, "points away from the eye");
    }
}

TEST_CASE("rows that run the other way, and a camera that is turned round") {
    for (const GBufferConventions& c : someConventions(DepthEncoding::planar)) {
        CheckFrame f = frameWithoutMotion(c);
        f.settings.conventions.firstRow = c.firstRow == FirstRow::top ? FirstRow::bottom : FirstRow::top;
        checkFound(f, {"normalsFlipped"}, "conventions.firstRow");
        CheckFrame g = frameWithoutMotion(c);
        const glm::mat3 inverse = glm::transpose(glm::mat3(g.camera.view));
        for (int i = 0; i < 3; ++i) g.camera.view[i] = glm::vec4(inverse[i], 0.0f);
        // In left-handed view space the mirror is part of the matrix, and comes to lie on the wrong side.
        checkFound(g, {"normalsSpace"}, "the inverse of camera.view");
    }
}

TEST_CASE("normals of another picture") {
    CheckFrame f = correctFrame({}, extent);
    uint32_t state = 1;
    changeNormals(f, [&state](glm::vec3) {
        glm::vec3 n;
        for (int k = 0; k < 3; ++k) {
            state = state * 1664525u + 1013904223u;
            n[k] = float(state >> 8) / float(1 << 23) - 1.0f;
        }
        return glm::normalize(n + glm::vec3(1e-3f));
    });
    checkFound(f, {"normalsContradictDepth"}, "no other reading");
}

TEST_CASE("a camera that contradicts the conventions is a finding in its own words") {
    CheckFrame f = correctFrame({}, extent);
    const InputStatistics s = measure(f, deviceFor(cpu::Isa::automatic));
    f.settings.conventions.handedness = Handedness::left;
    const auto findings = examineInputs(f.settings, f.camera, s);
    CHECK(problems(findings) == Names{"camera"});
    CHECK(sentences(findings).find("conventions.handedness says left") != std::string::npos);
    const auto inputs = inputCheckInputs(f.settings, InputCheckFrame<cpu::Image>{f.camera, f.camera});
    REQUIRE_FALSE(inputs);
    CHECK(findings[0].sentence == inputs.error().message);
}

TEST_CASE("device depth that runs the other way") {
    for (const GBufferConventions& c : someConventions(DepthEncoding::device)) {
        CheckFrame f = frameWithoutMotion(c);
        for (float& d : f.depth.values) d = 1.0f - d;
        checkFound(f, {"depthDirection"});
        // Normals that say nothing: the sky alone gives it away.
        const float cleared = c.depthDirection == DepthDirection::forward ? 0.0f : 1.0f;
        CheckFrame g = frameWithoutMotion(c);
        for (int i = 0; i < 100; ++i) g.depth.values[size_t(i)] = cleared;
        checkFound(g, {"depthDirection"}, "that is the sky");
    }
}

TEST_CASE("distances in place of device depth") {
    for (const GBufferConventions& c : someConventions(DepthEncoding::device)) {
        CheckFrame f = frameWithoutMotion(c);
        storeDepthAs(f, {});
        checkFound(f, {"depthOutOfRange", "depthEncoding"}, "DepthEncoding::planar");
        if (c.projection == Projection::orthographic)
            continue; // there, distances over the far plane's are device depth but for an offset
        for (float& d : f.depth.values) d /= 40.0f;
        checkFound(f, {"depthEncoding"}, "divided by the far plane's");
    }
}

TEST_CASE("device depth of the other range, where the projection is orthographic") {
    for (const GBufferConventions& c : someConventions(DepthEncoding::device)) {
        if (c.projection != Projection::orthographic) continue;
        CheckFrame f = frameWithoutMotion(c);
        f.settings.conventions.depthRange =
            c.depthRange == DepthRange::zeroToOne ? DepthRange::minusOneToOne : DepthRange::zeroToOne;
        checkFound(f, {"depthEncoding"}, "the other depthRange");
    }
}

TEST_CASE("device depth in place of distances") {
    for (const GBufferConventions& c : someConventions(DepthEncoding::planar)) {
        CheckFrame f = frameWithoutMotion(c);
        GBufferConventions stored;
        stored.depthEncoding = DepthEncoding::device;
        storeDepthAs(f, stored);
        const auto findings = findingsOf(f, deviceFor(cpu::Isa::automatic));
        INFO(sentences(findings));
        CHECK(problems(findings).contains("depthEncoding"));
        CHECK(sentences(findings).find("DepthEncoding::device") != std::string::npos);
        for (float& d : f.depth.values) d = 1.0f - d;
        CHECK(problems(findingsOf(f, deviceFor(cpu::Isa::automatic))).contains("depthEncoding"));
    }
}

TEST_CASE("distances along rays in place of distances along the axis") {
    for (Projection projection : {Projection::perspective, Projection::orthographic}) {
        GBufferConventions c;
        c.projection = projection;
        CheckFrame f = frameWithoutMotion(c);
        if (projection == Projection::orthographic) continue; // all rays are parallel: both are one
        for (int y = 0; y < extent.height; ++y)
            for (int x = 0; x < extent.width; ++x) f.depth.at(x, y, 0) *= rayLength(f, x, y);
        checkFound(f, {"depthEncoding"}, "along each pixel's ray");
    }
}

TEST_CASE("distances with a minus sign, or in another unit") {
    for (Projection projection : {Projection::perspective, Projection::orthographic}) {
        GBufferConventions c;
        c.projection = projection;
        const auto scaled = [&](float factor) {
            CheckFrame f = frameWithoutMotion(c);
            for (float& d : f.depth.values) d *= factor;
            return f;
        };
        CheckFrame negative = scaled(-1.0f), millimetres = scaled(1000.0f), kilometres = scaled(1e-3f),
                   farOff = scaled(1e-5f);
        checkFound(negative, {"depthNegative"}, "at 100 %");
        CHECK(problems(findingsOf(millimetres, deviceFor(cpu::Isa::automatic))).contains("depthUnits"));
        CHECK(problems(findingsOf(farOff, deviceFor(cpu::Isa::automatic))).contains("depthUnits"));
        // An orthographic camera may well begin behind the eye, so that short distances lie within its
        // planes.
        if (projection == Projection::perspective)
            CHECK(problems(findingsOf(kilometres, deviceFor(cpu::Isa::automatic))).contains("depthUnits"));
    }
    // With a projection that says nothing of planes in front of the scene, the near plane is the measure.
    CheckFrame f = frameWithoutMotion({});
    f.camera.projection[2][2] = -1.0f;
    f.camera.projection[3][2] = -0.02f; // near plane at 1 cm, none afar
    checkFound(f, {});
    for (float& d : f.depth.values) d *= 1000.0f;
    checkFound(f, {"depthUnits"}, "times the near plane's distance");
}

TEST_CASE("skies, and depth that is not a number") {
    for (DepthEncoding encoding : {DepthEncoding::planar, DepthEncoding::device})
        for (const GBufferConventions& c : someConventions(encoding)) {
            CheckFrame f = correctFrame(c, extent);
            const bool one = encoding == DepthEncoding::device && c.depthDirection == DepthDirection::forward;
            f.depth = Picture(extent, 1, one ? 1.0f : 0.0f);
            checkFound(f, {"noSurfaces"}, "100 %");
        }
    for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        CheckFrame f = correctFrame({}, extent);
        f.depth.at(30, 20, 0) = bad;
        checkFound(f, {"depthNotFinite"});
        CheckFrame g = correctFrame({}, extent);
        g.normal.at(30, 20, 1) = bad;
        checkFound(g, {"normalsNotFinite"});
    }
}

} // namespace rebound::test
