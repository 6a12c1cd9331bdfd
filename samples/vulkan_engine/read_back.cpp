// SPDX-License-Identifier: MIT
// Images from the GPU, for pictures and tests.
#include "renderer.hpp"

#include "lab/runner/texels.hpp"

#include <glm/gtc/packing.hpp>

#include <cstring>

namespace rebound::engine {
namespace {

// Two halves a texel.
lab::Image motionOf(const std::byte* texels, Extent2D extent) {
    lab::Image image(extent, 2);
    for (size_t i = 0; i < image.data.size(); ++i) {
        uint16_t half = 0;
        std::memcpy(&half, texels + i * sizeof half, sizeof half);
        image.data[i] = glm::unpackHalf1x16(half);
    }
    return image;
}

} // namespace

Result<lab::Image> Renderer::read(const Objects::Image& source, int channels) const {
    const bool isDepth = source.format == depthFormat, isMotion = source.format == motionFormat;
    const Format format = isDepth ? Format::r32f : Format::rgba16f;
    const VkImageLayout layout =
        isDepth ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL
        : source.image == current->lit.image || source.image == current->radiance.image ||
                source.image == current->indirect.image || source.image == current->composed.image
            ? VK_IMAGE_LAYOUT_GENERAL
            : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkImageAspectFlags aspect = isDepth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    const size_t size = bytesPerTexel(format) * size_t(source.extent.width) * size_t(source.extent.height);
    auto staging = host::VulkanBuffer::create(context, size, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                              VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                                  VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    if (!staging) return staging.error();
    auto done = context.run([&](VkCommandBuffer commands) -> Result<> {
        VkBufferImageCopy copy{};
        copy.imageSubresource = {aspect, 0, 0, 1};
        copy.imageExtent = {uint32_t(source.extent.width), uint32_t(source.extent.height), 1};
        host::recordTransition(commands, source.image, layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, aspect);
        vkCmdCopyImageToBuffer(commands, source.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                               (*staging)->buffer, 1, &copy);
        host::recordTransition(commands, source.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, layout, aspect);
        host::recordFullBarrier(commands);
        return {};
    });
    if (!done) return done.error();
    if (isMotion) return motionOf((*staging)->mapped, source.extent);
    return runner::imageOf((*staging)->mapped, format, source.extent, channels);
}

} // namespace rebound::engine
