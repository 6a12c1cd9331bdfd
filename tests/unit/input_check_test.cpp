// SPDX-License-Identifier: MIT
// The input check says nothing of right frames.
#include "input_check_frame.hpp"

#include <glm/gtc/packing.hpp>

#include <cstring>

namespace rebound::test {
namespace {

constexpr Extent2D extent{61, 37};

} // namespace

TEST_CASE("right frames of every convention leave nothing to say") {
    const cpu::Device device = deviceFor(cpu::Isa::automatic);
    for (const GBufferConventions& c : everyConvention()) {
        CheckFrame f = correctFrame(c, extent);
        const auto findings = findingsOf(f, device);
        CHECK_MESSAGE(findings.empty(), sentences(findings));
    }
}

TEST_CASE("pixels are counted once each, in pictures of every shape") {
    const cpu::Device device = deviceFor(cpu::Isa::automatic);
    for (Extent2D e : {Extent2D{1, 1}, Extent2D{1, 9}, Extent2D{13, 1}, Extent2D{256, 64}, Extent2D{257, 65},
                       Extent2D{517, 131}, Extent2D{7, 4096}}) {
        CheckFrame f = correctFrame({}, e);
        int surfaces = 0;
        for (float d : f.depth.values) surfaces += d > 0.0f ? 1 : 0;
        const InputStatistics s = measure(f, device);
        CHECK(s[detail::ValueStatistic::pixels] == float(e.width * e.height));
        CHECK(s[detail::ValueStatistic::surfaces] == float(surfaces));
        CHECK(s[detail::ValueStatistic::depthEmpty] == float(e.width * e.height - surfaces));
    }
}

TEST_CASE("bumps in normals, and depth in half floats, are no mistakes") {
    const cpu::Device device = deviceFor(cpu::Isa::automatic);
    uint32_t state = 7;
    for (const GBufferConventions& c : everyConvention()) {
        if (c.normalEncoding == NormalEncoding::unsignedUnit) continue;
        CheckFrame f = correctFrame(c, {97, 61});
        for (size_t i = 0; i < f.normal.values.size(); i += 3) {
            glm::vec3 n(f.normal.values[i], f.normal.values[i + 1], f.normal.values[i + 2]);
            for (int k = 0; k < 3; ++k) {
                state = state * 1664525u + 1013904223u;
                n[k] += 1.2f * (float(state >> 8) / float(1 << 24) - 0.5f); // tilts of up to 40 degrees
            }
            n = glm::normalize(n);
            for (int k = 0; k < 3; ++k) f.normal.values[i + size_t(k)] = n[k];
        }
        if (c.depthEncoding == DepthEncoding::planar)
            for (float& d : f.depth.values) d = glm::unpackHalf1x16(glm::packHalf1x16(d));
        const auto findings = findingsOf(f, device);
        CHECK_MESSAGE(findings.empty(), sentences(findings));
    }
}

TEST_CASE("every instruction set measures what the scalar one does") {
    for (Projection projection : {Projection::perspective, Projection::orthographic})
        for (Extent2D e : {extent, Extent2D{301, 133}}) {
            GBufferConventions c;
            c.projection = projection;
            c.depthEncoding = DepthEncoding::device;
            CheckFrame f = correctFrame(c, e);
            const InputStatistics scalar = measure(f, deviceFor(cpu::Isa::scalar));
            for (cpu::Isa isa : cpu::availableIsas()) {
                INFO(std::string(cpu::name(isa)));
                const InputStatistics other = measure(f, deviceFor(isa));
                // Reciprocals to 5e-7 tip a pixel in a few hundred over a threshold.
                for (size_t i = 0; i < other.size(); ++i)
                    CHECK(std::abs(other[i] - scalar[i]) <= 3e-3f * float(e.width * e.height));
            }
        }
}

TEST_CASE("the same bits for any number of threads") {
    CheckFrame f = correctFrame({}, {301, 133});
    const InputStatistics one = measure(f, deviceFor(cpu::Isa::automatic, 1));
    for (int threads : {2, 3, 7}) CHECK(measure(f, deviceFor(cpu::Isa::automatic, threads)) == one);
}

TEST_CASE("images that are not handed in are not asked for") {
    const cpu::Device device = deviceFor(cpu::Isa::automatic);
    for (int bits = 0; bits < 16; ++bits) {
        CheckFrame f = correctFrame({}, extent);
        f.settings.albedo = (bits & 1) != 0;
        f.settings.radiance = (bits & 2) != 0;
        f.settings.lit = (bits & 4) != 0;
        f.settings.motion = (bits & 8) != 0;
        for (Picture* absent : {&f.albedo, &f.radiance, &f.lit, &f.motion})
            if ((bits >> (absent == &f.albedo     ? 0
                          : absent == &f.radiance ? 1
                          : absent == &f.lit      ? 2
                                                  : 3) &
                 1) == 0)
                *absent = Picture({1, 1}, 3, std::numeric_limits<float>::quiet_NaN());
        const auto plan = planInputCheck(f.settings);
        REQUIRE(plan);
        CHECK((plan->find("albedo") >= 0) == f.settings.albedo);
        CHECK((plan->find("radiance") >= 0) == f.settings.radiance);
        CHECK((plan->find("lit") >= 0) == f.settings.lit);
        CHECK((plan->find("motion") >= 0) == f.settings.motion);
        const auto findings = findingsOf(f, device);
        CHECK_MESSAGE(findings.empty(), sentences(findings));
    }
}

TEST_CASE("half floats, as GPUs store them, are right too") {
    const cpu::Device device = deviceFor(cpu::Isa::automatic);
    for (int variant = 0; variant < 4; ++variant) {
        GBufferConventions c;
        c.projection = variant & 1 ? Projection::orthographic : Projection::perspective;
        c.normalEncoding = variant & 2 ? NormalEncoding::unsignedUnit : NormalEncoding::signedUnit;
        CheckFrame f = correctFrame(c, {193, 109});
        for (Picture* p : {&f.normal, &f.albedo, &f.radiance, &f.lit, &f.motion})
            for (float& v : p->values) v = glm::unpackHalf1x16(glm::packHalf1x16(v));
        // 8 bits, as many G-buffers have.
        for (float& v : f.albedo.values) v = std::round(v * 255.0f) / 255.0f;
        if (c.normalEncoding == NormalEncoding::unsignedUnit)
            for (float& v : f.normal.values) v = std::round(v * 255.0f) / 255.0f;
        const auto findings = findingsOf(f, device);
        CHECK_MESSAGE(findings.empty(), sentences(findings));
    }
}

TEST_CASE("G-buffers of random bits leave statistics that are numbers, and sentences") {
    uint32_t state = 99;
    CheckFrame f = correctFrame({}, extent);
    for (Picture* p : {&f.depth, &f.normal, &f.albedo, &f.radiance, &f.lit, &f.motion})
        for (float& v : p->values) {
            state = state * 1664525u + 1013904223u;
            const uint32_t bits = state ^ state >> 15;
            std::memcpy(&v, &bits, 4);
        }
    for (cpu::Isa isa : cpu::availableIsas()) {
        const InputStatistics s = measure(f, deviceFor(isa));
        for (float v : s) CHECK(std::isfinite(v));
        CHECK_FALSE(examineInputs(f.settings, f.camera, s).empty());
    }
}

TEST_CASE("a resolution out of its range is named") {
    for (Extent2D e : {Extent2D{0, 720}, Extent2D{1280, -1}, Extent2D{16385, 1}}) {
        const auto plan = planInputCheck({.resolution = e});
        REQUIRE_FALSE(plan);
        CHECK(plan.error().message.find("settings.resolution is") == 0);
    }
    CHECK(planInputCheck({.resolution = {16384, 16384}}));
}

} // namespace rebound::test
