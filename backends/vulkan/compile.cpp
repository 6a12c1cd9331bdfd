// SPDX-License-Identifier: MIT
// From a plan to what record() needs.
#include "device_state.hpp"

#include "rebound/detail/shader_check.hpp"

#include <algorithm>
#include <cstring>

namespace rebound::vulkan {
namespace {

using State = Program::State;

Result<> checkLimits(const Device::Shared& d, const Plan& plan) {
    for (const Resource& r : plan.resources) {
        const std::string what = "plan.resources: " + r.name;
        const uint32_t side = uint32_t(std::max(r.extent.width, r.extent.height));
        if (isImage(r.kind) && side > d.limits.maxImageDimension2D)
            return Error{ErrorCode::unsupported,
                         what + " is " + detail::toText(r.extent) + "; this device's images have at most " +
                             std::to_string(d.limits.maxImageDimension2D) + " texels a side"};
        const bool isConstants = r.kind == ResourceKind::frameConstants || r.kind == ResourceKind::frameState;
        if (!isImage(r.kind) && !isConstants && r.size > d.limits.maxStorageBufferRange)
            return Error{ErrorCode::unsupported, what + " has " + std::to_string(r.size) +
                                                     " bytes; this device's storage buffers have at most " +
                                                     std::to_string(d.limits.maxStorageBufferRange)};
        if (isConstants && r.size > d.limits.maxUniformBufferRange)
            return Error{ErrorCode::unsupported, what + " has " + std::to_string(r.size) +
                                                     " bytes; this device's constants have at most " +
                                                     std::to_string(d.limits.maxUniformBufferRange)};
    }
    return {};
}

Result<> checkPlan(const Device::Shared& d, const Plan& plan, const CompileOptions& options) {
    if (auto valid = validate(plan); !valid) return valid;
    if (options.framesInFlight < 1 || options.framesInFlight > 8)
        return invalidArgument("framesInFlight is " + std::to_string(options.framesInFlight) +
                               "; 1 to 8 was expected");
    if (auto valid = checkLimits(d, plan); !valid) return valid;
    for (const Pass& pass : plan.passes) {
        const Shader* shader = detail::findShader(d.shaders, pass.kernel);
        if (!shader) return detail::unknownKernel(pass);
        if (auto valid = detail::checkShaderUse(plan, pass, *shader); !valid) return valid;
    }
    return {};
}

Result<> bindTransients(State& s, const State* sharing) {
    const Device::Shared& d = *s.device;
    const VkMemoryRequirements& block = s.transients.block;
    if (block.size == 0) return {};
    if (sharing) {
        s.transientMemory = sharing->transientMemory;
        if (!s.transientMemory || s.transientMemory->size < block.size ||
            !(block.memoryTypeBits >> s.transientMemory->block.memoryType & 1u) ||
            s.transientMemory->block.offset % block.alignment != 0)
            return invalidArgument("shareTransientsWith has " +
                                   std::to_string(s.transientMemory ? s.transientMemory->size : 0) +
                                   " bytes of transients; " + std::to_string(block.size) +
                                   " of a memory type and an alignment that suit were expected");
    } else {
        auto memory = allocateMemory(s.device, {block, false});
        if (!memory) return memory.error();
        s.transientMemory = *std::move(memory);
    }
    for (size_t i = 0; i < s.plan.resources.size(); ++i) {
        const Resource& r = s.plan.resources[i];
        const VkDeviceSize offset = s.transients.layout.offsets[i];
        if (OwnImage& own = s.transients.images[i]; own.image)
            if (auto bound = bindImage(d, r, *s.transientMemory, offset, own); !bound) return bound;
        if (const OwnBuffer& own = s.transients.buffers[i]; own.buffer)
            if (auto bound = bindBuffer(d, r.name, *s.transientMemory, offset, own); !bound) return bound;
    }
    return {};
}

Result<> bindPersistent(State& s) {
    Persistent& p = s.persistent;
    if (p.block.size == 0) return {};
    auto memory = allocateMemory(s.device, {p.block, false});
    if (!memory) return memory.error();
    s.persistentMemory = *std::move(memory);
    for (size_t i = 0; i < s.plan.resources.size(); ++i) {
        const Resource& r = s.plan.resources[i];
        for (size_t k = 0; k < 2; ++k)
            if (OwnImage& own = p.images[i][k]; own.image)
                if (auto bound = bindImage(*s.device, r, *s.persistentMemory, p.offsets[i][k], own); !bound)
                    return bound;
        if (const OwnBuffer& own = p.buffers[i]; own.buffer)
            if (auto bound = bindBuffer(*s.device, r.name, *s.persistentMemory, p.offsets[i][0], own); !bound)
                return bound;
    }
    return {};
}

Result<> createTables(State& s) {
    const Device::Shared& d = *s.device;
    if (s.bufferLayout.size == 0) return {};
    auto info = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = s.bufferLayout.size;
    info.usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    if (auto made = d.check(d.vk.CreateBuffer(d.device, &info, nullptr, &s.buffer), "creating a buffer");
        !made)
        return made;
    d.setName(VK_OBJECT_TYPE_BUFFER, handleBits(s.buffer), s.plan.technique + " buffers");
    MemoryRequest request;
    request.hostVisible = true;
    d.vk.GetBufferMemoryRequirements(d.device, s.buffer, &request.requirements);
    auto memory = allocateMemory(s.device, request);
    if (!memory) return memory.error();
    s.bufferMemory = *std::move(memory);
    s.use.buffers = size_t(request.requirements.size);
    for (size_t i = 0; i < s.plan.resources.size(); ++i)
        if (const Resource& r = s.plan.resources[i]; r.kind == ResourceKind::buffer)
            std::memcpy(static_cast<std::byte*>(s.bufferMemory->block.mapped) + s.bufferLayout.offsets[i],
                        r.data->data(), r.size);
    return d.check(
        d.vk.BindBufferMemory(d.device, s.buffer, s.bufferMemory->block.memory, s.bufferMemory->block.offset),
        "binding memory to a buffer");
}

// What record() binds: the host's, and of history one of two images.
bool changesEachFrame(ResourceKind kind) {
    return isHostImage(kind) || isHostBuffer(kind) || kind == ResourceKind::history;
}

Result<> compilePasses(State& s) {
    for (const Pass& pass : s.plan.passes) {
        const Shader& shader = *detail::findShader(s.device->shaders, pass.kernel);
        CompiledPass compiled;
        auto kernel = obtainKernel(*s.device, shader);
        if (!kernel) return kernel.error();
        compiled.kernel = *kernel;
        auto pipeline = obtainPipeline(*s.device, shader, pass.features);
        if (!pipeline) return pipeline.error();
        compiled.pipeline = *pipeline;
        compiled.groups = groupCounts(pass);
        for (const PassBinding& b : pass.bindings) {
            const ResourceKind kind = s.plan.resources[size_t(b.resource)].kind;
            if (changesEachFrame(kind)) compiled.perFrame.push_back(b);
        }
        s.passes.push_back(std::move(compiled));
    }
    schedulePasses(s.plan, s.transients, s.device->timestampBits > 0, s.passes);
    return {};
}

Result<> allocateSets(State& s) {
    const Device::Shared& d = *s.device;
    const uint32_t setCount = uint32_t(s.plan.passes.size()) * uint32_t(s.framesInFlight);
    if (setCount == 0) return {};
    uint32_t bindings = 0;
    for (const Pass& pass : s.plan.passes) bindings += uint32_t(pass.bindings.size());
    bindings = std::max(1u, bindings * uint32_t(s.framesInFlight));
    // At most so many of each kind: kinds are few, and descriptors small.
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, bindings},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, bindings},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, bindings},
                                          {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, bindings}};
    auto pool = structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    pool.maxSets = setCount;
    pool.poolSizeCount = uint32_t(std::size(sizes));
    pool.pPoolSizes = sizes;
    if (auto made = d.check(d.vk.CreateDescriptorPool(d.device, &pool, nullptr, &s.descriptorPool),
                            "creating a descriptor pool");
        !made)
        return made;
    std::vector<VkDescriptorSetLayout> layouts;
    for (int frame = 0; frame < s.framesInFlight; ++frame)
        for (const CompiledPass& pass : s.passes) layouts.push_back(pass.kernel->setLayout);
    s.sets.resize(setCount);
    auto info = structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    info.descriptorPool = s.descriptorPool;
    info.descriptorSetCount = setCount;
    info.pSetLayouts = layouts.data();
    return d.check(d.vk.AllocateDescriptorSets(d.device, &info, s.sets.data()), "allocating descriptor sets");
}

// Everything but what changes from frame to frame.
void writeSet(const State& s, int frame, size_t passIndex) {
    const Pass& pass = s.plan.passes[passIndex];
    const Shader& shader = *detail::findShader(s.device->shaders, pass.kernel);
    std::vector<VkDescriptorImageInfo> images(pass.bindings.size());
    std::vector<VkDescriptorBufferInfo> buffers(pass.bindings.size());
    std::vector<VkWriteDescriptorSet> writes;
    for (size_t i = 0; i < pass.bindings.size(); ++i) {
        const PassBinding& b = pass.bindings[i];
        const Resource& r = s.plan.resources[size_t(b.resource)];
        if (changesEachFrame(r.kind)) continue;
        auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        write.dstSet = s.sets[size_t(frame) * s.passes.size() + passIndex];
        write.dstBinding = uint32_t(b.slot);
        write.descriptorCount = 1;
        write.descriptorType = descriptorType(shader.info.kinds[b.slot]);
        if (r.kind == ResourceKind::transient) {
            images[i] = {VK_NULL_HANDLE, s.transients.images[size_t(b.resource)].view,
                         VK_IMAGE_LAYOUT_GENERAL};
            write.pImageInfo = &images[i];
        } else if (isTransient(r.kind) || isPersistent(r.kind)) {
            const auto& own = isTransient(r.kind) ? s.transients.buffers : s.persistent.buffers;
            buffers[i] = {own[size_t(b.resource)].buffer, 0, r.size};
            write.pBufferInfo = &buffers[i];
        } else {
            VkDeviceSize offset = s.bufferLayout.offsets[size_t(b.resource)];
            if (r.kind != ResourceKind::buffer) offset += s.bufferLayout.frameStride * VkDeviceSize(frame);
            buffers[i] = {s.buffer, offset, r.size};
            write.pBufferInfo = &buffers[i];
        }
        writes.push_back(write);
    }
    s.device->vk.UpdateDescriptorSets(s.device->device, uint32_t(writes.size()), writes.data(), 0, nullptr);
}

Result<> createQueries(State& s) {
    const Device::Shared& d = *s.device;
    if (d.timestampBits == 0 || s.passes.empty()) return {};
    auto info = structure<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = uint32_t(s.passes.size() + 1) * uint32_t(s.framesInFlight);
    return d.check(d.vk.CreateQueryPool(d.device, &info, nullptr, &s.queries), "creating a query pool");
}

} // namespace

Program::State::~State() {
    if (!device) return;
    const Functions& vk = device->vk;
    if (queries) vk.DestroyQueryPool(device->device, queries, nullptr);
    if (descriptorPool) vk.DestroyDescriptorPool(device->device, descriptorPool, nullptr);
    if (buffer) vk.DestroyBuffer(device->device, buffer, nullptr);
    destroy(*device, transients);
    destroy(*device, persistent);
}

Result<MemoryUse> Device::memoryUse(const Plan& plan, const CompileOptions& options) const {
    if (auto present = shared->loss.check(); !present) return present.error();
    if (auto valid = checkPlan(*shared, plan, options); !valid) return valid.error();
    auto transients = createTransients(*shared, plan, options.inspectable);
    if (!transients) return transients.error();
    MemoryUse use;
    use.transient = options.shareTransientsWith ? 0 : transients->layout.size;
    use.transientUnshared = transients->layout.sizeUnshared;
    use.buffers = size_t(layoutBuffers(*shared, plan, options.framesInFlight).size);
    destroy(*shared, *transients);
    auto persistent = createPersistent(*shared, plan, options.inspectable);
    if (!persistent) return persistent.error();
    use.persistent = size_t(persistent->block.size);
    destroy(*shared, *persistent);
    return use;
}

Result<Program> Device::compile(const Plan& plan, const CompileOptions& options) const {
    if (auto present = shared->loss.check(); !present) return present.error();
    if (auto valid = checkPlan(*shared, plan, options); !valid) return valid.error();
    auto state = std::make_unique<Program::State>();
    state->device = shared;
    state->plan = plan;
    state->framesInFlight = options.framesInFlight;
    state->inspectable = options.inspectable;
    auto transients = createTransients(*shared, plan, options.inspectable);
    if (!transients) return transients.error();
    state->transients = *std::move(transients);
    state->use.transient = options.shareTransientsWith ? 0 : state->transients.layout.size;
    state->use.transientUnshared = state->transients.layout.sizeUnshared;
    const Program::State* sharing =
        options.shareTransientsWith ? options.shareTransientsWith->state.get() : nullptr;
    if (auto bound = bindTransients(*state, sharing); !bound) return bound.error();
    auto persistent = createPersistent(*shared, plan, options.inspectable);
    if (!persistent) return persistent.error();
    state->persistent = *std::move(persistent);
    state->use.persistent = size_t(state->persistent.block.size);
    if (auto bound = bindPersistent(*state); !bound) return bound.error();
    state->bufferLayout = layoutBuffers(*shared, plan, options.framesInFlight);
    if (auto made = createTables(*state); !made) return made.error();
    if (auto compiled = compilePasses(*state); !compiled) return compiled.error();
    if (auto allocated = allocateSets(*state); !allocated) return allocated.error();
    for (int frame = 0; frame < options.framesInFlight; ++frame)
        for (size_t pass = 0; pass < state->passes.size(); ++pass) writeSet(*state, frame, pass);
    if (auto made = createQueries(*state); !made) return made.error();
    return Program(std::move(state));
}

} // namespace rebound::vulkan
