// SPDX-License-Identifier: MIT
#include "lab/host/vulkan_image.hpp"
#include "lab/runner/inspection.hpp"
#include "rebound/techniques/input_check.hpp"
#include "rebound/vulkan/device.hpp"

#include <cstring>

namespace rebound::runner {
namespace {

using host::VulkanBuffer;
using host::VulkanContext;
using host::VulkanImage;

constexpr VkMemoryPropertyFlags hostMemory =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

Result<std::unique_ptr<VulkanBuffer>> stagingBuffer(const VulkanContext& context, size_t size) {
    return VulkanBuffer::create(context, std::max<size_t>(size, 4),
                                VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                hostMemory);
}

class VulkanPlan : public PreparedPlan {
public:
    VulkanPlan(const VulkanContext& c, const vulkan::Device& d, SharedBuffers<vulkan::Buffer>& given,
               vulkan::Program compiled)
        : context(c), device(d), shared(given), program(std::move(compiled)) {}

    Result<> createImages(Precision precision) {
        const Plan& plan = program.plan();
        images.resize(plan.resources.size());
        formats.resize(plan.resources.size());
        buffers.resize(plan.resources.size());
        for (size_t i = 0; i < plan.resources.size(); ++i) {
            const Resource& r = plan.resources[i];
            if (r.kind == ResourceKind::outputBuffer) {
                auto buffer = VulkanBuffer::create(context, r.size,
                                                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                       VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                                       VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                   hostMemory);
                if (!buffer) return buffer.error();
                buffers[i] = *std::move(buffer);
                std::memset(buffers[i]->mapped, 0, r.size);
            }
            if (!isHostImage(r.kind)) continue;
            const Format format = r.kind == ResourceKind::input ? inputFormat(r, precision) : r.format;
            constexpr VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                                                VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                                VK_IMAGE_USAGE_TRANSFER_DST_BIT;
            auto image = VulkanImage::create(context, r.extent, vulkan::vulkanFormat(format), usage);
            if (!image) return image.error();
            images[i] = *std::move(image);
            formats[i] = format;
            const std::vector<std::byte> zeros(sizeOf(format, r.extent));
            if (auto filled = fill(i, zeros, VK_IMAGE_LAYOUT_UNDEFINED); !filled) return filled;
            frame.images.push_back(
                {r.name, {images[i]->view, r.extent, images[i]->format, VK_IMAGE_LAYOUT_GENERAL}});
        }
        return {};
    }

    Result<> setInputs(const PlanInputs& inputs) override {
        const Plan& plan = program.plan();
        if (auto valid = checkInputs(plan, inputs); !valid) return valid;
        frame.buffers.clear();
        for (size_t i = 0; i < plan.resources.size(); ++i) {
            const Resource& r = plan.resources[i];
            if (r.kind == ResourceKind::outputBuffer)
                frame.buffers.push_back({r.name, {buffers[i]->buffer, 0, r.size, {}}});
            if (r.kind == ResourceKind::inputBuffer) {
                auto buffer = shared.obtain(device, *findBytes(plan, inputs, r));
                if (!buffer) return buffer.error();
                frame.buffers.push_back({r.name, *std::move(buffer)});
            }
            if (r.kind != ResourceKind::input) continue;
            const auto texels = texelsOf(**findPicture(plan, inputs, r), formats[i]);
            if (auto filled = fill(i, texels, VK_IMAGE_LAYOUT_GENERAL); !filled) return filled;
        }
        frame.constants = inputs.constants;
        return {};
    }

    Result<double> run() override {
        const auto start = std::chrono::steady_clock::now();
        const auto done = context.run([&](VkCommandBuffer commands) {
            const auto before = std::chrono::steady_clock::now();
            auto recorded = program.record(commands, 0, frame);
            recording = millisecondsSince(before);
            return recorded;
        });
        if (!done) return done.error();
        const double elapsed = millisecondsSince(start);
        auto measured = program.timings();
        if (!measured) return measured.error();
        passTimings = *std::move(measured);
        return elapsed;
    }

    const std::vector<PassTiming>& timings() const override { return passTimings; }
    std::optional<double> recordingTime() const override { return recording; }
    MemoryUse memoryUse() const override { return program.memoryUse(); }

    Result<lab::Image> read(const std::string& output) override {
        const auto index = findOutput(program.plan(), output);
        if (!index) return index.error();
        const Resource& r = program.plan().resources[size_t(*index)];
        if (r.kind == ResourceKind::outputBuffer) return rowOf({buffers[size_t(*index)]->mapped, r.size});
        auto staging = stagingBuffer(context, sizeOf(r));
        if (!staging) return staging.error();
        const auto done = context.run([&](VkCommandBuffer commands) -> Result<> {
            host::recordDownload(commands, images[size_t(*index)]->image, r.extent, (*staging)->buffer, 0);
            host::recordFullBarrier(commands);
            return {};
        });
        if (!done) return done.error();
        return imageOf((*staging)->mapped, r.format, r.extent, r.channels);
    }

    void reset() override { program.reset(); }

    // All in one submission: behind each pass, what it wrote is copied out and the replacement copied in.
    Result<Record> inspect(const Record* replacement) override {
        const Plan& plan = program.plan();
        std::vector<Copy> copies;
        size_t size = 0;
        for (size_t pass = 0; pass < plan.passes.size(); ++pass)
            for (const PassBinding& b : plan.passes[pass].bindings) {
                if (b.access != Access::write) continue;
                copies.push_back({pass, b.resource, size});
                size += (sizeOf(plan.resources[size_t(b.resource)]) + 15) / 16 * 16;
            }
        auto out = stagingBuffer(context, size), in = stagingBuffer(context, replacement ? size : 0);
        if (!out) return out.error();
        if (!in) return in.error();
        if (replacement) writeReplacement(*replacement, copies, **in);
        Result<> copied;
        program.onPass([&](VkCommandBuffer commands, int pass) {
            host::recordFullBarrier(commands);
            for (const Copy& copy : copies) {
                if (copy.pass != size_t(pass) || !copied) continue;
                copied = recordCopies(commands, copy, **out, replacement ? in->get() : nullptr);
            }
            host::recordFullBarrier(commands);
        });
        const auto done =
            context.run([&](VkCommandBuffer commands) { return program.record(commands, 0, frame); });
        program.onPass({});
        if (!done) return done.error();
        if (!copied) return copied.error();
        Record record(plan.passes.size());
        for (const Copy& copy : copies) {
            const Resource& r = plan.resources[size_t(copy.resource)];
            const std::byte* from = (*out)->mapped + copy.offset;
            record[copy.pass].push_back({copy.resource, isImage(r.kind)
                                                            ? imageOf(from, r.format, r.extent, r.channels)
                                                            : rowOf({from, r.size})});
        }
        return record;
    }

private:
    struct Copy {
        size_t pass;
        ResourceIndex resource;
        size_t offset; // in the staging buffers [bytes]
    };

    static size_t sizeOf(Format format, Extent2D extent) {
        return bytesPerTexel(format) * size_t(extent.width) * size_t(extent.height);
    }
    static size_t sizeOf(const Resource& r) { return rebound::sizeOf(r); }

    Result<VkImage> imageToCopy(ResourceIndex index) const {
        if (images[size_t(index)]) return images[size_t(index)]->image;
        return program.ownImage(program.plan().resources[size_t(index)].name);
    }

    Result<vulkan::Buffer> bufferToCopy(ResourceIndex index) const {
        const Resource& r = program.plan().resources[size_t(index)];
        if (const auto& own = buffers[size_t(index)]) return vulkan::Buffer{own->buffer, 0, r.size, {}};
        return program.ownBuffer(r.name);
    }

    // What a pass wrote is copied out, and then, where there is something to replace it by, that is copied in.
    Result<> recordCopies(VkCommandBuffer commands, const Copy& copy, const VulkanBuffer& out,
                          const VulkanBuffer* in) const {
        const Resource& r = program.plan().resources[size_t(copy.resource)];
        if (isImage(r.kind)) {
            const auto image = imageToCopy(copy.resource);
            if (!image) return image.error();
            host::recordDownload(commands, *image, r.extent, out.buffer, copy.offset);
            host::recordFullBarrier(commands);
            if (in) host::recordUpload(commands, in->buffer, copy.offset, *image, r.extent);
        } else {
            const auto buffer = bufferToCopy(copy.resource);
            if (!buffer) return buffer.error();
            const VkBufferCopy outwards{buffer->offset, copy.offset, r.size},
                inwards{copy.offset, buffer->offset, r.size};
            vkCmdCopyBuffer(commands, buffer->buffer, out.buffer, 1, &outwards);
            host::recordFullBarrier(commands);
            if (in) vkCmdCopyBuffer(commands, in->buffer, buffer->buffer, 1, &inwards);
        }
        return {};
    }

    void writeReplacement(const Record& replacement, const std::vector<Copy>& copies,
                          VulkanBuffer& in) const {
        size_t index = 0;
        for (size_t i = 0; i < copies.size(); ++i) {
            index = i > 0 && copies[i].pass == copies[i - 1].pass ? index + 1 : 0;
            const lab::Image& image = replacement[copies[i].pass][index].image;
            const Resource& r = program.plan().resources[size_t(copies[i].resource)];
            const auto texels = isImage(r.kind) ? texelsOf(image, r.format) : bytesOf(image);
            std::memcpy(in.mapped + copies[i].offset, texels.data(), texels.size());
        }
    }

    // Replaces an image's texels.
    Result<> fill(size_t index, const std::vector<std::byte>& texels, VkImageLayout before) {
        const Resource& r = program.plan().resources[index];
        auto staging = stagingBuffer(context, texels.size());
        if (!staging) return staging.error();
        std::memcpy((*staging)->mapped, texels.data(), texels.size());
        return context.run([&](VkCommandBuffer commands) -> Result<> {
            host::recordTransition(commands, images[index]->image, before, VK_IMAGE_LAYOUT_GENERAL);
            host::recordUpload(commands, (*staging)->buffer, 0, images[index]->image, r.extent);
            host::recordFullBarrier(commands);
            return {};
        });
    }

    const VulkanContext& context;
    const vulkan::Device& device;
    SharedBuffers<vulkan::Buffer>& shared;
    vulkan::Program program;
    std::vector<std::unique_ptr<VulkanImage>> images;   // by resource; null where it is none of the host's
    std::vector<Format> formats;                        // of images
    std::vector<std::unique_ptr<VulkanBuffer>> buffers; // likewise; output buffers
    FrameInputs<vulkan::Image> frame;
    std::vector<PassTiming> passTimings;
    double recording = 0; // [ms]
};

class VulkanBackend : public Backend {
public:
    VulkanBackend(VulkanContext c, vulkan::Device d) : context(std::move(c)), device(std::move(d)) {}

    BackendInfo info() const override { return {"vulkan", context.deviceName(), "", 0}; }
    Result<MemoryUse> memoryUse(const Plan& plan) const override {
        return device.memoryUse(plan, {1, nullptr, false});
    }
    std::vector<std::string> complaints() override { return context.messages(); }

    Result<std::unique_ptr<PreparedPlan>> prepare(const Plan& plan, const PlanInputs& inputs,
                                                  const PrepareOptions& options) override {
        auto program = device.compile(plan, {1, nullptr, options.inspectable});
        if (!program) return program.error();
        auto prepared = std::make_unique<VulkanPlan>(context, device, shared, *std::move(program));
        if (auto made = prepared->createImages(options.precision); !made) return made.error();
        if (auto set = prepared->setInputs(inputs); !set) return set.error();
        return std::unique_ptr<PreparedPlan>(std::move(prepared));
    }

private:
    VulkanContext context;
    vulkan::Device device;
    SharedBuffers<vulkan::Buffer> shared;
};

} // namespace

Result<std::unique_ptr<Backend>> createVulkanBackend(const BackendChoice& choice) {
    host::VulkanOptions hostOptions;
    hostOptions.device = choice.device;
    hostOptions.validation = choice.validation;
    auto context = VulkanContext::create(hostOptions);
    if (!context) return context.error();
    vulkan::DeviceOptions options;
    options.getInstanceProcAddr = vkGetInstanceProcAddr;
    options.instance = context->instance();
    options.physicalDevice = context->physicalDevice();
    options.device = context->device();
    options.queueFamily = context->queueFamily();
    options.timings = true;
    options.debugUtils = context->hasDebugUtils();
    options.moreShaders = choice.moreShaders;
    options.moreShaders.push_back(inputCheckShaders());
    auto device = vulkan::Device::create(options);
    if (!device) return device.error();
    return std::unique_ptr<Backend>(std::make_unique<VulkanBackend>(*std::move(context), *std::move(device)));
}

} // namespace rebound::runner
