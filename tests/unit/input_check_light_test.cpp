// SPDX-License-Identifier: MIT
// Wrong albedo, light and motion, each provoked: the input check names them, and nothing else.
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

void scale(Picture& p, float factor) {
    for (float& v : p.values) v *= factor;
}

constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();

} // namespace

TEST_CASE("values that are none") {
    for (float bad : {nan, infinity, -infinity}) {
        CheckFrame albedo = correctFrame({}, extent), radiance = albedo, lit = albedo, motion = albedo;
        albedo.albedo.at(7, 5, 0) = bad;
        radiance.radiance.at(7, 5, 1) = bad;
        lit.lit.at(7, 5, 2) = bad;
        motion.motion.at(7, 5, 1) = bad;
        checkFound(albedo, {"albedoNotFinite"});
        checkFound(radiance, {"radianceNotFinite"});
        checkFound(lit, {"litNotFinite"});
        checkFound(motion, {"motionNotFinite"});
    }
}

TEST_CASE("albedo out of range, and albedo that was never written") {
    CheckFrame f = correctFrame({}, extent);
    scale(f.albedo, 255.0f);
    checkFound(f, {"albedoOutOfRange"}, "probably it is in 0 to 255");
    for (float value : {0.0f, 1.0f}) {
        f.albedo = Picture(extent, 3, value);
        checkFound(f, {"albedoUniform"}, "at 100 %");
    }
}

TEST_CASE("light that is negative, clipped, missing, or of another order of magnitude") {
    const CheckFrame right = correctFrame({}, extent);
    CheckFrame f = right;
    scale(f.radiance, -1.0f);
    scale(f.lit, -1.0f);
    checkFound(f, {"radianceNegative", "radianceBlack", "litNegative", "litBlack"},
               "radiance is negative at 100 %");
    f = right;
    scale(f.radiance, 0.0f);
    scale(f.lit, 0.0f);
    checkFound(f, {"radianceBlack", "litBlack"});
    f = right;
    for (float& v : f.radiance.values) v = std::min(v * 1e5f, 65504.0f);
    const Names clipped = problems(findingsOf(f, deviceFor(cpu::Isa::automatic)));
    CHECK(clipped.contains("radianceClipped"));
    CHECK(clipped.contains("radianceUnits"));
    f = right;
    scale(f.radiance, 1e-6f);
    checkFound(f, {"radianceUnits"});
    f = right;
    scale(f.radiance, 1e-2f);
    scale(f.lit, 300.0f);
    checkFound(f, {});
}

TEST_CASE("radiance without albedo, or with too much of it") {
    const CheckFrame right = correctFrame({}, extent);
    const auto changeRadiance = [&](const std::function<float(float, float)>& change) {
        CheckFrame f = right;
        for (size_t i = 0; i < f.radiance.values.size(); ++i)
            f.radiance.values[i] = change(f.radiance.values[i], f.albedo.values[i]);
        return f;
    };
    CheckFrame irradiance = changeRadiance([](float l, float a) { return l / a; });
    checkFound(irradiance, {"radianceWithoutAlbedo"}, "while lit does");
    irradiance.settings.lit = false;
    checkFound(irradiance, {"radianceWithoutAlbedo"});
    CheckFrame twice = changeRadiance([](float l, float a) { return l * a; });
    checkFound(twice, {"radianceAlbedoTwice"});
    CheckFrame encoded = right;
    for (float& a : encoded.albedo.values) a = std::pow(a, 1.0f / 2.2f);
    checkFound(encoded, {"radianceAlbedoTwice"}, "sRGB");
    // A mirror's reflection on everything: where albedo is nearly 0, there is little else.
    CheckFrame specular = changeRadiance([](float l, float a) { return l + 0.5f * l / a; });
    const Names names = problems(findingsOf(specular, deviceFor(cpu::Isa::automatic)));
    CHECK((names.contains("radianceSpecular") || names.contains("radianceWithoutAlbedo")));
    CheckFrame metal = changeRadiance([](float l, float a) { return a < 0.01f ? l / a : l; });
    checkFound(metal, {"radianceSpecular"}, "unless these surfaces emit light");
    // The same, where the frame says that it is emission; and where it says that nothing emits.
    metal.settings.emission = true;
    metal.emission = metal.radiance;
    for (size_t i = 0; i < metal.emission.values.size(); ++i)
        metal.emission.values[i] = metal.radiance.values[i] - right.radiance.values[i];
    checkFound(metal, {});
    metal.emission = Picture(extent, 3);
    checkFound(metal, {"radianceSpecular"}, "probably specular light is in it");
}

TEST_CASE("motion of another sign, axis or unit") {
    for (const GBufferConventions& c : everyConvention()) {
        if (c.depthEncoding == DepthEncoding::device || c.normalEncoding == NormalEncoding::unsignedUnit)
            continue;
        const CheckFrame right = correctFrame(c, extent);
        const glm::vec2 size(extent.width, extent.height);
        const float rows = c.firstRow == FirstRow::top ? -1.0f : 1.0f;
        const auto times = [&](glm::vec2 factor) {
            CheckFrame f = right;
            for (size_t i = 0; i < f.motion.values.size(); ++i) f.motion.values[i] *= factor[int(i % 2)];
            return f;
        };
        CheckFrame negated = times({-1, -1}), mirrored = times({1, -1}), coordinates = times(1.0f / size),
                   normalized = times(2.0f / size * glm::vec2(1, rows)), both = times(-1.0f / size);
        checkFound(negated, {"motionDirection"}, "motionConventions.direction is the other one");
        checkFound(mirrored, {"motionDirection"}, "with y's sign changed");
        checkFound(coordinates, {"motionUnit"}, "read as textureCoordinates");
        checkFound(normalized, {"motionUnit"}, "read as normalizedDevice");
        checkFound(both, {"motionUnit", "motionDirection"});
        // Each is right where that is what the conventions say.
        negated.settings.motionConventions.direction = MotionDirection::fromPrevious;
        checkFound(negated, {});
        coordinates.settings.motionConventions.unit = MotionUnit::textureCoordinates;
        checkFound(coordinates, {});
        normalized.settings.motionConventions.unit = MotionUnit::normalizedDevice;
        checkFound(normalized, {});
        both.settings.motionConventions = {MotionUnit::textureCoordinates, MotionDirection::fromPrevious};
        checkFound(both, {});
    }
}

TEST_CASE("motion that contradicts a scene that stands still") {
    const CheckFrame right = correctFrame({}, extent);
    CheckFrame f = right;
    scale(f.motion, 0.0f);
    checkFound(f, {"motionContradictsScene"}, "leaves out the camera");
    f = right;
    f.previousCamera = f.camera;
    checkFound(f, {"motionContradictsScene"}, "both cameras see at the same place");
    scale(f.motion, 0.0f);
    checkFound(f, {});
    // A tenth of the picture moves by itself: nothing to say.
    f = right;
    for (int y = 0; y < extent.height; ++y)
        for (int x = 20; x < 26; ++x) f.motion.at(x, y, 0) += 9.0f;
    checkFound(f, {});
    // Depth in another unit than the camera's translation.
    f = right;
    for (float& d : f.depth.values) d *= 5.0f;
    CHECK(problems(findingsOf(f, deviceFor(cpu::Isa::automatic))).contains("motionContradictsScene"));
}

} // namespace rebound::test
