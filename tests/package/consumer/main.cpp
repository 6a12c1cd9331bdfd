// SPDX-License-Identifier: MIT
// consumer [isa]
// A frame of indirect light on the CPU, through Rebound's public surface alone. Exit status 0: the light is
// right as far as can be said without a reference; 1: it is not; 2: the processor does not run that
// instruction set.
#include "indirect_light.hpp"

#include <rebound/shaders.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace rebound {
std::span<const Shader* const> consumerShaders();
namespace cpu {
std::span<const KernelEntry* const> consumerKernels(Isa);
}
} // namespace rebound

namespace {

using namespace rebound;
using glm::ivec4;
#include "halve_constants.h"

constexpr Extent2D extent{64, 36};
constexpr size_t pixelCount = size_t(extent.width) * size_t(extent.height);

// A dark floor 1 m below the eye, and 4 m ahead a wall that sends out radiance 1.
struct Room {
    Camera camera;
    std::vector<float> depth, normal, radiance, albedo, lit, composed;

    // A picture in which nothing is lit yet, and surfaces reflect everything: what is added is the light itself.
    Room()
        : depth(pixelCount), normal(3 * pixelCount), radiance(3 * pixelCount), albedo(3 * pixelCount, 1.0f),
          lit(3 * pixelCount), composed(3 * pixelCount) {
        camera.projection = glm::perspective(glm::radians(60.0f), 16.0f / 9.0f, 0.1f, 100.0f);
        const float slope = std::tan(glm::radians(30.0f));
        for (int y = 0; y < extent.height; ++y)
            for (int x = 0; x < extent.width; ++x) {
                const size_t i = size_t(y) * size_t(extent.width) + size_t(x);
                const float down = slope * (2.0f * (float(y) + 0.5f) / float(extent.height) - 1.0f);
                const bool floor = down * 4.0f > 1.0f;
                depth[i] = floor ? 1.0f / down : 4.0f;
                normal[3 * i + (floor ? 1 : 2)] = 1.0f;
                for (size_t c = 0; c < 3; ++c) radiance[3 * i + c] = floor ? 0.0f : 1.0f;
            }
    }
};

int fail(const std::string& message) {
    std::fprintf(stderr, "consumer: %s\n", message.c_str());
    return 1;
}

Result<> light(Room& room, const cpu::Device& device) {
    auto indirectLight = IndirectLight::create(device, extent);
    if (!indirectLight) return indirectLight.error();
    return indirectLight->add(room.camera, {room.depth.data(), room.normal.data(), room.radiance.data(),
                                            room.albedo.data(), room.lit.data(), room.composed.data()});
}

// Halves an image with the consumer's own kernel.
Result<std::vector<float>> halve(std::vector<float> whole, const cpu::Device& device) {
    Plan plan{"halve", {}, {}};
    const ResourceIndex from = plan.add({"from", ResourceKind::input, Format::rgba16f, 3, extent, {}, 0});
    const ResourceIndex to = plan.add({"to", ResourceKind::output, Format::rgba16f, 3, extent, {}, 0});
    const ResourceIndex constants = plan.add(
        bufferResource("constants", std::vector<HalveConstants>{{ivec4(extent.width, extent.height, 0, 0)}}));
    plan.passes.push_back({"halve",
                           "halve",
                           {},
                           {{0, from, Access::read}, {1, to, Access::write}, {2, constants, Access::read}},
                           extent});
    auto program = device.compile(plan);
    if (!program) return program.error();
    std::vector<float> result(whole.size());
    FrameInputs<cpu::Image> inputs;
    inputs.images = {{"from", cpu::interleavedImage(whole.data(), extent, 3)},
                     {"to", cpu::interleavedImage(result.data(), extent, 3)}};
    if (auto recorded = program->record(inputs); !recorded) return recorded.error();
    return result;
}

// The wall, seen by the floor only, lights it with less than its own radiance; nothing lights the wall.
bool isPlausible(const Room& room) {
    float brightest = 0.0f;
    for (size_t i = 0; i < room.composed.size(); ++i) {
        if (!std::isfinite(room.composed[i])) return false;
        const bool floor = room.radiance[i] == 0.0f;
        if (floor) brightest = std::max(brightest, room.composed[i]);
    }
    return brightest > 0.0f && brightest <= 1.0f;
}

} // namespace

int main(int count, char** arguments) {
    auto isa = cpu::isaFromName(count > 1 ? arguments[1] : "automatic");
    if (!isa) return fail(isa.error().message);
    cpu::DeviceOptions options;
    options.isa = *isa;
    options.moreKernels = {cpu::consumerKernels};
    auto device = cpu::Device::create(options);
    if (!device) return fail(device.error().message) + 1;

    Room room;
    if (auto lit = light(room, *device); !lit) return fail(lit.error().message);
    if (!isPlausible(room))
        return fail("the floor's light is not finite, or is zero or brighter than the wall");
    auto half = halve(room.composed, *device);
    if (!half) return fail(half.error().message);
    for (size_t i = 0; i < half->size(); ++i)
        if ((*half)[i] != 0.5f * room.composed[i]) return fail("the consumer's own kernel does not halve");
    if (techniqueShaders().empty() || consumerShaders().size() != 1) return fail("shaders are missing");
    std::printf("isa %s\n", cpu::name(device->isa()));
    return 0;
}
