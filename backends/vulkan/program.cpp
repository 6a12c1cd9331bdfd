// SPDX-License-Identifier: MIT
#include "device_state.hpp"

#include <cstring>
#include <string>

namespace rebound::vulkan {
namespace {

using State = Program::State;
using Inputs = detail::ResolvedInputs<Image>;

Result<> checkFrame(const State& s, int frame) {
    if (frame < 0 || frame >= s.framesInFlight)
        return invalidArgument("frame is " + std::to_string(frame) + "; 0 to " +
                               std::to_string(s.framesInFlight - 1) + " was expected");
    return {};
}

bool isReadable(VkImageLayout layout) {
    switch (layout) {
    case VK_IMAGE_LAYOUT_UNDEFINED:
    case VK_IMAGE_LAYOUT_PREINITIALIZED:
    case VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL:
    case VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL:
    case VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL:
    case VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL:
        return false;
    default:
        return true;
    }
}

Result<> checkImage(const Resource& r, const Image& image) {
    const std::string what = "inputs.images: " + r.name;
    if (!image.view) return invalidArgument(what + " has no view");
    if (image.extent != r.extent)
        return invalidArgument(what + " is " + detail::toText(image.extent) + "; " +
                               detail::toText(r.extent) + " was expected");
    if (r.kind == ResourceKind::output) {
        if (image.format != vulkanFormat(r.format))
            return invalidArgument(what + " has VkFormat " + std::to_string(int(image.format)) + "; " +
                                   std::to_string(int(vulkanFormat(r.format))) + ", " + name(r.format) +
                                   ", was expected");
        if (image.layout != VK_IMAGE_LAYOUT_GENERAL)
            return invalidArgument(what + " has VkImageLayout " + std::to_string(int(image.layout)) +
                                   "; VK_IMAGE_LAYOUT_GENERAL was expected");
    } else if (!isReadable(image.layout)) {
        return invalidArgument(what + " has VkImageLayout " + std::to_string(int(image.layout)) +
                               "; one in which shaders read was expected");
    }
    return {};
}

Result<> checkBuffer(const State& s, const Resource& r, const Buffer& buffer) {
    const std::string what = "inputs.buffers: " + r.name;
    if (!buffer.buffer) return invalidArgument(what + " has no buffer");
    if (buffer.size < r.size) return detail::smallBuffer(r, size_t(buffer.size));
    const VkDeviceSize alignment = s.device->limits.minStorageBufferOffsetAlignment;
    if (buffer.offset % alignment != 0)
        return invalidArgument(what + " has the offset " + std::to_string(buffer.offset) +
                               "; a multiple of " + std::to_string(alignment) + " was expected");
    return {};
}

// What passes write is no other image of the frame.
Result<> checkAlone(const Plan& plan, size_t output, const std::vector<const Image*>& images) {
    for (size_t i = 0; i < images.size(); ++i)
        if (i != output && images[i] && images[i]->view == images[output]->view)
            return invalidArgument("inputs.images: " + plan.resources[output].name + " and " +
                                   plan.resources[i].name +
                                   " have one view; an output of its own was expected");
    return {};
}

Result<> checkInputs(const State& s, const Inputs& inputs) {
    for (size_t i = 0; i < s.plan.resources.size(); ++i) {
        const Resource& r = s.plan.resources[i];
        if (const Image* image = inputs.images[i])
            if (auto valid = checkImage(r, *image); !valid) return valid;
        if (const Buffer* buffer = inputs.buffers[i])
            if (auto valid = checkBuffer(s, r, *buffer); !valid) return valid;
    }
    for (size_t i = 0; i < s.plan.resources.size(); ++i)
        if (s.plan.resources[i].kind == ResourceKind::output)
            if (auto alone = checkAlone(s.plan, i, inputs.images); !alone) return alone;
    return {};
}

const OwnImage& historyImage(const State& s, ResourceIndex r, bool isPrevious) {
    return s.persistent.images[size_t(r)][size_t(isPrevious ? 1 - s.historyWritten : s.historyWritten)];
}

// What is the host's, and history.
void writePerFrame(const State& s, int frame, const Inputs& inputs) {
    size_t count = 0;
    for (const CompiledPass& pass : s.passes) count += pass.perFrame.size();
    std::vector<VkDescriptorImageInfo> images;
    std::vector<VkDescriptorBufferInfo> buffers;
    std::vector<VkWriteDescriptorSet> writes;
    images.reserve(count); // writes point into them
    buffers.reserve(count);
    writes.reserve(count);
    for (size_t i = 0; i < s.passes.size(); ++i)
        for (const PassBinding& b : s.passes[i].perFrame) {
            const bool isWritten = b.access == Access::write;
            auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
            write.dstSet = s.sets[size_t(frame) * s.passes.size() + i];
            write.dstBinding = uint32_t(b.slot);
            write.descriptorCount = 1;
            if (const Buffer* buffer = inputs.buffers[size_t(b.resource)]) {
                buffers.push_back(
                    {buffer->buffer, buffer->offset, s.plan.resources[size_t(b.resource)].size});
                write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
                write.pBufferInfo = &buffers.back();
            } else {
                if (const Image* image = inputs.images[size_t(b.resource)])
                    images.push_back({VK_NULL_HANDLE, image->view, image->layout});
                else
                    images.push_back({VK_NULL_HANDLE,
                                      historyImage(s, b.resource, b.access == Access::readPrevious).view,
                                      VK_IMAGE_LAYOUT_GENERAL});
                write.descriptorType =
                    isWritten ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
                write.pImageInfo = &images.back();
            }
            writes.push_back(write);
        }
    s.device->vk.UpdateDescriptorSets(s.device->device, uint32_t(writes.size()), writes.data(), 0, nullptr);
}

void writeConstants(const State& s, int frame, const Inputs& inputs) {
    const std::array<int32_t, 4> frameState = s.frames.state();
    for (size_t i = 0; i < s.plan.resources.size(); ++i) {
        const Resource& r = s.plan.resources[i];
        const void* from = r.kind == ResourceKind::frameState ? frameState.data() : inputs.constants[i];
        if (from)
            std::memcpy(static_cast<std::byte*>(s.bufferMemory->block.mapped) + s.bufferLayout.offsets[i] +
                            s.bufferLayout.frameStride * VkDeviceSize(frame),
                        from, r.size);
    }
}

void recordMemoryBarrier(const State& s, VkCommandBuffer commands, VkPipelineStageFlags from,
                         VkAccessFlags written, VkPipelineStageFlags to, VkAccessFlags used,
                         const std::vector<VkImageMemoryBarrier>& images) {
    auto memory = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    memory.srcAccessMask = written;
    memory.dstAccessMask = used;
    s.device->vk.CmdPipelineBarrier(commands, from, to, 0, 1, &memory, 0, nullptr, uint32_t(images.size()),
                                    images.data());
}

// An image's contents are given up.
VkImageMemoryBarrier beginning(VkImage image, VkAccessFlags used) {
    auto b = structure<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
    b.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    b.dstAccessMask = used;
    b.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    b.newLayout = VK_IMAGE_LAYOUT_GENERAL;
    b.srcQueueFamilyIndex = b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    b.image = image;
    b.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    return b;
}

constexpr VkAccessFlags shaderAccess = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;

// History and persistent buffers, before a first frame.
void recordClear(const State& s, VkCommandBuffer commands) {
    if (s.persistent.block.size == 0) return;
    const Functions& vk = s.device->vk;
    std::vector<VkImageMemoryBarrier> beginnings;
    for (const auto& pair : s.persistent.images)
        for (const OwnImage& own : pair)
            if (own.image) beginnings.push_back(beginning(own.image, VK_ACCESS_TRANSFER_WRITE_BIT));
    recordMemoryBarrier(s, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                        VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, beginnings);
    const VkClearColorValue zeros{};
    for (const VkImageMemoryBarrier& b : beginnings)
        vk.CmdClearColorImage(commands, b.image, VK_IMAGE_LAYOUT_GENERAL, &zeros, 1, &b.subresourceRange);
    for (const OwnBuffer& own : s.persistent.buffers)
        if (own.buffer) vk.CmdFillBuffer(commands, own.buffer, 0, VK_WHOLE_SIZE, 0);
    recordMemoryBarrier(s, commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                        VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, shaderAccess, {});
}

// Makes what earlier passes wrote visible, and gives up the contents of transients that begin their lives.
void recordBarrier(const State& s, VkCommandBuffer commands, const CompiledPass& pass) {
    std::vector<VkImageMemoryBarrier> beginnings;
    for (ResourceIndex r : pass.beginning)
        beginnings.push_back(beginning(s.transients.images[size_t(r)].image, shaderAccess));
    recordMemoryBarrier(s, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                        VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, shaderAccess, beginnings);
}

void recordPass(const State& s, VkCommandBuffer commands, int frame, size_t index) {
    const Functions& vk = s.device->vk;
    const CompiledPass& pass = s.passes[index];
    if (vk.CmdBeginDebugUtilsLabelEXT) {
        auto label = structure<VkDebugUtilsLabelEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT);
        label.pLabelName = s.plan.passes[index].label.c_str();
        vk.CmdBeginDebugUtilsLabelEXT(commands, &label);
    }
    if (pass.barrier) recordBarrier(s, commands, pass);
    vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.pipeline);
    vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.kernel->layout, 0, 1,
                             &s.sets[size_t(frame) * s.passes.size() + index], 0, nullptr);
    vk.CmdDispatch(commands, pass.groups.x, pass.groups.y, 1);
    if (vk.CmdEndDebugUtilsLabelEXT) vk.CmdEndDebugUtilsLabelEXT(commands);
    if (s.passCallback) s.passCallback(commands, int(index));
}

} // namespace

Program::Program(std::unique_ptr<State> s) : state(std::move(s)) {}
Program::~Program() = default;
Program::Program(Program&&) noexcept = default;
Program& Program::operator=(Program&&) noexcept = default;

const Plan& Program::plan() const { return state->plan; }
MemoryUse Program::memoryUse() const { return state->use; }
void Program::onPass(std::function<void(VkCommandBuffer, int)> callback) {
    state->passCallback = std::move(callback);
}

Result<> Program::record(VkCommandBuffer commands, int frame, const FrameInputs<Image>& inputs) {
    State& s = *state;
    if (auto present = s.device->loss.check(); !present) return present;
    if (!commands) return invalidArgument("commands is null");
    if (auto valid = checkFrame(s, frame); !valid) return valid;
    auto resolved = detail::resolveInputs(s.plan, inputs);
    if (!resolved) return resolved.error();
    if (auto valid = checkInputs(s, *resolved); !valid) return valid;

    s.historyWritten = s.frames.written();
    writePerFrame(s, frame, *resolved);
    writeConstants(s, frame, *resolved);
    if (s.frames.atStart()) recordClear(s, commands);
    s.frames.advance();
    const Functions& vk = s.device->vk;
    const uint32_t firstQuery = uint32_t(frame) * uint32_t(s.passes.size() + 1);
    if (s.queries) {
        vk.CmdResetQueryPool(commands, s.queries, firstQuery, uint32_t(s.passes.size() + 1));
        vk.CmdWriteTimestamp(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, s.queries, firstQuery);
        std::erase(s.measured, frame);
        s.measured.push_back(frame);
    }
    for (size_t i = 0; i < s.passes.size(); ++i) {
        recordPass(s, commands, frame, i);
        if (s.queries)
            vk.CmdWriteTimestamp(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, s.queries,
                                 firstQuery + uint32_t(i) + 1);
    }
    return {};
}

void Program::reset() { state->frames.reset(); }

Result<std::vector<PassTiming>> Program::timings() const {
    const State& s = *state;
    if (auto present = s.device->loss.check(); !present) return present.error();
    const uint32_t count = uint32_t(s.passes.size() + 1);
    std::vector<uint64_t> ticks(count);
    std::vector<PassTiming> timings;
    for (auto frame = s.measured.rbegin(); frame != s.measured.rend(); ++frame) {
        const VkResult result = s.device->vk.GetQueryPoolResults(
            s.device->device, s.queries, uint32_t(*frame) * count, count, count * sizeof(uint64_t),
            ticks.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT);
        if (result == VK_NOT_READY) continue;
        if (auto read = s.device->check(result, "reading timestamps"); !read) return read.error();
        const uint64_t mask =
            s.device->timestampBits >= 64 ? ~uint64_t(0) : (uint64_t(1) << s.device->timestampBits) - 1;
        const double millisecondsPerTick = double(s.device->limits.timestampPeriod) * 1e-6;
        for (size_t i = 0; i < s.passes.size(); ++i)
            timings.push_back(
                {s.plan.passes[i].label, double((ticks[i + 1] - ticks[i]) & mask) * millisecondsPerTick});
        return timings;
    }
    return timings;
}

namespace {

// The plan's resource of that name, where hosts may look at it.
Result<ResourceIndex> inspected(const State& s, std::string_view name) {
    const int index = s.plan.find(name);
    const bool isOwn =
        index >= 0 && (s.transients.sizeOf(index) > 0 || isPersistent(s.plan.resources[size_t(index)].kind));
    if (!isOwn)
        return Error{ErrorCode::notFound,
                     "the plan has no image or buffer of the device's own in use named " + std::string(name)};
    if (!s.inspectable)
        return invalidArgument("the program is not inspectable; CompileOptions::inspectable was expected");
    return index;
}

} // namespace

Result<VkImage> Program::ownImage(std::string_view name) const {
    const auto index = inspected(*state, name);
    if (!index) return index.error();
    const ResourceKind kind = state->plan.resources[size_t(*index)].kind;
    if (kind == ResourceKind::history) return historyImage(*state, *index, false).image;
    if (kind == ResourceKind::transient) return state->transients.images[size_t(*index)].image;
    return invalidArgument(std::string(name) + " is a buffer; the name of an image was expected");
}

Result<Buffer> Program::ownBuffer(std::string_view name) const {
    const auto index = inspected(*state, name);
    if (!index) return index.error();
    const Resource& r = state->plan.resources[size_t(*index)];
    if (isImage(r.kind))
        return invalidArgument(std::string(name) + " is an image; the name of a buffer was expected");
    const auto& own = isTransient(r.kind) ? state->transients.buffers : state->persistent.buffers;
    return Buffer{own[size_t(*index)].buffer, 0, r.size, {}};
}

static_assert(ProgramDevice<Device, Program, Image>);

} // namespace rebound::vulkan
