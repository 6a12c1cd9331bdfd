// SPDX-License-Identifier: MIT
#include "image_check.hpp"
#include "program_state.hpp"

#include <algorithm>
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

Result<> checkBuffer(const Resource& r, const Buffer& buffer) {
    const std::string what = "inputs.buffers: " + r.name;
    if (!buffer.data) return invalidArgument(what + " has no data");
    if (buffer.size < r.size) return detail::smallBuffer(r, buffer.size);
    if (reinterpret_cast<uintptr_t>(buffer.data) % 4 != 0)
        return invalidArgument(what + " is not aligned to 4 bytes");
    return {};
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
    const ptrdiff_t odd = image.oddColumns / ptrdiff_t(sizeof(float));
    for (int c = 0; c < image.channels; ++c)
        for (int y = yBegin; y < yEnd; ++y) {
            float* row = static_cast<float*>(image.data) + c * plane + y * stride;
            if (odd == 0) {
                clearFloats(row + image.width, stride - image.width);
            } else {
                const int evenCount = (image.width + 1) / 2, oddCount = image.width / 2;
                clearFloats(row + evenCount, odd - evenCount);
                clearFloats(row + odd + oddCount, stride - odd - oddCount);
            }
        }
}

Binding historyImage(const Program::State& s, ResourceIndex r, int image) {
    Binding b = s.resources[size_t(r)];
    b.data = static_cast<std::byte*>(b.data) + s.historyDistance[size_t(r)] * size_t(image);
    return b;
}

// An image of the device's own that the frame writes, or a buffer.
Binding current(const Program::State& s, ResourceIndex r) { return historyImage(s, r, s.historyWritten); }

using Inputs = detail::ResolvedInputs<Image>;

// What changes from frame to frame.
void complete(const Program::State& s, const CompiledPass& pass, const Inputs& inputs,
              const std::array<int32_t, 4>& frameState, std::array<Binding, slotCount>& slots) {
    for (const PassBinding& b : pass.perFrame) {
        Binding& slot = slots[size_t(b.slot)];
        const size_t r = size_t(b.resource);
        if (inputs.images[r]) {
            describe(slot, *inputs.images[r]);
        } else if (inputs.buffers[r]) {
            slot.data = inputs.buffers[r]->data; // as much of it as the plan knows
        } else if (inputs.constants[r]) {
            slot.data = const_cast<void*>(inputs.constants[r]);
        } else if (s.plan.resources[r].kind == ResourceKind::frameState) {
            slot.data = const_cast<int32_t*>(frameState.data());
        } else {
            const bool isPrevious = b.access == Access::readPrevious;
            slot.data =
                historyImage(s, b.resource, isPrevious ? 1 - s.historyWritten : s.historyWritten).data;
        }
    }
}

void runPass(const Program::State& s, const CompiledPass& pass, const std::array<Binding, slotCount>& slots) {
    std::vector<Binding> written;
    for (ResourceIndex r : pass.cleared) written.push_back(current(s, r));
    for (const Binding& image : written) clearMargins(image);
    const int tasks = (pass.count + pass.countPerTask - 1) / pass.countPerTask;
    s.device->parallelFor(tasks, [&](int task) {
        const int begin = task * pass.countPerTask, end = std::min(begin + pass.countPerTask, pass.count);
        pass.run(slots.data(), pass.widthOrItems, begin, end);
        for (const Binding& image : written) clearRowPadding(image, begin, end);
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

Result<std::vector<PassTiming>> Program::timings() const { return state->timings; }
void Program::reset() { state->frames.reset(); }
const Plan& Program::plan() const { return state->plan; }
MemoryUse Program::memoryUse() const { return state->use; }
void Program::onPass(std::function<void(int)> callback) { state->passCallback = std::move(callback); }

Result<> Program::record(const FrameInputs<Image>& inputs) {
    auto resolved = detail::resolveInputs(state->plan, inputs);
    if (!resolved) return resolved.error();
    if (auto valid = checkImages(state->plan, resolved->images); !valid) return valid.error();
    for (size_t i = 0; i < state->plan.resources.size(); ++i)
        if (const Buffer* buffer = resolved->buffers[i])
            if (auto valid = checkBuffer(state->plan.resources[i], *buffer); !valid) return valid.error();

    const std::array<int32_t, 4> frameState = state->frames.state();
    state->historyWritten = state->frames.written();
    if (state->frames.atStart() && state->use.persistent > 0)
        std::memset(state->persistent, 0, state->use.persistent);
    state->frames.advance();
    state->timings.clear();
    for (size_t i = 0; i < state->passes.size(); ++i) {
        const auto start = std::chrono::steady_clock::now();
        const CompiledPass& pass = state->passes[i];
        std::array<Binding, slotCount> slots = pass.slots;
        complete(*state, pass, *resolved, frameState, slots);
        runPass(*state, pass, slots);
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

Result<Binding> ownNamed(const Program::State& state, std::string_view name) {
    const int index = state.plan.find(name);
    if (index < 0 || !isWritable(state.plan.resources[size_t(index)].kind) ||
        !state.resources[size_t(index)].data)
        return Error{ErrorCode::notFound,
                     "the plan has no image or buffer of the device's own named " + std::string(name)};
    if (lifetimes(state.plan)[size_t(index)].last < 0)
        return Error{ErrorCode::notFound, "no pass of the plan uses " + std::string(name)};
    return current(state, index);
}

ptrdiff_t columnOffset(const Binding& b, int x) {
    if (b.oddColumns == 0) return x * b.pixelStride;
    return x / 2 * b.pixelStride + (x % 2 == 1 ? b.oddColumns : 0);
}

// Calls visit for each channel of each texel, or for all of a buffer, with its address and size.
template <class Visit>
void visitBytes(const Binding& b, Visit visit) {
    if (b.size > 0) visit(static_cast<char*>(b.data), b.size);
    else
        for (int y = 0; y < b.height; ++y)
            for (int x = 0; x < b.width; ++x)
                for (int c = 0; c < b.channels; ++c)
                    visit(static_cast<char*>(b.data) + c * b.channelStride + y * b.rowStride +
                              columnOffset(b, x),
                          sizeof(float));
}

size_t sizeOf(const Binding& b) {
    return b.size > 0 ? b.size : size_t(b.width) * size_t(b.height) * size_t(b.channels) * sizeof(float);
}

} // namespace

Result<std::vector<std::byte>> Program::read(std::string_view name) const {
    const auto binding = ownNamed(*state, name);
    if (!binding) return binding.error();
    std::vector<std::byte> bytes(sizeOf(*binding));
    std::byte* next = bytes.data();
    visitBytes(*binding, [&](const char* from, size_t size) {
        std::memcpy(next, from, size);
        next += size;
    });
    return bytes;
}

Result<> Program::write(std::string_view name, std::span<const std::byte> bytes) {
    const auto binding = ownNamed(*state, name);
    if (!binding) return binding.error();
    if (bytes.size() != sizeOf(*binding))
        return invalidArgument("bytes: " + std::string(name) + " takes " + std::to_string(sizeOf(*binding)) +
                               " bytes, not " + std::to_string(bytes.size()));
    const std::byte* next = bytes.data();
    visitBytes(*binding, [&](char* to, size_t size) {
        std::memcpy(to, next, size);
        next += size;
    });
    return {};
}

static_assert(ProgramDevice<Device, Program, Image>);

} // namespace rebound::cpu
