// SPDX-License-Identifier: MIT
// What indirect light obeys, whatever the sampling: scaling, superposition, rotation, energy, and bounds on
// every input.
#include "test_scene.hpp"

#include <functional>

namespace rebound::test {
namespace {

constexpr Extent2D extent{61, 37};

Frame cornerFrame(StartResolution start = StartResolution::half, int levels = 3, Extent2D e = extent) {
    Frame f = sceneFrame({}, e);
    f.settings.start = start;
    f.settings.levels = levels;
    return f;
}

// One level at the G-buffer's own resolution: nothing is chosen or upsampled, only gathered.
Frame plainFrame() {
    Frame f = cornerFrame(StartResolution::full, 1);
    f.settings.smooth = false;
    return f;
}

Frame scaled(Frame f, float factor) {
    for (float& v : f.radiance.values) v *= factor;
    return f;
}

cpu::Device fast() { return deviceFor(cpu::Isa::automatic); }

// Where reduction chooses between texels that are as good as each other but for the last bits, a few texels
// of the coarser levels lie elsewhere, and light moves a little around them.
constexpr double choices = 5e-3;

} // namespace

TEST_CASE("doubling the light doubles the result to the last bit") {
    const Frame f = cornerFrame();
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Outputs once = render(f, deviceFor(isa)), twice = render(scaled(f, 2.0f), deviceFor(isa));
        CHECK(mean(once.indirect) > 0.01);
        bool exact = true;
        for (size_t i = 0; i < once.indirect.values.size(); ++i)
            exact = exact && twice.indirect.values[i] == 2.0f * once.indirect.values[i];
        CHECK(exact);
    }
}

TEST_CASE("light adds up: that of two lights is the sum of each one's") {
    Frame left = cornerFrame(), right = cornerFrame(), both = cornerFrame();
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x)
            for (int c = 0; c < 3; ++c) (x < 30 ? right : left).radiance.at(x, y, c) = 0.0f;
    const Outputs a = render(left, fast()), b = render(right, fast()), c = render(both, fast());
    Picture sum = a.indirect;
    for (size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += b.indirect.values[i];
    // Sums of some hundred terms in single precision, in another order.
    CHECK(difference(c.indirect, sum).largest < 1e-4);
}

TEST_CASE("doubling all lengths changes nothing") {
    for (StartResolution start : {StartResolution::full, StartResolution::half, StartResolution::quarter}) {
        Frame once = sceneFrame({}, extent), twice = sceneFrame({}, extent, glm::mat4(1.0f), 2.0);
        once.settings.start = twice.settings.start = start;
        // A power of two scales every product exactly; only guards against division by zero do not scale.
        CHECK(difference(render(once, fast()).indirect, render(twice, fast()).indirect).largest < 1e-5);
    }
}

TEST_CASE("a scene of a tenth of a millimetre and one of a hundred kilometres are lit as one of a metre") {
    const Outputs metre = render(cornerFrame(), fast());
    for (double scale : {1e-4, 1e5}) {
        Frame f = sceneFrame({}, extent, glm::mat4(1.0f), scale);
        f.settings.start = StartResolution::half;
        f.settings.levels = 3;
        const Outputs other = render(f, fast());
        CHECK(difference(metre.indirect, other.indirect).average < choices);
        Frame plain = sceneFrame({}, extent, glm::mat4(1.0f), scale);
        plain.settings.start = StartResolution::full;
        plain.settings.levels = 1;
        plain.settings.smooth = false;
        // Lengths are rounded to 24 bits: directions between neighbours to 1e-5 or so, more where surfaces
        // meet.
        CHECK(difference(render(plainFrame(), fast()).indirect, render(plain, fast()).indirect).largest <
              1e-3);
    }
}

TEST_CASE("rotating scene and camera together changes nothing") {
    const glm::mat4 worlds[] = {
        glm::rotate(glm::mat4(1.0f), 1.0f, glm::vec3(0, 1, 0)),
        glm::translate(glm::rotate(glm::mat4(1.0f), 2.5f, glm::vec3(1, 2, -1)), glm::vec3(100, 7, -30))};
    for (const glm::mat4& world : worlds) {
        Frame turned = sceneFrame({}, extent, world);
        turned.settings.start = StartResolution::full;
        turned.settings.levels = 1;
        turned.settings.smooth = false;
        // Normals turned and turned back in single precision: 3e-7 each.
        CHECK(difference(render(plainFrame(), fast()).indirect, render(turned, fast()).indirect).largest <
              1e-4);
        turned = sceneFrame({}, extent, world);
        turned.settings.start = StartResolution::half;
        turned.settings.levels = 3;
        CHECK(difference(render(cornerFrame(), fast()).indirect, render(turned, fast()).indirect).average <
              choices);
    }
}

TEST_CASE("a closed convex room of radiance 1 lights itself with more than nothing and no more than 1") {
    // A corridor 2 m wide and 1.4 m high that ends 3 m ahead: the camera sees a part of all form factors,
    // which sum to 1.
    const Extent2D e{96, 72};
    for (StartResolution start : {StartResolution::full, StartResolution::half}) {
        Frame f = cornerFrame(start, 4, e);
        f.settings.conventions.normalSpace = NormalSpace::view;
        f.settings.samplesPerLevel = 256;
        const Lens lens;
        for (int y = 0; y < e.height; ++y)
            for (int x = 0; x < e.width; ++x) {
                const glm::dvec3 ray(((x + 0.5) / e.width * 2.0 - 1.0 - lens.shiftX) * lens.halfWidth,
                                     (1.0 - (y + 0.5) / e.height * 2.0 - lens.shiftY) * lens.halfHeight,
                                     -1.0);
                const glm::dvec3 walls = glm::abs(ray) / glm::dvec3(1.0, 0.7, 3.0); // inverse distances
                const double nearest = std::max({walls.x, walls.y, walls.z});
                f.depth.at(x, y, 0) = float(1.0 / nearest);
                for (int k = 0; k < 3; ++k) {
                    f.normal.at(x, y, k) = walls[k] == nearest ? (ray[k] > 0 ? -1.0f : 1.0f) : 0.0f;
                    f.radiance.at(x, y, k) = 1.0f;
                }
            }
        const Outputs out = render(f, fast());
        CHECK(mean(out.indirect) > 0.02);
        CHECK(mean(out.indirect) < 1.0);
        // No visibility is lost in a convex room; sampling and discs exceed the sum of 1 by up to 0.2 in corners. The
        // mean over 5x5 texels adds some there: a level's light moves by two of its texels, and two levels' rings, which
        // tile the screen for one receiver, then overlap.
        for (float v : out.indirect.values) CHECK((v >= 0.0f && v < 1.3f));
    }
}

TEST_CASE("a pixel that is no surface or no number is as if it were empty, for all others to the last bit") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                    inf = std::numeric_limits<float>::infinity();
    const std::pair<std::string, std::function<void(Frame&, int, int)>> spoils[] = {
        {"radiance nan", [=](Frame& f, int x, int y) { f.radiance.at(x, y, 1) = nan; }},
        {"radiance inf", [=](Frame& f, int x, int y) { f.radiance.at(x, y, 0) = inf; }},
        {"radiance -inf", [=](Frame& f, int x, int y) { f.radiance.at(x, y, 2) = -inf; }},
        {"normal nan", [=](Frame& f, int x, int y) { f.normal.at(x, y, 0) = nan; }},
        {"normal inf", [=](Frame& f, int x, int y) { f.normal.at(x, y, 2) = inf; }},
        {"normal zero",
         [=](Frame& f, int x, int y) {
             for (int k = 0; k < 3; ++k) f.normal.at(x, y, k) = 0.0f;
         }},
        {"depth nan", [=](Frame& f, int x, int y) { f.depth.at(x, y, 0) = nan; }},
        {"depth inf", [=](Frame& f, int x, int y) { f.depth.at(x, y, 0) = inf; }},
        {"depth negative", [=](Frame& f, int x, int y) { f.depth.at(x, y, 0) = -3.0f; }},
    };
    for (StartResolution start : {StartResolution::full, StartResolution::half, StartResolution::quarter})
        for (auto [px, py] : {std::pair{20, 15}, {0, 0}, {60, 36}}) {
            Frame f = cornerFrame(start, 3), without = f;
            empty(without, px, py);
            const Outputs expected = render(without, fast());
            for (const auto& spoiling : spoils) {
                Frame spoilt = f;
                spoiling.second(spoilt, px, py);
                const Outputs out = render(spoilt, fast());
                CAPTURE(spoiling.first);
                bool same = true;
                for (int y = 0; y < extent.height; ++y)
                    for (int x = 0; x < extent.width; ++x)
                        for (int c = 0; c < 3; ++c)
                            if (x != px || y != py)
                                same = same && out.indirect.at(x, y, c) == expected.indirect.at(x, y, c) &&
                                       out.composed.at(x, y, c) == expected.composed.at(x, y, c);
                CHECK(same);
                for (int c = 0; c < 3; ++c) {
                    CHECK(out.indirect.at(px, py, c) == 0.0f);
                    CHECK(out.composed.at(px, py, c) == f.lit.at(px, py, c));
                }
            }
        }
}

TEST_CASE("negative radiance counts as none, and radiance beyond the largest half float as that") {
    Frame negative = cornerFrame(), none = negative, huge = negative, largest = negative;
    for (int c = 0; c < 3; ++c) {
        negative.radiance.at(20, 15, c) = -5.0f;
        none.radiance.at(20, 15, c) = 0.0f;
        huge.radiance.at(20, 15, c) = 1e30f;
        largest.radiance.at(20, 15, c) = 65504.0f;
    }
    CHECK(sameBits(render(negative, fast()).indirect, render(none, fast()).indirect));
    CHECK(sameBits(render(huge, fast()).indirect, render(largest, fast()).indirect));
}

TEST_CASE("nothing but sky: no indirect light, and the picture as it was") {
    for (Extent2D e : {Extent2D{1, 1}, Extent2D{61, 37}})
        for (cpu::Isa isa : cpu::availableIsas()) {
            Frame f = cornerFrame(StartResolution::quarter, 4, e);
            for (float& d : f.depth.values) d = 0.0f;
            const Outputs out = render(f, deviceFor(isa));
            CHECK(out.indirect.values == std::vector<float>(out.indirect.values.size(), 0.0f));
            CHECK(out.composed.values == f.lit.values);
        }
}

TEST_CASE("pictures of every shape") {
    for (Extent2D e : {Extent2D{1, 1}, Extent2D{1, 9}, Extent2D{13, 1}, Extent2D{2, 2}, Extent2D{3, 5},
                       Extent2D{17, 33}, Extent2D{7, 4096}})
        for (StartResolution start : {StartResolution::full, StartResolution::half, StartResolution::quarter})
            for (int levels : {1, 4, 8}) {
                Frame f = cornerFrame(start, levels, e);
                f.settings.samplesPerLevel = 8;
                const Outputs out = render(f, fast());
                CHECK(allFinite(out.indirect));
                for (float v : out.indirect.values) REQUIRE(v >= 0.0f);
                CHECK(allFinite(out.composed));
            }
}

TEST_CASE("the same bits for any number of threads") {
    const Frame f = cornerFrame(StartResolution::half, 3, {201, 133});
    for (cpu::Isa isa : {cpu::Isa::scalar, fast().isa()}) {
        const Outputs one = render(f, deviceFor(isa, 1));
        for (int threads : {2, 3, 7}) {
            const Outputs other = render(f, deviceFor(isa, threads));
            CHECK(sameBits(one.indirect, other.indirect));
            CHECK(sameBits(one.composed, other.composed));
        }
    }
}

TEST_CASE("one program renders the same frame to the same bits, whatever it rendered before") {
    Frame f = cornerFrame(), other = scaled(f, 1000.0f);
    const cpu::Device device = fast();
    auto program = device.compile(*planScreenIndirect(f.settings));
    REQUIRE(program);
    auto record = [&](Frame& frame) {
        Outputs out{Picture(extent, 3), Picture(extent, 3)};
        auto inputs = screenIndirectInputs(
            frame.settings,
            ScreenIndirectFrame<cpu::Image>{frame.camera, frame.depth.image(), frame.normal.image(),
                                            frame.radiance.image(), frame.albedo.image(), frame.lit.image(),
                                            out.indirect.image(), out.composed.image()});
        REQUIRE(program->record(*inputs));
        return out;
    };
    const Outputs first = record(f);
    record(other);
    CHECK(sameBits(record(f).indirect, first.indirect));
}

TEST_CASE("every instruction set agrees with the scalar one") {
    for (int variant = 0; variant < 4; ++variant) {
        GBufferConventions c;
        c.projection = variant & 1 ? Projection::orthographic : Projection::perspective;
        for (bool plain : {true, false}) {
            Frame f = sceneFrame(c, extent);
            f.settings.formFactor = variant & 2 ? FormFactor::pointToPoint : FormFactor::pointToDisc;
            f.settings.start = plain ? StartResolution::full : StartResolution::half;
            f.settings.levels = plain ? 1 : 3;
            f.settings.smooth = !plain;
            const Outputs scalar = render(f, deviceFor(cpu::Isa::scalar));
            for (cpu::Isa isa : cpu::availableIsas()) {
                const Difference d = difference(scalar.indirect, render(f, deviceFor(isa)).indirect);
                INFO(std::string(cpu::name(isa)));
                // Reciprocals to 5e-7, some in a row; differences of nearby positions lose a hundred times
                // that.
                if (plain) CHECK(d.largest < 1e-3);
                CHECK(d.average < (plain ? 1e-5 : choices));
            }
        }
    }
}

TEST_CASE("the levels' contributions, each shown alone, add up to the whole") {
    for (StartResolution start : {StartResolution::full, StartResolution::quarter})
        for (int levels : {1, 2, 4}) {
            Frame f = cornerFrame(start, levels);
            const Outputs whole = render(f, fast());
            Picture sum(extent, 3);
            for (int k = 0; k < levels; ++k) {
                f.settings.onlyLevel = k;
                const Outputs alone = render(f, fast());
                for (size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += alone.indirect.values[i];
            }
            // Upsampling is linear: the same weights in another order of summation.
            CHECK(difference(whole.indirect, sum).largest < 1e-4);
        }
}

TEST_CASE("point-to-point form factors are finite, also where surfaces meet") {
    for (StartResolution start : {StartResolution::full, StartResolution::half}) {
        Frame f = cornerFrame(start, 3);
        f.settings.formFactor = FormFactor::pointToPoint;
        for (cpu::Isa isa : cpu::availableIsas()) {
            const Outputs out = render(f, deviceFor(isa));
            CHECK(allFinite(out.indirect));
            CHECK(mean(out.indirect) > 0.01);
        }
    }
}

TEST_CASE("the composed picture is lit + albedo * indirect, by either way to it") {
    for (StartResolution start : {StartResolution::full, StartResolution::quarter})
        for (cpu::Isa isa : cpu::availableIsas()) {
            Frame f = cornerFrame(start, 3);
            const Outputs both = render(f, deviceFor(isa));
            for (size_t i = 0; i < both.composed.values.size(); ++i) {
                const double want =
                    double(f.lit.values[i]) + double(f.albedo.values[i]) * double(both.indirect.values[i]);
                REQUIRE(both.composed.values[i] ==
                        doctest::Approx(want).epsilon(2e-7)); // two roundings of 6e-8
            }
            f.settings.writeIndirect = false;
            const Outputs direct = render(f, deviceFor(isa));
            CHECK(direct.indirect.values == std::vector<float>(direct.indirect.values.size(), -1.0f));
            for (size_t i = 0; i < both.composed.values.size(); ++i)
                REQUIRE(direct.composed.values[i] == doctest::Approx(both.composed.values[i]).epsilon(2e-7));
            f.settings.writeIndirect = true;
            f.settings.compose = false;
            const Outputs indirect = render(f, deviceFor(isa));
            CHECK(sameBits(indirect.indirect, both.indirect));
            CHECK(indirect.composed.values == std::vector<float>(indirect.composed.values.size(), -1.0f));
        }
}

TEST_CASE("G-buffers of random bits leave finite light, and none that is negative") {
    uint32_t state = 12345;
    auto bits = [&state] { return state = state * 1664525u + 1013904223u; };
    for (int round = 0; round < 12; ++round)
        for (cpu::Isa isa : {cpu::Isa::scalar, fast().isa()}) {
            GBufferConventions c;
            c.projection = round % 2 ? Projection::orthographic : Projection::perspective;
            c.depthEncoding = round % 4 < 2 ? DepthEncoding::planar : DepthEncoding::device;
            Frame f = sceneFrame(c, extent);
            f.settings.start = StartResolution(round % 3);
            f.settings.levels = 1 + round % 4;
            f.settings.formFactor = round % 5 ? FormFactor::pointToDisc : FormFactor::pointToPoint;
            // A third of the pixels hold random bits, in depth, normal or radiance, or in all.
            for (size_t i = 0; i < f.depth.values.size(); ++i) {
                if (bits() >> 16 & 2) continue;
                auto garbage = [&] {
                    const uint32_t b = bits() ^ bits() >> 15;
                    float v;
                    std::memcpy(&v, &b, 4);
                    return v;
                };
                if (bits() >> 20 & 1) f.depth.values[i] = std::abs(garbage());
                for (size_t k = 0; k < 3; ++k) {
                    if (bits() >> 20 & 1) f.normal.values[3 * i + k] = garbage();
                    if (bits() >> 20 & 1) f.radiance.values[3 * i + k] = garbage();
                }
            }
            const Outputs out = render(f, deviceFor(isa));
            CAPTURE(round);
            INFO(std::string(cpu::name(isa)));
            CHECK(allFinite(out.indirect));
            int negative = 0;
            for (float v : out.indirect.values) negative += v < 0.0f ? 1 : 0;
            CHECK(negative == 0);
        }
}

} // namespace rebound::test
