// SPDX-License-Identifier: MIT
#include "program_state.hpp"

#include "rebound/detail/kernel_check.hpp"

#include <algorithm>
#include <cstring>
#include <new>

namespace rebound::cpu {

const KernelEntry* Device::Shared::findKernel(std::string_view name) const {
    for (const auto& table : kernels)
        for (const KernelEntry* entry : table)
            if (name == entry->name) return entry;
    return nullptr;
}

void AlignedMemory::Free::operator()(std::byte* p) const {
    ::operator delete[](p, std::align_val_t(memoryAlignment));
}

AlignedMemory AlignedMemory::allocate(size_t size) {
    return {std::unique_ptr<std::byte[], Free>(new (std::align_val_t(memoryAlignment), std::nothrow)
                                                   std::byte[size])};
}

namespace {

ptrdiff_t alignedRow(ptrdiff_t width) { return (width + rowAlignment - 1) / rowAlignment * rowAlignment; }

// Planes a multiple of 4096 bytes apart would have the channels of a texel compete for a few lines of the nearest cache.
ptrdiff_t apartInCache(ptrdiff_t stride) {
    constexpr ptrdiff_t step = 256,
                        rest = 96; // of four planes no two come nearer than 32, modulo 1024 [floats]
    return stride + (step + rest - stride % step) % step;
}

ImageLayout layoutOf(const Resource& r, bool isApart) {
    ImageLayout layout;
    layout.rowStride = alignedRow(r.extent.width + rowPadding);
    if (isApart) {
        layout.oddColumns = alignedRow((r.extent.width + 1) / 2 + apartPadding);
        layout.rowStride = 2 * layout.oddColumns;
    }
    layout.channelStride = apartInCache(layout.rowStride * r.extent.height + ptrdiff_t(2) * planeMargin);
    layout.size = size_t(layout.channelStride) * size_t(r.channels) * sizeof(float);
    return layout;
}

// In one block: what transients share, then tables, then what is kept from frame to frame.
struct MemoryPlan {
    std::vector<size_t> offsets; // by resource, in the block [bytes]
    MemoryUse use;
};

size_t aligned(size_t size) { return (size + memoryAlignment - 1) / memoryAlignment * memoryAlignment; }

size_t sizeInMemory(const Resource& r, bool isApart) {
    return isImage(r.kind) ? layoutOf(r, isApart).size : aligned(r.size);
}

// By resource: whether some kernel reads it by sparse pixels, so that its columns are kept apart.
std::vector<bool> findApart(const Plan& plan, const Device::Shared& device) {
    std::vector<bool> isApart(plan.resources.size());
    for (const Pass& pass : plan.passes)
        if (const KernelEntry* kernel = device.findKernel(pass.kernel))
            for (const PassBinding& b : pass.bindings)
                if ((kernel->info.sparse >> b.slot & 1) != 0) isApart[size_t(b.resource)] = true;
    return isApart;
}

MemoryPlan planMemory(const Plan& plan, const std::vector<bool>& isApart) {
    std::vector<size_t> sizes;
    for (size_t i = 0; i < plan.resources.size(); ++i)
        sizes.push_back(sizeInMemory(plan.resources[i], isApart[i]));
    MemoryPlan memory;
    const TransientLayout transients = layoutTransients(plan, sizes, memoryAlignment);
    memory.offsets = transients.offsets;
    memory.use.transient = transients.size;
    memory.use.transientUnshared = transients.sizeUnshared;
    const auto place = [&](size_t i, size_t size, size_t& used) {
        memory.offsets[i] = memory.use.total();
        used += size;
    };
    for (size_t i = 0; i < sizes.size(); ++i)
        if (plan.resources[i].kind == ResourceKind::buffer) place(i, sizes[i], memory.use.buffers);
    for (size_t i = 0; i < sizes.size(); ++i)
        if (isPersistent(plan.resources[i].kind))
            place(i, plan.resources[i].kind == ResourceKind::history ? 2 * sizes[i] : sizes[i],
                  memory.use.persistent);
    return memory;
}

bool isOwn(ResourceKind k) { return isTransient(k) || isPersistent(k) || k == ResourceKind::buffer; }

Binding bindingOf(const Resource& r, bool isApart, std::byte* memory) {
    Binding b;
    b.width = r.extent.width;
    b.height = r.extent.height;
    b.channels = r.channels;
    b.size = r.size;
    if (isOwn(r.kind)) b.data = memory;
    if (isOwn(r.kind) && isImage(r.kind)) {
        b.holdsHalves = r.format == Format::rgba16f;
        const ImageLayout layout = layoutOf(r, isApart);
        b.data = reinterpret_cast<float*>(memory) + planeMargin;
        b.pixelStride = sizeof(float);
        b.rowStride = layout.rowStride * ptrdiff_t(sizeof(float));
        b.channelStride = layout.channelStride * ptrdiff_t(sizeof(float));
        b.oddColumns = layout.oddColumns * ptrdiff_t(sizeof(float));
    }
    return b;
}

Result<CompiledPass> compilePass(const Plan& plan, const Pass& pass, const KernelEntry& kernel,
                                 const std::vector<Binding>& resources) {
    if (auto valid = detail::checkKernelUse(plan, pass, kernel.name, kernel.info); !valid)
        return valid.error();
    CompiledPass compiled;
    compiled.run = kernel.variants[detail::combinationOf(pass, kernel.info)];
    // Enough to hide a task's overhead of well under a microsecond; of large images rows enough to be read in one piece.
    constexpr int itemsPerTask = 256;
    if (pass.items > 0) {
        compiled.widthOrItems = compiled.count = pass.items;
        compiled.countPerTask = itemsPerTask;
    } else {
        compiled.widthOrItems = pass.grid.width;
        compiled.count = pass.grid.height;
        const int pixels = std::clamp(pass.grid.width * pass.grid.height / 64, 2048, 16384);
        compiled.countPerTask = std::max(1, pixels / pass.grid.width);
    }
    for (const PassBinding& binding : pass.bindings) {
        const Resource& r = plan.resources[size_t(binding.resource)];
        compiled.slots[size_t(binding.slot)] = resources[size_t(binding.resource)];
        compiled.slots[size_t(binding.slot)].kind = kernel.info.kinds[binding.slot];
        if (!isOwn(r.kind) || r.kind == ResourceKind::history) compiled.perFrame.push_back(binding);
        if (isOwn(r.kind) && isImage(r.kind) && binding.access == Access::write)
            compiled.cleared.push_back(binding.resource);
    }
    return compiled;
}

} // namespace

Result<Device> Device::create(const DeviceOptions& options) {
    if (options.threads < 0 || options.threads > 1024)
        return invalidArgument("threads is " + std::to_string(options.threads) +
                               "; 1 to 1024, or 0 for one a core, was expected");
    if (!isAvailable(options.isa))
        return Error{ErrorCode::unsupported,
                     std::string("isa is ") + name(options.isa) +
                         ", which this processor does not run or this build leaves out"};
    auto shared = std::make_shared<Shared>();
    shared->isa = options.isa == Isa::automatic ? availableIsas().back() : options.isa;
    shared->timings = options.timings;
    for (auto table : options.moreKernels) shared->kernels.push_back(table(shared->isa));
    shared->kernels.push_back(techniqueKernels(shared->isa));
    if (options.parallelFor) {
        shared->parallelFor = options.parallelFor;
    } else {
        shared->pool = std::make_unique<ThreadPool>(options.threads);
        shared->parallelFor = [pool = shared->pool.get()](int count, const std::function<void(int)>& body) {
            pool->run(count, body);
        };
    }
    Device device;
    device.shared = std::move(shared);
    return device;
}

Isa Device::isa() const { return shared->isa; }
int Device::threads() const { return shared->pool ? shared->pool->threadCount() : 0; }

Result<MemoryUse> Device::memoryUse(const Plan& plan) const {
    if (auto valid = validate(plan); !valid) return valid.error();
    return planMemory(plan, findApart(plan, *shared)).use;
}

Result<Buffer> Device::createBuffer(std::span<const std::byte> data) const {
    if (data.empty()) return invalidArgument("data is empty; at least one byte was expected");
    try {
        Buffer buffer;
        buffer.shared = std::make_shared<const std::vector<std::byte>>(data.begin(), data.end());
        buffer.data = const_cast<std::byte*>(buffer.shared->data());
        buffer.size = data.size();
        return buffer;
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "the buffer needs " + std::to_string(data.size()) +
                                                 " bytes, which could not be allocated"};
    }
}

Result<Program> Device::compile(const Plan& plan) const {
    if (auto valid = validate(plan); !valid) return valid.error();
    auto state = std::make_unique<Program::State>();
    const std::vector<bool> isApart = findApart(plan, *shared);
    const MemoryPlan memory = planMemory(plan, isApart);
    state->device = shared;
    state->plan = plan;
    state->use = memory.use;
    state->memory = AlignedMemory::allocate(std::max<size_t>(memory.use.total(), 1));
    if (!state->memory.bytes)
        return Error{ErrorCode::outOfMemory, "the plan needs " + std::to_string(memory.use.total()) +
                                                 " bytes, which could not be allocated"};
    std::byte* base = state->memory.bytes.get();
    state->persistent = base + memory.use.transient + memory.use.buffers;
    for (size_t i = 0; i < plan.resources.size(); ++i) {
        const Resource& r = plan.resources[i];
        std::byte* begin = base + memory.offsets[i];
        state->resources.push_back(bindingOf(r, isApart[i], begin));
        state->historyDistance.push_back(r.kind == ResourceKind::history ? sizeInMemory(r, isApart[i]) : 0);
        if (r.kind == ResourceKind::buffer) std::memcpy(begin, r.data->data(), r.size);
    }
    for (const Pass& pass : plan.passes) {
        const KernelEntry* kernel = shared->findKernel(pass.kernel);
        if (!kernel) return detail::unknownKernel(pass);
        auto compiled = compilePass(plan, pass, *kernel, state->resources);
        if (!compiled) return compiled.error();
        state->passes.push_back(std::move(*compiled));
    }
    return Program(std::move(state));
}

} // namespace rebound::cpu
