// SPDX-License-Identifier: MIT
#include "renderer.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace rebound::engine {
namespace {

// Images are in the layouts that they are used in: nothing changes but what is visible to whom.
void recordBarrier(VkCommandBuffer commands, VkPipelineStageFlags from, VkAccessFlags written,
                   VkPipelineStageFlags to, VkAccessFlags used) {
    auto barrier = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    barrier.srcAccessMask = written;
    barrier.dstAccessMask = used;
    vkCmdPipelineBarrier(commands, from, to, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

} // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(const host::VulkanContext& context,
                                                   const lab::Scene& scene, std::string preset,
                                                   vulkan::MemoryAllocator allocator) {
    auto indirect = IndirectLight::create(context, true, std::move(allocator));
    if (!indirect) return indirect.error();
    std::unique_ptr<Renderer> renderer(new Renderer(context, std::move(preset), *std::move(indirect)));
    if (auto made = renderer->createOnce(scene); !made) return made.error();
    return renderer;
}

Result<std::unique_ptr<Renderer>> Renderer::create(const host::VulkanContext& context,
                                                   const lab::Scene& scene, const Bake& bake) {
    auto renderer = create(context, scene, std::string("quarter-64"));
    if (!renderer) return renderer.error();
    auto light = BakedLight::create(context, bake, !scene.emissiveMaterialsLight, true);
    if (!light) return light.error();
    (*renderer)->baked = *std::move(light);
    return renderer;
}

Result<std::unique_ptr<Renderer>> createRenderer(const host::VulkanContext& context, const lab::Scene& scene,
                                                 const Options& o) {
    if (o.bake.empty()) return Renderer::create(context, scene, o.preset);
    const auto bake = bakeOf(o);
    if (!bake) return bake.error();
    return Renderer::create(context, scene, *bake);
}

Result<> Renderer::createOnce(const lab::Scene& labScene) {
    auto made = GpuScene::create(context, labScene);
    if (!made) return made.error();
    scene = *std::move(made);
    passes = makePasses(objects, scene->materialLayout);
    shadowMap = objects.image({shadowMapSize, shadowMapSize}, depthFormat,
                              VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                  VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                              VK_IMAGE_ASPECT_DEPTH_BIT);
    shadowFramebuffer = makeFramebuffer(objects, passes.shadowPass, {shadowMap});
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(context.physicalDevice(), &properties);
    largestSide = properties.limits.maxImageDimension2D;
    const VkDeviceSize alignment = properties.limits.minUniformBufferOffsetAlignment;
    frameStride = (sizeof(FrameConstants) + alignment - 1) / alignment * alignment;
    frameBuffer = objects.mappedBuffer(frameStride * framesInFlight, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    constexpr VkDescriptorType uniform = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
    frameSet = objects.descriptorSet(objects.descriptorPool(1, {{uniform, 1}}), passes.frameLayout);
    if (!objects.status()) return objects.status();
    writeBuffer(context.device(), frameSet, 0, uniform, frameBuffer->buffer, sizeof(FrameConstants));
    return {};
}

// [rebound images]
// Inputs are sampled; outputs are storage images, in the formats that the plan asks for, and sampled as well.
void Renderer::makeTargets(Targets& t, Extent2D size) {
    constexpr VkImageUsageFlags read = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    constexpr VkImageUsageFlags attachment = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | read;
    constexpr VkImageUsageFlags storage = VK_IMAGE_USAGE_STORAGE_BIT | read;
    t.depth = t.objects.image(size, depthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | read,
                              VK_IMAGE_ASPECT_DEPTH_BIT);
    t.normal = t.objects.image(size, colorFormat, attachment);
    t.albedo = t.objects.image(size, colorFormat, attachment);
    t.emission = t.objects.image(size, colorFormat, attachment);
    t.motion = t.objects.image(size, motionFormat, attachment);
    t.lit = t.objects.image(size, colorFormat, storage);
    t.radiance = t.objects.image(size, colorFormat, storage);
    t.indirect = t.objects.image(size, vulkan::vulkanFormat(Format::rgba16f), storage);
    t.composed = t.objects.image(size, vulkan::vulkanFormat(Format::rgba16f), storage);
}
// [/rebound images]

Result<> Renderer::resize(Extent2D size, const lab::CameraView& view) {
    if (uint32_t(std::max(size.width, size.height)) > largestSide)
        return Error{ErrorCode::unsupported, "the picture is " + std::to_string(size.width) + "x" +
                                                 std::to_string(size.height) +
                                                 "; this device's images have at most " +
                                                 std::to_string(largestSide) + " texels a side"};
    auto next = std::make_shared<Targets>(context);
    makeTargets(*next, size);
    next->framebuffer =
        makeFramebuffer(next->objects, passes.gbufferPass,
                        {next->normal, next->albedo, next->emission, next->motion, next->depth});
    constexpr VkDescriptorType sampled = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                               image = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
                               buffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    const VkDescriptorPool pool = next->objects.descriptorPool(
        framesInFlight,
        {{sampled, 5 * framesInFlight}, {image, 2 * framesInFlight}, {buffer, framesInFlight}});
    for (VkDescriptorSet& set : next->lightSets) set = next->objects.descriptorSet(pool, passes.lightLayout);
    if (!next->objects.status()) return next->objects.status();
    const VkDevice device = context.device();
    constexpr VkImageLayout depthLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    for (size_t i = 0; i < next->lightSets.size(); ++i) {
        const VkDescriptorSet set = next->lightSets[i];
        writeImage(device, set, 0, sampled, passes.nearest, next->depth.view, depthLayout);
        uint32_t binding = 1;
        for (const Objects::Image& color : {next->normal, next->albedo, next->emission})
            writeImage(device, set, binding++, sampled, passes.nearest, color.view,
                       VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        writeImage(device, set, 4, sampled, passes.nearest, shadowMap.view, depthLayout);
        writeImage(device, set, 5, image, VK_NULL_HANDLE, next->lit.view, VK_IMAGE_LAYOUT_GENERAL);
        writeImage(device, set, 7, image, VK_NULL_HANDLE, next->radiance.view, VK_IMAGE_LAYOUT_GENERAL);
        writeBuffer(device, set, 6, buffer, scene->lightBuffers[i]->buffer, VK_WHOLE_SIZE);
    }
    if (auto compiled = compile(view, size); !compiled) return compiled; // nothing has changed yet
    if (current) retire(current);
    current = std::move(next);
    previousViewProjection.reset();
    return {};
}

Result<> Renderer::compile(const lab::CameraView& view, Extent2D size) {
    if (baked) {
        auto replaced = baked->compile(conventionsOf(view), size);
        if (!replaced) return replaced.error();
        if (*replaced) retire(std::make_shared<vulkan::Program>(**std::move(replaced)));
        return {};
    }
    // [rebound resize]
    auto replaced = indirect.compile(preset, conventionsOf(view), size);
    if (!replaced) return replaced.error(); // nothing has changed yet
    if (*replaced) retire(std::make_shared<vulkan::Program>(**std::move(replaced)));
    // [/rebound resize]
    return {};
}

// With as many frames recorded since as can be in flight, the fence of the last frame that used it has been waited for.
void Renderer::destroyRetired() {
    std::erase_if(retired, [](Retired& r) { return ++r.age > framesInFlight; });
}

void Renderer::writeFrame(int frame, const lab::CameraView& view, const Camera& camera) {
    const glm::mat4 viewProjection(glm::dmat4(camera.projection) * glm::dmat4(camera.view));
    FrameConstants k;
    k.viewProjection = viewProjection;
    k.previousViewProjection = previousViewProjection.value_or(viewProjection);
    k.inverseViewProjection =
        glm::mat4(glm::inverse(glm::dmat4(camera.projection) * glm::dmat4(camera.view)));
    k.shadowMatrix = scene->lights.shadowMatrix;
    k.eye = view.orthographic ? glm::vec4(view.position - view.target, 0.0f) : glm::vec4(view.position, 1.0f);
    k.shadow = {scene->lights.shadowTexel, scene->lights.shadowPerspective ? 1.0f : 0.0f,
                scene->lights.emissionIsDirectLight ? 1.0f : 0.0f, 0.0f};
    k.counts = {scene->lights.count, scene->lights.shadowed, current->lit.extent.width,
                current->lit.extent.height};
    std::memcpy(frameBuffer->mapped + frameStride * VkDeviceSize(frame), &k, sizeof k);
    previousViewProjection = viewProjection;
}

void Renderer::recordRasterPass(VkCommandBuffer commands, int frame, VkRenderPass pass,
                                VkFramebuffer framebuffer, VkPipeline pipeline, VkPipelineLayout layout,
                                Extent2D size, std::span<const VkClearValue> clear) const {
    auto begin = structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    begin.renderPass = pass;
    begin.framebuffer = framebuffer;
    begin.renderArea.extent = {uint32_t(size.width), uint32_t(size.height)};
    begin.clearValueCount = uint32_t(clear.size());
    begin.pClearValues = clear.data();
    const VkViewport viewport{0, 0, float(size.width), float(size.height), 0.0f, 1.0f};
    const uint32_t offset = uint32_t(frameStride) * uint32_t(frame);
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &begin.renderArea);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &frameSet, 1, &offset);
    scene->draw(commands, layout);
    vkCmdEndRenderPass(commands);
}

void Renderer::recordLightPass(VkCommandBuffer commands, int frame) const {
    const uint32_t offset = uint32_t(frameStride) * uint32_t(frame);
    const VkDescriptorSet sets[] = {frameSet, current->lightSets[size_t(frame)]};
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, passes.light);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, passes.lightPipelineLayout, 0, 2, sets,
                            1, &offset);
    const auto groups = [](int side) { return uint32_t(side + 7) / 8; };
    vkCmdDispatch(commands, groups(current->lit.extent.width), groups(current->lit.extent.height), 1);
}

// [rebound frame]
// Each image with the layout that it is in. Emissive surfaces are lights here, so what surfaces send to be gathered is
// not all that is seen: radiance and lit are two images.
ScreenIndirectFrame<vulkan::Image> Renderer::indirectFrame(const Camera& camera) const {
    const auto image = [](const Objects::Image& i, VkImageLayout layout) {
        return vulkan::Image{i.view, i.extent, i.format, layout};
    };
    ScreenIndirectFrame<vulkan::Image> f;
    f.camera = camera; // the matrices that the G-buffer was drawn with
    f.depth = image(current->depth, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL);
    f.normal = image(current->normal, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    f.albedo = image(current->albedo, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    f.radiance = image(current->radiance, VK_IMAGE_LAYOUT_GENERAL);
    f.lit = image(current->lit, VK_IMAGE_LAYOUT_GENERAL);
    f.indirect = image(current->indirect, VK_IMAGE_LAYOUT_GENERAL);
    f.composed = image(current->composed, VK_IMAGE_LAYOUT_GENERAL);
    return f;
}
// [/rebound frame]

// [rebound frame baked]
IlluminanceCompositionFrame<vulkan::Image> Renderer::bakedFrame(const Camera& camera) const {
    const ScreenIndirectFrame<vulkan::Image> screen = indirectFrame(camera);
    IlluminanceCompositionFrame<vulkan::Image> f;
    f.camera = camera;
    f.depth = screen.depth;
    f.normal = screen.normal;
    f.albedo = screen.albedo;
    f.lit = screen.lit;
    f.indirect = screen.indirect;
    f.composed = screen.composed;
    return f;
}
// [/rebound frame baked]

Result<> Renderer::recordIndirect(VkCommandBuffer commands, int frame, const Camera& camera) {
    if (!baked) return indirect.record(commands, frame, indirectFrame(camera));
    // The shadow map's render pass has left it for compute shaders to read, as it has the light pass's inputs.
    const vulkan::Image shadows{shadowMap.view, shadowMap.extent, shadowMap.format,
                                VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL};
    return baked->record(commands, frame, bakedFrame(camera), surfelSourcesOf(scene->lights), shadows);
}

Result<> Renderer::record(VkCommandBuffer commands, int frame, const lab::CameraView& view) {
    destroyRetired();
    const Camera camera = cameraOf(view, current->lit.extent);
    writeFrame(frame, view, camera);
    VkClearValue clear[5] = {}; // reversed depth: far away is 0
    VkClearValue farthest{};
    farthest.depthStencil.depth = 1.0f;
    recordRasterPass(commands, frame, passes.shadowPass, shadowFramebuffer, passes.shadow, passes.sceneLayout,
                     shadowMap.extent, {&farthest, 1});
    recordRasterPass(commands, frame, passes.gbufferPass, current->framebuffer, passes.gbuffer,
                     passes.sceneLayout, current->lit.extent, clear);
    if (!std::exchange(current->used, true))
        for (const Objects::Image& written :
             {current->lit, current->radiance, current->indirect, current->composed})
            host::recordTransition(commands, written.image, VK_IMAGE_LAYOUT_UNDEFINED,
                                   VK_IMAGE_LAYOUT_GENERAL);
    // [rebound barriers]
    // Before: lit, radiance, indirect and composed are about to be written by compute shaders; the frame before may still
    // be read from them, by compute shaders, the presenting fragment shader or a copy. Layouts stay GENERAL.
    constexpr VkPipelineStageFlags readers = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT |
                                             VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT |
                                             VK_PIPELINE_STAGE_TRANSFER_BIT;
    recordBarrier(commands, readers, VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                  VK_ACCESS_SHADER_WRITE_BIT);
    recordLightPass(commands, frame);
    // Between: what the light pass wrote is what Rebound reads.
    recordBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                  VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT);
    if (auto recorded = recordIndirect(commands, frame, camera); !recorded) return recorded;
    // After: compute shaders have written composed; here a fragment shader or a copy reads it.
    recordBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                  VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                  VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT);
    // [/rebound barriers]
    return {};
}

} // namespace rebound::engine
