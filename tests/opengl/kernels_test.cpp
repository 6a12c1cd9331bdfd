// SPDX-License-Identifier: MIT
// The unit tests' kernels on OpenGL, against the CPU one pixel at a time.
#include "arithmetic_operands.hpp"
#include "half_operands.hpp"
#include "opengl_runner.hpp"
#include "test_scene.hpp"

#include <cmath>
#include <functional>

namespace rebound::test {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

using Tolerance = std::function<double(size_t)>; // of a value, by its index

// Values that the CPU makes infinite or NaN are left out: GLSL does not say what becomes of them.
void checkClose(const Picture& got, const Picture& want, const Tolerance& tolerance) {
    REQUIRE(got.values.size() == want.values.size());
    int wrong = 0, compared = 0;
    for (size_t i = 0; i < want.values.size(); ++i) {
        if (!std::isfinite(want.values[i])) continue;
        ++compared;
        const double apart = std::abs(double(got.values[i]) - double(want.values[i]));
        if (!(apart <= tolerance(i)) && ++wrong == 1)
            FAIL_CHECK("value " << i << " is " << got.values[i] << ", not " << want.values[i]);
    }
    CHECK(wrong == 0);
    CHECK(compared > 0);
}

void checkSame(const Picture& got, const Picture& want) {
    checkClose(got, want, [](size_t) { return 0.0; });
}

// host -> copy -> source -> access -> result
Plan accessPlan(int mode, Extent2D source, Extent2D grid, const AccessConstants& k) {
    const Format format = Format::rgba32f;
    Plan plan{"test", {}, {}};
    plan.add({"host", ResourceKind::input, format, 4, source, {}, 0});
    plan.add({"source", ResourceKind::transient, format, 4, source, {}, 0});
    plan.add({"result", ResourceKind::output, format, 4, grid, {}, 0});
    plan.add(bufferResource("constants", std::vector{k}));
    plan.add(
        bufferResource("copy constants", std::vector<GridConstants>{{{source.width, source.height, 0, 0}}}));
    plan.passes.push_back({"copy", "copy", {}, {{0, 0}, {1, 1, Access::write}, {2, 4}}, source});
    plan.passes.push_back(
        {"access", "access", {mode}, {{0, 1}, {1, 0}, {2, 2, Access::write}, {3, 3}}, grid});
    return plan;
}

void checkArithmetic(const opengl::Device& device, int operation, Operands o, const Tolerance& tolerance) {
    CAPTURE(operation);
    const KernelCall call = arithmetic(operation, o);
    checkClose(runKernel(device, call), runKernel(cpu::Isa::scalar, call), tolerance);
}

} // namespace

TEST_CASE("OpenGL stores the nearest half, at most 65504, whatever the driver would make of it") {
    const Picture source = numbersAroundHalves();
    inEachContext([&](host::OpenGLContext&) {
        const Pictures outputs =
            runPlan(createDevice(), halvesPlan(source.extent), {{"host", source}}, Format::rgba32f);
        checkNearestHalves(source, outputs.at("result"));
    });
}

TEST_CASE("OpenGL reads images as the CPU does: every mode, inside and outside") {
    const Extent2D sources[] = {{1, 1}, {8, 8}, {17, 5}, {33, 9}};
    const ivec2 offsets[] = {{0, 0}, {1, -1}, {-7, 2}, {40, 0}, {1000000, -1000000}, {1 << 29, 0}};
    inEachContext([&](host::OpenGLContext&) {
        const opengl::Device device = createDevice();
        const cpu::Device reference = deviceFor(cpu::Isa::scalar);
        for (Extent2D source : sources)
            for (int mode = 0; mode < accessCount; ++mode)
                for (ivec2 offset : offsets) {
                    // Offsets of a fixed few texels only, on the CPU: see docs/kernel_language.md.
                    const bool few =
                        mode == accessMinified || mode == accessHostMinified || mode == accessMagnified;
                    if (few && (std::abs(offset.x) > 1 || std::abs(offset.y) > 1)) continue;
                    const bool minified = mode == accessMinified || mode == accessHostMinified;
                    const bool magnified = mode == accessMagnified;
                    const Extent2D grid{minified    ? (source.width + 1) / 2
                                        : magnified ? 2 * source.width - 1
                                                    : source.width,
                                        minified    ? (source.height + 1) / 2
                                        : magnified ? 2 * source.height - 1
                                                    : source.height};
                    const AccessConstants k{{grid.width, grid.height, 1, 1}, {offset.x, offset.y, 0, 0}};
                    const Plan plan = accessPlan(mode, source, grid, k);
                    const Pictures host = {{"host", numbered(source)}};
                    CAPTURE(mode);
                    CAPTURE(offset.x);
                    checkSame(runPlan(device, plan, host, Format::rgba32f).at("result"),
                              runPlan(reference, plan, host).at("result"));
                }
    });
}

TEST_CASE("OpenGL computes as the CPU does: what GLSL rounds correctly is the same to the bit") {
    const Operands o = everyPair({0.0f, 1.0f, -1.0f, 0.5f, 1.5f, -2.5f, 1e10f, -0.25f, 65504.0f, 0.1f, -7.75f,
                                  99.999f, 8388607.5f, -4194304.5f, 1e-10f},
                                 4);
    inEachContext([&](host::OpenGLContext&) {
        const opengl::Device device = createDevice();
        const auto exact = [](size_t) { return 0.0; };
        for (int op : {opAdd,        opSubtract, opMultiply, opNegate,      opAddTo,        opSubtractFrom,
                       opMultiplyBy, opLess,     opGreater,  opLessEqual,   opGreaterEqual, opEqual,
                       opAnd,        opOr,       opNot,      opMin,         opMax,          opAbs,
                       opFloor,      opClamp,    opSelect,   opVectorSelect})
            checkArithmetic(device, op, o, exact);
        checkArithmetic(device, opIsFinite, everyPair({0.0f, 3e38f, infinity, -infinity, nan, -1.0f}, 4),
                        exact);
        for (int op = opIntAdd; op <= opRoundTrip; ++op)
            checkArithmetic(device, op, everyPair(wholeNumbers(), 4), exact);
    });
}

TEST_CASE("OpenGL computes as the CPU does: what GLSL leaves to the GPU, within GLSL's own bounds") {
    const std::vector<float> positive = {1e-10f, 0.1f,  0.25f,   0.3f,     1.0f,
                                         1.5f,   7.75f, 99.999f, 65504.0f, 1e10f};
    const Operands o = everyPair(positive, 4);
    inEachContext([&](host::OpenGLContext&) {
        const opengl::Device device = createDevice();
        // GLSL 4.60 and ES 3.20, 4.7.1: 2.5 units in the last place for a division, 2 for inversesqrt; sqrt
        // is a division by that. A unit is at most 1.2e-7 of the value; the CPU adds half a one.
        for (auto [operation, units] : {std::pair{opDivide, 3.0},
                                        {opDivideBy, 3.0},
                                        {opReciprocal, 3.0},
                                        {opInverseSqrt, 2.5},
                                        {opSqrt, 5.0}}) {
            const auto value = [&, op = operation](size_t i) {
                const double x = o.x.values[i], y = o.y.values[i];
                return op == opReciprocal    ? 1.0 / x
                       : op == opInverseSqrt ? 1.0 / std::sqrt(x)
                       : op == opSqrt        ? std::sqrt(x)
                                             : x / y;
            };
            checkArithmetic(device, operation, o, [&, n = units](size_t i) { return n * 1.2e-7 * value(i); });
        }
        // A product and a sum, in either order: a few roundings of terms as large as these.
        checkArithmetic(device, opMix, o, [&](size_t i) {
            return 3e-7 * (1.0 + double(o.z.values[i])) * double(o.x.values[i] + o.y.values[i]);
        });
        const Operands small = everyPair({-2.75f, -1.0f, -0.25f, 0.0f, 0.5f, 1.25f, 2.5f}, 4);
        // Sums of up to 6 products of at most 8, and a length.
        checkArithmetic(device, opVectors, small, [](size_t) { return 48 * 3e-7; });
    });
}

TEST_CASE("OpenGL runs features, tables, constants and loops as the CPU does") {
    Picture start({100, 3}, 1);
    for (size_t i = 0; i < start.values.size(); ++i) start.values[i] = float(i * 37 % 301);
    const std::vector<TableEntry> table = {
        {{0, 0, 2, 0}, {0, 1}, 0.5f, 0}, {{0, 0, -1, 0}, {0, 0}, 4.0f, 0}, {{0, 0, 8, 0}, {7, -3}, 0.25f, 0}};
    const LanguageConstants k{{100, 3, 3, 0}, {9.0f, 0.5f, 9.0f, 42.0f}};
    std::vector<std::byte> entries(table.size() * sizeof(TableEntry));
    std::memcpy(entries.data(), table.data(), entries.size());
    inEachContext([&](host::OpenGLContext&) {
        const opengl::Device device = createDevice();
        for (const std::vector<int>& features :
             {std::vector<int>{}, {1}, {0, 2}, {1, 2, 1, 3}, {0, 0, 1}, {1, 1, 0, 2}}) {
            const KernelCall call{"language", features, {{0, &start}}, {{2, bytesOf(k)}, {3, entries}},
                                  1,          {100, 3}};
            checkSame(runKernel(device, call), runKernel(cpu::Isa::scalar, call));
        }
    });
}

TEST_CASE("OpenGL places G-buffers as the CPU does") {
    const Extent2D extent{37, 21};
    const std::vector<GBufferConventions> all = everyConvention();
    inEachContext([&](host::OpenGLContext&) {
        const opengl::Device device = createDevice();
        for (size_t i = 0; i < all.size(); i += 23) { // a dozen or so, of every kind
            Frame f = sceneFrame(all[i], extent);
            auto camera = cameraConstants(f.camera, all[i], extent);
            REQUIRE(camera);
            const CameraMathConstants k{{extent.width, extent.height, 0, 0}, {0.05f, 0, 0, 0}};
            const int projection = all[i].projection == Projection::orthographic ? 1 : 0;
            for (int mode = 0; mode < cameraModeCount; ++mode) {
                CAPTURE(mode);
                const KernelCall call{"camera_math",
                                      {mode, projection},
                                      {{0, &f.depth}, {1, &f.normal}},
                                      {{3, bytesOf(*camera)}, {4, bytesOf(k)}},
                                      2,
                                      extent};
                const Picture want = runKernel(cpu::Isa::scalar, call);
                // As in camera_math_test.cpp: mapping back a stored depth close to 1 multiplies each
                // rounding.
                checkClose(runKernel(device, call), want,
                           [&](size_t v) { return 1e-4 * std::abs(double(want.values[v])) + 1e-6; });
            }
        }
    });
}

TEST_CASE("OpenGL transfers and packs light as the CPU does") {
    Picture first({100, 3}, 4), second({100, 3}, 4);
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(std::sin(i), std::cos(3 * i), std::sin(2 * i + 1)));
        for (size_t c = 0; c < 3; ++c) first.values[size_t(4 * i) + c] = float(std::abs(n[int(c)]));
        first.values[size_t(4 * i + 3)] = 0.01f * float(i + 1);
        second.values[size_t(4 * i)] = std::pow(10.0f, -6.0f + 0.04f * float(i));
        second.values[size_t(4 * i + 1)] = first.values[size_t(4 * i + 3)] * (1.0f + 0.003f * float(i % 100));
        second.values[size_t(4 * i + 2)] = float(i);
    }
    inEachContext([&](host::OpenGLContext&) {
        const opengl::Device device = createDevice();
        for (int mode = 0; mode < lightModeCount; ++mode) {
            CAPTURE(mode);
            const GridConstants k{{100, 3, 0, 0}};
            const KernelCall call{"light_math",      {mode}, {{0, &first}, {1, &second}},
                                  {{3, bytesOf(k)}}, 2,      {100, 3}};
            const Picture want = runKernel(cpu::Isa::scalar, call);
            // Quotients and an inverse square root, a few units in the last place each, squared at most
            // twice.
            checkClose(runKernel(device, call), want,
                       [&](size_t v) { return 3e-6 * std::abs(double(want.values[v])); });
        }
    });
}

} // namespace rebound::test
