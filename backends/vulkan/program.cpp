// SPDX-License-Identifier: MIT
#include "device_state.hpp"

#include <cstring>

namespace rebound::vulkan {
namespace {

using State = Program::State;
using Images = std::vector<const Image*>;

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

// What passes write is no other image of the frame.
Result<> checkAlone(const Plan& plan, size_t output, const Images& images) {
    for (size_t i = 0; i < images.size(); ++i)
        if (i != output && images[i] && images[i]->view == images[output]->view)
            return invalidArgument("inputs.images: " + plan.resources[output].name + " and " +
                                   plan.resources[i].name +
                                   " have one view; an output of its own was expected");
    return {};
}

void writeHostImages(const State& s, int frame, const Images& images) {
    size_t count = 0;
    for (const CompiledPass& pass : s.passes) count += pass.external.size();
    std::vector<VkDescriptorImageInfo> infos;
    std::vector<VkWriteDescriptorSet> writes;
    infos.reserve(count); // writes point into it
    writes.reserve(count);
    for (size_t i = 0; i < s.passes.size(); ++i)
        for (const PassBinding& b : s.passes[i].external) {
            const Image& image = *images[size_t(b.resource)];
            infos.push_back({VK_NULL_HANDLE, image.view, image.layout});
            auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
            write.dstSet = s.sets[size_t(frame) * s.passes.size() + i];
            write.dstBinding = uint32_t(b.slot);
            write.descriptorCount = 1;
            write.descriptorType = b.access == Access::write ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
                                                             : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
            write.pImageInfo = &infos.back();
            writes.push_back(write);
        }
    s.device->vk.UpdateDescriptorSets(s.device->device, uint32_t(writes.size()), writes.data(), 0, nullptr);
}

void writeConstants(const State& s, int frame, const std::vector<const void*>& constants) {
    for (size_t i = 0; i < constants.size(); ++i)
        if (constants[i])
            std::memcpy(static_cast<std::byte*>(s.bufferMemory->block.mapped) + s.bufferLayout.offsets[i] +
                            s.bufferLayout.frameStride * VkDeviceSize(frame),
                        constants[i], s.plan.resources[i].size);
}

// Makes what earlier passes wrote visible, and gives up the contents of transients that begin their lives.
void recordBarrier(const State& s, VkCommandBuffer commands, const CompiledPass& pass) {
    std::vector<VkImageMemoryBarrier> beginnings;
    for (ResourceIndex r : pass.beginning) {
        auto b = structure<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
        b.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
        b.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
        b.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        b.newLayout = VK_IMAGE_LAYOUT_GENERAL;
        b.srcQueueFamilyIndex = b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        b.image = s.transients.images[size_t(r)].image;
        b.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        beginnings.push_back(b);
    }
    auto memory = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    memory.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
    s.device->vk.CmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                    VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &memory, 0, nullptr,
                                    uint32_t(beginnings.size()), beginnings.data());
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
    vk.CmdDispatch(commands, pass.groups[0], pass.groups[1], 1);
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
    for (size_t i = 0; i < s.plan.resources.size(); ++i)
        if (const Image* image = resolved->images[i])
            if (auto valid = checkImage(s.plan.resources[i], *image); !valid) return valid;
    for (size_t i = 0; i < s.plan.resources.size(); ++i)
        if (s.plan.resources[i].kind == ResourceKind::output)
            if (auto alone = checkAlone(s.plan, i, resolved->images); !alone) return alone;

    writeHostImages(s, frame, resolved->images);
    writeConstants(s, frame, resolved->constants);
    const Functions& vk = s.device->vk;
    const uint32_t firstQuery = uint32_t(frame) * uint32_t(s.passes.size() + 1);
    if (s.queries) {
        vk.CmdResetQueryPool(commands, s.queries, firstQuery, uint32_t(s.passes.size() + 1));
        vk.CmdWriteTimestamp(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, s.queries, firstQuery);
        s.measured[size_t(frame)] = true;
    }
    for (size_t i = 0; i < s.passes.size(); ++i) {
        recordPass(s, commands, frame, i);
        if (s.queries)
            vk.CmdWriteTimestamp(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, s.queries,
                                 firstQuery + uint32_t(i) + 1);
    }
    return {};
}

Result<std::vector<PassTiming>> Program::timings(int frame) const {
    const State& s = *state;
    if (auto present = s.device->loss.check(); !present) return present.error();
    if (auto valid = checkFrame(s, frame); !valid) return valid.error();
    if (!s.queries || !s.measured[size_t(frame)]) return std::vector<PassTiming>{};
    const uint32_t count = uint32_t(s.passes.size() + 1);
    std::vector<uint64_t> ticks(count);
    const VkResult result = s.device->vk.GetQueryPoolResults(
        s.device->device, s.queries, uint32_t(frame) * count, count, count * sizeof(uint64_t), ticks.data(),
        sizeof(uint64_t), VK_QUERY_RESULT_64_BIT);
    if (result == VK_NOT_READY) return std::vector<PassTiming>{};
    if (auto read = s.device->check(result, "reading timestamps"); !read) return read.error();
    const uint64_t mask =
        s.device->timestampBits >= 64 ? ~uint64_t(0) : (uint64_t(1) << s.device->timestampBits) - 1;
    const double millisecondsPerTick = double(s.device->limits.timestampPeriod) * 1e-6;
    std::vector<PassTiming> timings;
    for (size_t i = 0; i < s.passes.size(); ++i)
        timings.push_back(
            {s.plan.passes[i].label, double((ticks[i + 1] - ticks[i]) & mask) * millisecondsPerTick});
    return timings;
}

Result<VkImage> Program::transientImage(std::string_view name) const {
    const int index = state->plan.find(name);
    if (index < 0 || !state->transients.images[size_t(index)].image)
        return Error{ErrorCode::notFound, "the plan has no transient in use named " + std::string(name)};
    if (!state->inspectable)
        return invalidArgument("the program is not inspectable; CompileOptions::inspectable was expected");
    return state->transients.images[size_t(index)].image;
}

} // namespace rebound::vulkan
