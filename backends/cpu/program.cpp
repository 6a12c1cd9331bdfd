// SPDX-License-Identifier: MIT
#include "image_check.hpp"
#include "program_state.hpp"

#include <chrono>
#include <cstring>

namespace rebound::cpu {
namespace {

Image packedImage(void* data, Extent2D extent, int channels, Scalar scalar) {
    Image image;
    image.data = data;
    image.extent = extent;
    image.channels = channels;
    image.scalar = scalar;
    return image;
}

void describe(Binding& slot, const Image& image) {
    slot.data = image.data;
    slot.isHalf = image.scalar == Scalar::float16;
    slot.channels = image.channels;
    slot.pixelStride = image.pixelStride;
    slot.rowStride = image.rowStride;
    slot.channelStride = image.channelStride;
}

void clearFloats(float* from, ptrdiff_t count) { std::memset(from, 0, size_t(count) * sizeof(float)); }

// Lanes that straddle an image's sides read the padding, and memory is shared: so it is zeroed by whoever writes.
void clearMargins(const Binding& image) {
    const ptrdiff_t plane = image.channelStride / ptrdiff_t(sizeof(float));
    const ptrdiff_t rows = image.rowStride / ptrdiff_t(sizeof(float)) * image.height;
    for (int c = 0; c < image.channels; ++c) {
        float* first = static_cast<float*>(image.data) + c * plane;
        clearFloats(first - planeMargin, planeMargin);
        clearFloats(first + rows, planeMargin);
    }
}

void clearRowPadding(const Binding& image, int yBegin, int yEnd) {
    const ptrdiff_t stride = image.rowStride / ptrdiff_t(sizeof(float));
    const ptrdiff_t plane = image.channelStride / ptrdiff_t(sizeof(float));
    for (int c = 0; c < image.channels; ++c)
        for (int y = yBegin; y < yEnd; ++y)
            clearFloats(static_cast<float*>(image.data) + c * plane + y * stride + image.width,
                        stride - image.width);
}

void runPass(const CompiledPass& pass, const std::array<Binding, slotCount>& slots,
             const std::vector<Binding>& resources, const ParallelFor& parallelFor) {
    for (ResourceIndex r : pass.cleared) clearMargins(resources[size_t(r)]);
    const int tasks = (pass.grid.height + pass.rowsPerTask - 1) / pass.rowsPerTask;
    parallelFor(tasks, [&](int task) {
        const int yBegin = task * pass.rowsPerTask,
                  yEnd = std::min(yBegin + pass.rowsPerTask, pass.grid.height);
        pass.run(slots.data(), pass.grid.width, yBegin, yEnd);
        for (ResourceIndex r : pass.cleared) clearRowPadding(resources[size_t(r)], yBegin, yEnd);
    });
}

} // namespace

Image interleavedImage(void* data, Extent2D extent, int channels, Scalar scalar) {
    Image image = packedImage(data, extent, channels, scalar);
    image.channelStride = sizeOf(scalar);
    image.pixelStride = image.channelStride * channels;
    image.rowStride = image.pixelStride * extent.width;
    return image;
}

Image planarImage(void* data, Extent2D extent, int channels, Scalar scalar) {
    Image image = packedImage(data, extent, channels, scalar);
    image.pixelStride = sizeOf(scalar);
    image.rowStride = image.pixelStride * extent.width;
    image.channelStride = image.rowStride * extent.height;
    return image;
}

Program::Program(std::unique_ptr<State> s) : state(std::move(s)) {}
Program::~Program() = default;
Program::Program(Program&&) noexcept = default;
Program& Program::operator=(Program&&) noexcept = default;

const std::vector<PassTiming>& Program::timings() const { return state->timings; }
const Plan& Program::plan() const { return state->plan; }
MemoryUse Program::memoryUse() const { return state->use; }
void Program::onPass(std::function<void(int)> callback) { state->passCallback = std::move(callback); }

Result<> Program::record(const FrameInputs<Image>& inputs) {
    auto resolved = detail::resolveInputs(state->plan, inputs);
    if (!resolved) return resolved.error();
    if (auto valid = checkImages(state->plan, resolved->images); !valid) return valid.error();

    state->timings.clear();
    for (size_t i = 0; i < state->passes.size(); ++i) {
        const auto start = std::chrono::steady_clock::now();
        const CompiledPass& pass = state->passes[i];
        std::array<Binding, slotCount> slots = pass.slots;
        for (const PassBinding& b : pass.external) {
            Binding& slot = slots[size_t(b.slot)];
            if (const Image* image = resolved->images[size_t(b.resource)]) describe(slot, *image);
            else slot.data = const_cast<void*>(resolved->constants[size_t(b.resource)]);
        }
        runPass(pass, slots, state->resources, state->device->parallelFor);
        if (state->device->timings) {
            const std::chrono::duration<double, std::milli> elapsed =
                std::chrono::steady_clock::now() - start;
            state->timings.push_back({state->plan.passes[i].label, elapsed.count()});
        }
        if (state->passCallback) state->passCallback(int(i));
    }
    return {};
}

namespace {

Result<Binding> transientNamed(const Program::State& state, std::string_view name) {
    const int index = state.plan.find(name);
    if (index < 0 || state.plan.resources[size_t(index)].kind != ResourceKind::transient)
        return Error{ErrorCode::notFound, "the plan has no transient named " + std::string(name)};
    if (lifetimes(state.plan)[size_t(index)].last < 0)
        return Error{ErrorCode::notFound, "no pass of the plan uses the transient " + std::string(name)};
    return state.resources[size_t(index)];
}

// Calls visit for each channel of each texel, with its address.
template <class Visit>
void visitTexels(const Binding& b, Visit visit) {
    for (int y = 0; y < b.height; ++y)
        for (int x = 0; x < b.width; ++x)
            for (int c = 0; c < b.channels; ++c)
                visit(static_cast<char*>(b.data) + c * b.channelStride + y * b.rowStride + x * b.pixelStride);
}

} // namespace

Result<std::vector<float>> Program::readTransient(std::string_view name) const {
    const auto binding = transientNamed(*state, name);
    if (!binding) return binding.error();
    std::vector<float> texels(size_t(binding->width) * size_t(binding->height) * size_t(binding->channels));
    size_t next = 0;
    visitTexels(*binding, [&](const char* texel) { std::memcpy(&texels[next++], texel, sizeof(float)); });
    return texels;
}

Result<> Program::writeTransient(std::string_view name, std::span<const float> texels) {
    const auto binding = transientNamed(*state, name);
    if (!binding) return binding.error();
    const size_t count = size_t(binding->width) * size_t(binding->height) * size_t(binding->channels);
    if (texels.size() != count)
        return invalidArgument("texels: " + std::string(name) + " takes " + std::to_string(count) +
                               " floats, not " + std::to_string(texels.size()));
    size_t next = 0;
    visitTexels(*binding, [&](char* texel) { std::memcpy(texel, &texels[next++], sizeof(float)); });
    return {};
}

} // namespace rebound::cpu
