// SPDX-License-Identifier: MIT
#include "passes.hpp"

#include "gpu_scene.hpp"

#include "gbuffer_frag.h"
#include "gbuffer_vert.h"
#include "light_comp.h"
#include "shadow_frag.h"
#include "shadow_vert.h"

#include <cstddef>
#include <iterator>

namespace rebound::engine {
namespace {

VkShaderModule makeModule(Objects& objects, std::span<const uint32_t> spirv) {
    auto info = structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = spirv.size_bytes();
    info.pCode = spirv.data();
    return objects.make(vkCreateShaderModule, vkDestroyShaderModule, info, "creating a shader module");
}

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits stage, VkShaderModule module) {
    auto info =
        structure<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    info.stage = stage;
    info.module = module;
    info.pName = "main";
    return info;
}

// Colour attachments, then depth; all are cleared, kept, and left for compute shaders to read.
VkRenderPass makeRenderPass(Objects& objects, std::initializer_list<VkFormat> colors) {
    std::vector<VkAttachmentDescription> attachments;
    std::vector<VkAttachmentReference> references;
    const auto add = [&](VkFormat format, VkImageLayout layout, VkImageLayout finalLayout) {
        references.push_back({uint32_t(attachments.size()), layout});
        attachments.push_back({0, format, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR,
                               VK_ATTACHMENT_STORE_OP_STORE, VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                               VK_ATTACHMENT_STORE_OP_DONT_CARE, VK_IMAGE_LAYOUT_UNDEFINED, finalLayout});
    };
    for (VkFormat format : colors)
        add(format, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    add(depthFormat, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
        VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL);
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = uint32_t(colors.size());
    subpass.pColorAttachments = references.data();
    subpass.pDepthStencilAttachment = &references.back();
    constexpr VkPipelineStageFlags attachmentStages = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                                      VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                                      VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
    constexpr VkAccessFlags writes =
        VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    // [rebound gbuffer barriers]
    // Before: the frame before has read these images in compute shaders. After: compute shaders read them, the light
    // pass and Rebound alike.
    const VkSubpassDependency dependencies[] = {
        {VK_SUBPASS_EXTERNAL, 0, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | attachmentStages, attachmentStages,
         writes, writes | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT, 0},
        {0, VK_SUBPASS_EXTERNAL, attachmentStages, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, writes,
         VK_ACCESS_SHADER_READ_BIT, 0}};
    // [/rebound gbuffer barriers]
    auto info = structure<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    info.attachmentCount = uint32_t(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = uint32_t(std::size(dependencies));
    info.pDependencies = dependencies;
    return objects.make(vkCreateRenderPass, vkDestroyRenderPass, info, "creating a render pass");
}

} // namespace

// Pipelines are made one at a time; make() takes functions of one object.
template <class Info, VkResult(VKAPI_PTR* create)(VkDevice, VkPipelineCache, uint32_t, const Info*,
                                                  const VkAllocationCallbacks*, VkPipeline*)>
VKAPI_ATTR VkResult VKAPI_CALL createOne(VkDevice device, const Info* info,
                                         const VkAllocationCallbacks* allocator, VkPipeline* pipeline) {
    return create(device, VK_NULL_HANDLE, 1, info, allocator, pipeline);
}

VkPipeline makePipeline(Objects& objects, const GraphicsPipeline& p) {
    const VkPipelineShaderStageCreateInfo stages[] = {
        stage(VK_SHADER_STAGE_VERTEX_BIT, makeModule(objects, p.vertex)),
        stage(VK_SHADER_STAGE_FRAGMENT_BIT, makeModule(objects, p.fragment))};
    const VkVertexInputBindingDescription binding{0, sizeof(Vertex), VK_VERTEX_INPUT_RATE_VERTEX};
    const VkVertexInputAttributeDescription attributes[] = {
        {0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, position)},
        {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, normal)},
        {2, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(Vertex, textureCoordinate)},
        {3, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(Vertex, color)}};
    auto input = structure<VkPipelineVertexInputStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
    if (p.vertices) {
        input.vertexBindingDescriptionCount = 1;
        input.pVertexBindingDescriptions = &binding;
        input.vertexAttributeDescriptionCount = uint32_t(std::size(attributes));
        input.pVertexAttributeDescriptions = attributes;
    }
    auto assembly = structure<VkPipelineInputAssemblyStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    auto viewport =
        structure<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
    viewport.viewportCount = viewport.scissorCount = 1;
    // Surfaces are two-sided: nothing is culled.
    auto raster = structure<VkPipelineRasterizationStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
    raster.lineWidth = 1.0f;
    auto samples = structure<VkPipelineMultisampleStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    auto depth = structure<VkPipelineDepthStencilStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
    depth.depthTestEnable = depth.depthWriteEnable = p.depth != VK_COMPARE_OP_ALWAYS;
    depth.depthCompareOp = p.depth;
    VkPipelineColorBlendAttachmentState opaque{};
    opaque.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                            VK_COLOR_COMPONENT_A_BIT;
    const std::vector<VkPipelineColorBlendAttachmentState> attachments(p.colors, opaque);
    auto blend = structure<VkPipelineColorBlendStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
    blend.attachmentCount = p.colors;
    blend.pAttachments = attachments.data();
    const VkDynamicState states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    auto dynamic =
        structure<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
    dynamic.dynamicStateCount = uint32_t(std::size(states));
    dynamic.pDynamicStates = states;
    auto info = structure<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
    info.stageCount = uint32_t(std::size(stages));
    info.pStages = stages;
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = p.layout;
    info.renderPass = p.pass;
    return objects.make<VkPipeline>(createOne<VkGraphicsPipelineCreateInfo, vkCreateGraphicsPipelines>,
                                    vkDestroyPipeline, info, "creating a pipeline");
}

VkFramebuffer makeFramebuffer(Objects& objects, VkRenderPass pass,
                              std::initializer_list<Objects::Image> images) {
    std::vector<VkImageView> views;
    for (const Objects::Image& image : images) views.push_back(image.view);
    auto info = structure<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
    info.renderPass = pass;
    info.attachmentCount = uint32_t(views.size());
    info.pAttachments = views.data();
    info.width = uint32_t(images.begin()->extent.width);
    info.height = uint32_t(images.begin()->extent.height);
    info.layers = 1;
    return objects.make(vkCreateFramebuffer, vkDestroyFramebuffer, info, "creating a framebuffer");
}

Passes makePasses(Objects& objects, VkDescriptorSetLayout materialLayout) {
    Passes p;
    constexpr VkDescriptorType sampled = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    p.nearest = objects.sampler(VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
    p.frameLayout = objects.setLayout({VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC},
                                      VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT |
                                          VK_SHADER_STAGE_COMPUTE_BIT);
    p.lightLayout =
        objects.setLayout({sampled, sampled, sampled, sampled, sampled, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
                           VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE},
                          VK_SHADER_STAGE_COMPUTE_BIT);
    p.sceneLayout = objects.pipelineLayout({p.frameLayout, materialLayout},
                                           VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
                                           sizeof(MaterialConstants) + sizeof(ObjectConstants));
    p.lightPipelineLayout = objects.pipelineLayout({p.frameLayout, p.lightLayout});
    p.shadowPass = makeRenderPass(objects, {});
    p.gbufferPass = makeRenderPass(objects, {colorFormat, colorFormat, colorFormat, motionFormat});
    p.shadow =
        makePipeline(objects, {shadow_vert, shadow_frag, p.sceneLayout, p.shadowPass, 0, VK_COMPARE_OP_LESS});
    p.gbuffer = makePipeline(
        objects, {gbuffer_vert, gbuffer_frag, p.sceneLayout, p.gbufferPass, 4, VK_COMPARE_OP_GREATER});
    auto light = structure<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    light.stage = stage(VK_SHADER_STAGE_COMPUTE_BIT, makeModule(objects, light_comp));
    light.layout = p.lightPipelineLayout;
    p.light = objects.make<VkPipeline>(createOne<VkComputePipelineCreateInfo, vkCreateComputePipelines>,
                                       vkDestroyPipeline, light, "creating a pipeline");
    return p;
}

} // namespace rebound::engine
