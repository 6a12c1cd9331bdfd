// SPDX-License-Identifier: MIT
#include "program_state.hpp"

#include "rebound/detail/kernel_check.hpp"

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

ImageLayout layoutOf(const Resource& r) {
    ImageLayout layout;
    layout.rowStride = (r.extent.width + rowPadding + rowAlignment - 1) / rowAlignment * rowAlignment;
    layout.channelStride = layout.rowStride * r.extent.height + 2 * planeMargin;
    layout.size = size_t(layout.channelStride) * size_t(r.channels) * sizeof(float);
    return layout;
}

namespace {

struct MemoryPlan {
    TransientLayout transients;
    std::vector<size_t> bufferOffsets; // by resource, behind the transients [bytes]
    MemoryUse use;
};

MemoryPlan planMemory(const Plan& plan) {
    std::vector<size_t> sizes;
    for (const Resource& r : plan.resources)
        sizes.push_back(r.kind == ResourceKind::transient ? layoutOf(r).size : 0);
    MemoryPlan memory;
    memory.transients = layoutTransients(plan, sizes, memoryAlignment);
    memory.use.transient = memory.transients.size;
    memory.use.transientUnshared = memory.transients.sizeUnshared;
    for (const Resource& r : plan.resources) {
        memory.bufferOffsets.push_back(memory.use.transient + memory.use.buffers);
        if (r.kind == ResourceKind::buffer)
            memory.use.buffers += (r.size + memoryAlignment - 1) / memoryAlignment * memoryAlignment;
    }
    return memory;
}

Binding bindingOf(const Resource& r, std::byte* transient, std::byte* buffer) {
    Binding b;
    b.width = r.extent.width;
    b.height = r.extent.height;
    b.channels = r.channels;
    if (r.kind == ResourceKind::transient) {
        b.holdsHalves = r.format == Format::rgba16f;
        const ImageLayout layout = layoutOf(r);
        b.data = reinterpret_cast<float*>(transient) + planeMargin;
        b.pixelStride = sizeof(float);
        b.rowStride = layout.rowStride * ptrdiff_t(sizeof(float));
        b.channelStride = layout.channelStride * ptrdiff_t(sizeof(float));
    } else if (r.kind == ResourceKind::buffer) {
        b.data = buffer;
    }
    return b;
}

RunRows variantOf(const KernelEntry& kernel, const Pass& pass) {
    int index = 0, stride = 1;
    for (size_t i = 0; i < pass.features.size(); ++i) {
        index += stride * pass.features[i];
        stride *= kernel.info.featureCounts[i];
    }
    return kernel.variants[index];
}

Result<CompiledPass> compilePass(const Plan& plan, const Pass& pass, const KernelEntry& kernel,
                                 const std::vector<Binding>& resources) {
    if (auto valid = detail::checkKernelUse(plan, pass, kernel.name, kernel.info); !valid)
        return valid.error();
    CompiledPass compiled;
    compiled.run = variantOf(kernel, pass);
    compiled.grid = pass.grid;
    constexpr int pixelsPerTask = 2048; // enough to hide a task's overhead of well under a microsecond
    compiled.rowsPerTask = std::max(1, pixelsPerTask / pass.grid.width);
    for (const PassBinding& binding : pass.bindings) {
        const Resource& r = plan.resources[size_t(binding.resource)];
        compiled.slots[size_t(binding.slot)] = resources[size_t(binding.resource)];
        compiled.slots[size_t(binding.slot)].kind = kernel.info.kinds[binding.slot];
        if (r.kind != ResourceKind::transient && r.kind != ResourceKind::buffer)
            compiled.external.push_back(binding);
        if (r.kind == ResourceKind::transient && binding.access == Access::write)
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

MemoryUse Device::memoryUse(const Plan& plan) const {
    return validate(plan) ? planMemory(plan).use : MemoryUse{};
}

Result<Program> Device::compile(const Plan& plan) const {
    if (auto valid = validate(plan); !valid) return valid.error();
    auto state = std::make_unique<Program::State>();
    const MemoryPlan memory = planMemory(plan);
    state->device = shared;
    state->plan = plan;
    state->use = memory.use;
    state->memory = AlignedMemory::allocate(std::max<size_t>(memory.use.total(), 1));
    if (!state->memory.bytes)
        return Error{ErrorCode::outOfMemory, "the plan needs " + std::to_string(memory.use.total()) +
                                                 " bytes, which could not be allocated"};
    std::byte* base = state->memory.bytes.get();
    for (size_t i = 0; i < plan.resources.size(); ++i) {
        const Resource& r = plan.resources[i];
        std::byte* buffer = base + memory.bufferOffsets[i];
        state->resources.push_back(bindingOf(r, base + memory.transients.offsets[i], buffer));
        if (r.kind == ResourceKind::buffer) std::memcpy(buffer, r.data.data(), r.size);
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
