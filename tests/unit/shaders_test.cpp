// SPDX-License-Identifier: MIT
// Shaders for GPUs, embedded, and the plans that name them.
#include "kernel_runner.hpp"

#include "rebound/techniques/input_check.hpp"
#include "rebound/techniques/screen_indirect.hpp"

#include <set>

namespace rebound::test {
namespace {

void checkShaders(std::span<const Shader* const> shaders, std::span<const cpu::KernelEntry* const> kernels) {
    std::set<std::string> shaderNames, kernelNames;
    for (const Shader* s : shaders) {
        CAPTURE(s->name);
        CHECK(shaderNames.insert(std::string(s->name)).second);
        REQUIRE(s->spirv.size() > 5);
        CHECK(s->spirv[0] == 0x07230203u); // SPIR-V's magic number
        CHECK(s->spirv[1] <= 0x00010300u); // Vulkan 1.1 takes up to SPIR-V 1.3
        CHECK(s->glsl.find("void main()") != std::string_view::npos);
        for (const char* left : {"#version", "#include", "#line", "RB_", "GL_GOOGLE"})
            CHECK(s->glsl.find(left) == std::string_view::npos);
    }
    for (const cpu::KernelEntry* k : kernels) CHECK(kernelNames.insert(k->name).second);
    CHECK(shaderNames == kernelNames);
}

// The values that a kernel of that name takes for its features, as GLSL text has them.
bool usesFeature(std::string_view glsl, int id) {
    return glsl.find("REBOUND_FEATURE_" + std::to_string(id)) != std::string_view::npos;
}

} // namespace

TEST_CASE("every kernel has a shader of the same name, in SPIR-V and in GLSL") {
    for (cpu::Isa isa : cpu::availableIsas()) {
        checkShaders(techniqueShaders(), cpu::techniqueKernels(isa));
        checkShaders(inputCheckShaders(), cpu::inputCheckKernels(isa));
        checkShaders(testShaders(), cpu::testKernels(isa));
    }
}

TEST_CASE("every instruction set has the same kernels, with the same slots and features") {
    const auto reference = cpu::techniqueKernels(cpu::Isa::scalar);
    for (cpu::Isa isa : cpu::availableIsas()) {
        const auto kernels = cpu::techniqueKernels(isa);
        REQUIRE(kernels.size() == reference.size());
        for (size_t i = 0; i < kernels.size(); ++i) {
            CHECK(std::string_view(kernels[i]->name) == reference[i]->name);
            CHECK(std::ranges::equal(kernels[i]->info.kinds, reference[i]->info.kinds));
            CHECK(std::ranges::equal(kernels[i]->info.featureCounts, reference[i]->info.featureCounts));
            CHECK(std::ranges::equal(kernels[i]->info.sizes, reference[i]->info.sizes));
        }
    }
}

TEST_CASE("a shader declares the slots and features that its kernel has, and the formats of what it writes") {
    const auto check = [](std::span<const Shader* const> shaders,
                          std::span<const cpu::KernelEntry* const> kernels) {
        for (const cpu::KernelEntry* kernel : kernels)
            for (const Shader* shader : shaders)
                if (shader->name == kernel->name) {
                    CAPTURE(shader->name);
                    CHECK(std::ranges::equal(shader->info.kinds, kernel->info.kinds));
                    CHECK(std::ranges::equal(shader->info.featureCounts, kernel->info.featureCounts));
                    CHECK(std::ranges::equal(shader->info.sizes, kernel->info.sizes));
                    CHECK(shader->info.forItems == kernel->info.forItems);
                    CHECK((shader->glsl.find("local_size_x = 64") != std::string_view::npos) ==
                          kernel->info.forItems);
                    for (int slot = 0; slot < slotCount; ++slot)
                        if (shader->info.kinds[slot] == BindingKind::image ||
                            shader->info.kinds[slot] == BindingKind::output)
                            CHECK(shader->glsl.find("binding = " + std::to_string(slot) + ", " +
                                                    name(shader->info.formats[slot])) !=
                                  std::string_view::npos);
                }
    };
    check(techniqueShaders(), cpu::techniqueKernels(cpu::Isa::scalar));
    check(inputCheckShaders(), cpu::inputCheckKernels(cpu::Isa::scalar));
    check(testShaders(), cpu::testKernels(cpu::Isa::scalar));
}

TEST_CASE("a shader's GLSL has the features that its kernel has") {
    for (const cpu::KernelEntry* kernel : cpu::techniqueKernels(cpu::Isa::scalar))
        for (const Shader* shader : techniqueShaders())
            if (shader->name == kernel->name)
                for (int id = 0; id < featureCapacity; ++id) {
                    CAPTURE(shader->name);
                    CHECK(usesFeature(shader->glsl, id) == (kernel->info.featureCounts[id] > 1));
                }
}

TEST_CASE("what settings plan, the device has: kernels, slots and features") {
    const cpu::Device device = deviceFor(cpu::Isa::scalar);
    for (int bits = 0; bits < 1 << 8; ++bits)
        for (StartResolution start : {StartResolution::full, StartResolution::half, StartResolution::quarter})
            for (int levels : {1, 2, 5}) {
                auto bit = [bits](int i) { return (bits >> i & 1) != 0; };
                ScreenIndirectSettings s;
                s.resolution = bit(0) ? Extent2D{37, 21} : Extent2D{1, 3};
                s.conventions.projection = bit(1) ? Projection::orthographic : Projection::perspective;
                s.reduction = bit(2) ? Reduction::nearest : Reduction::voting;
                s.formFactor = bit(3) ? FormFactor::pointToPoint : FormFactor::pointToDisc;
                s.smooth = bit(4);
                s.coverScreen = bit(5);
                s.writeIndirect = bit(6);
                s.compose = bit(7) || !bit(6);
                s.start = start;
                s.levels = levels;
                s.samplesPerLevel = 4;
                s.ringRadius = 4.0f;
                if (bit(0)) s.onlyLevel = levels / 2;
                auto plan = planScreenIndirect(s);
                REQUIRE(plan);
                const auto valid = validate(*plan);
                INFO((valid ? "" : valid.error().message));
                REQUIRE(valid);
                const auto program = device.compile(*plan);
                REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
            }
}

} // namespace rebound::test
