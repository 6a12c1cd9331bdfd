// SPDX-License-Identifier: MIT
// Every test kernel on Vulkan against the scalar CPU device, within what Vulkan promises of its operations.
#include "vulkan_host.hpp"

#include "../unit/arithmetic_operands.hpp"
#include "../unit/half_operands.hpp"
#include "../unit/test_camera.hpp"

#include <cmath>
#include <limits>

namespace rebound::test {
namespace {

// Where the two differ by more than the share of the value; both are NaN, or neither is.
int countDifferences(const Picture& gpu, const Picture& cpu, double share, double absolute = 0.0) {
    REQUIRE(gpu.values.size() == cpu.values.size());
    int wrong = 0;
    for (size_t i = 0; i < gpu.values.size(); ++i) {
        const double a = gpu.values[i], b = cpu.values[i];
        const bool same =
            std::isnan(b) ? std::isnan(a) : a == b || std::abs(a - b) <= share * std::abs(b) + absolute;
        if (!same && ++wrong == 1) FAIL_CHECK("value ", i, " is ", a, " on Vulkan and ", b, " on the CPU");
    }
    return wrong;
}

class Comparison {
public:
    explicit Comparison(const VulkanHost& h) : host(h), device(h.device()) {}

    void check(const KernelCall& call, double share, double absolute = 0.0) const {
        NamedPictures inputs;
        for (const auto& [slot, picture] : call.inputs)
            inputs.push_back({"input " + std::to_string(slot), *picture});
        check(planOf(call), inputs, {}, share, absolute);
    }
    void check(const Plan& plan, const NamedPictures& inputs, const std::vector<NamedConstants>& constants,
               double share, double absolute = 0.0) const {
        CHECK(countDifferences(runOnVulkan(host, device, plan, inputs, constants),
                               runOnCpu(plan, inputs, constants), share, absolute) == 0);
    }

private:
    const VulkanHost& host;
    vulkan::Device device;
};

} // namespace

TEST_CASE("arithmetic: exact where Vulkan rounds correctly, within its units in the last place elsewhere") {
    const auto host = VulkanHost::open();
    const Comparison compare(*host);
    // Vulkan leaves open what becomes of denormals, infinities and NaN in arithmetic: normal values, normal results.
    Operands o = everyPair({1.0f, -1.0f, 0.5f, 1.5f, -2.5f, 3e8f, -3e8f, 1.2e-6f, 8388608.0f, 8388607.5f,
                            -0.25f, 65504.0f, 0.1f, -7.75f, 99.999f, -4194304.5f});
    for (int operation = 0; operation < opCount; ++operation) {
        CAPTURE(operation);
        switch (operation) {
        case opDivide:
        case opDivideBy:
            compare.check(arithmetic(operation, o), 2.5 * std::ldexp(1.0, -23));
            break;   // 2.5 ULP
        case opSqrt: // of negative values left open; 1 / inversesqrt: 2 ULP, and a division's 2.5
        case opInverseSqrt: {
            Operands positive = o;
            for (float& x : positive.x.values) x = std::abs(x);
            compare.check(arithmetic(operation, positive),
                          5e-7 + 4.5 * std::ldexp(1.0, -23)); // the CPU's own: 5e-7
            break;
        }
        case opReciprocal:
            compare.check(arithmetic(operation, o), 5e-7 + 2.5 * std::ldexp(1.0, -23));
            break;
        case opMix:
        case opVectors:
            break; // below, with operands whose products and sums are exact in any order
        default:
            if (operation >= opIntAdd && operation <= opRoundTrip) break; // below, with whole numbers
            compare.check(arithmetic(operation, o), 0.0);
        }
    }
}

TEST_CASE("whole numbers, vectors, and what is not finite") {
    const auto host = VulkanHost::open();
    const Comparison compare(*host);
    Operands whole = everyPair(wholeNumbers());
    for (int operation = opIntAdd; operation <= opRoundTrip; ++operation) {
        CAPTURE(operation);
        compare.check(arithmetic(operation, whole), 0.0);
    }
    Operands vectors = exactVectors();
    compare.check(arithmetic(opVectors, vectors), 1e-6, 1e-5); // a root beside exact sums that may cancel
    compare.check(arithmetic(opVectorSelect, vectors), 0.0);
    Operands exact = everyPair({0.0f, 1.0f, 0.5f, 0.25f, -3.0f, 8.0f});
    compare.check(arithmetic(opMix, exact), 0.0);

    constexpr float infinity = std::numeric_limits<float>::infinity();
    Operands hard =
        everyPair({0.0f, 1.0f, infinity, -infinity, std::numeric_limits<float>::quiet_NaN(), 3e38f});
    compare.check(arithmetic(opIsFinite, hard), 0.0); // looks at bits
}

TEST_CASE("images of halves: the nearest one, at most 65504, whatever the driver would make of it") {
    const auto host = VulkanHost::open();
    const Picture source = numbersAroundHalves();
    checkNearestHalves(source,
                       runOnVulkan(*host, host->device(), halvesPlan(source.extent), {{"host", source}}, {}));
}

TEST_CASE("access: every way to read an image, exact") {
    const auto host = VulkanHost::open();
    const Comparison compare(*host);
    for (Extent2D extent : {Extent2D{1, 1}, Extent2D{7, 5}, Extent2D{8, 8}, Extent2D{33, 17}})
        for (int mode = 0; mode < accessCount; ++mode)
            for (ivec2 offset :
                 {ivec2(0, 0), ivec2(1, -1), ivec2(-7, 3), ivec2(1000000, 0), ivec2(0, -(1 << 30))}) {
                // Minified reads are of offsets around the texel, and reaches() may say yes too often on a CPU's lanes,
                // of which the scalar one has one.
                const bool nearby = std::abs(offset.x) <= 2 && std::abs(offset.y) <= 2;
                if (!nearby &&
                    (mode == accessMinified || mode == accessHostMinified || mode == accessMagnified))
                    continue;
                CAPTURE(mode);
                const int shift = mode == accessMagnified ? 1 : 0;
                compare.check(copyPlan(extent, mode), {{"host", numbered(extent)}},
                              {accessConstants(extent, offset, shift, shift)}, 0.0);
            }
}

TEST_CASE("language: loops, features, tables and constants, exact") {
    const auto host = VulkanHost::open();
    const Comparison compare(*host);
    Picture start({40, 9}, 1);
    for (size_t i = 0; i < start.values.size(); ++i) start.values[i] = float(i * 37 % 301);
    const std::vector<TableEntry> table = {
        {{0, 0, 2, 0}, {0, 1}, 0.5f, 0}, {{0, 0, -1, 0}, {0, 0}, 4.0f, 0}, {{0, 0, 8, 0}, {7, -3}, 0.25f, 0}};
    std::vector<std::byte> entries(table.size() * sizeof(TableEntry));
    std::memcpy(entries.data(), table.data(), entries.size());
    const LanguageConstants k{{40, 9, 3, 0}, {9.0f, 0.5f, 9.0f, 42.0f}};
    for (const std::vector<int>& features : {std::vector<int>{}, {1}, {0, 2}, {1, 1, 1, 1}, {1, 2, 1, 3}})
        compare.check({"language", features, {{0, &start}}, {{2, bytesOf(k)}, {3, entries}}, 1, {40, 9}},
                      0.0);
}

TEST_CASE("camera_math: every convention, to the rounding of some ten operations") {
    const auto host = VulkanHost::open();
    const Comparison compare(*host);
    const Extent2D extent{19, 7};
    const glm::mat4 someView =
        glm::lookAt(glm::vec3(3, 1, -2), glm::vec3(-1, 0.5f, 4), glm::vec3(0.2f, 1, 0.1f));
    int index = 0;
    for (const GBufferConventions& c : everyConvention()) {
        const glm::mat4 view = viewOf(c, someView);
        const auto camera = cameraConstants({view, projectionOf(c, {})}, c, extent);
        REQUIRE(camera);
        Picture depth(extent, 1), normal(extent, 3);
        for (int i = 0; i < extent.width * extent.height; ++i) {
            depth.values[size_t(i)] = storedDepth(c, {}, 0.6 + 0.05 * double(i));
            const glm::vec3 n = storedNormal(
                c, view, glm::normalize(glm::vec3(std::sin(float(i)), std::cos(float(i)), 0.7f)));
            for (int k = 0; k < 3; ++k) normal.values[size_t(3 * i + k)] = n[k];
        }
        // One mode a convention, in turn: all pairs would take minutes.
        const int mode = index++ % cameraModeCount;
        const CameraMathConstants k{{extent.width, extent.height, 0, 0}, {0.05f, 0, 0, 0}};
        CAPTURE(mode);
        // Device depth close to the far plane magnifies a division's rounding some ten times, areas its square.
        compare.check({"camera_math",
                       {mode, c.projection == Projection::orthographic ? 1 : 0},
                       {{0, &depth}, {1, &normal}},
                       {{3, bytesOf(*camera)}, {4, bytesOf(k)}},
                       2,
                       extent},
                      1e-4, 1e-5);
    }
    CHECK(index > 200);
}

TEST_CASE("light_math: form factors and weights to single precision, packed texels to half") {
    const auto host = VulkanHost::open();
    const Comparison compare(*host);
    const Extent2D extent{31, 13};
    Picture first(extent, 4), second(extent, 4);
    for (size_t i = 0; i < first.values.size(); ++i) {
        first.values[i] = 0.05f + float(i * 29 % 101) / 101.0f;
        second.values[i] = 0.05f + float(i * 53 % 97) / 97.0f;
    }
    // Normals of unit length, as packing expects them.
    for (size_t i = 0; i < first.values.size(); i += 4) {
        const glm::vec3 n =
            glm::normalize(glm::vec3(first.values[i], first.values[i + 1], first.values[i + 2]) - 0.5f);
        for (size_t k = 0; k < 3; ++k) first.values[i + k] = n[int(k)];
    }
    const GridConstants k{{extent.width, extent.height, 0, 0}};
    for (int mode = 0; mode < lightModeCount; ++mode) {
        CAPTURE(mode);
        // Packing rounds to half: values that lie between two halves may fall to either, 2^-10 apart.
        const bool packed = mode == lightUnpacked || mode == lightUnpackedArea;
        compare.check({"light_math", {mode}, {{0, &first}, {1, &second}}, {{3, bytesOf(k)}}, 2, extent},
                      packed ? std::ldexp(1.0, -9) : 1e-5, packed ? std::ldexp(1.0, -9) : 1e-7);
    }
}

} // namespace rebound::test
