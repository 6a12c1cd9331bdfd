// SPDX-License-Identifier: MIT
// Render passes and pipelines: what does not depend on the picture's size.
#pragma once

#include "objects.hpp"

#include <glm/glm.hpp>

namespace rebound::engine {

inline constexpr VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;
inline constexpr VkFormat colorFormat =
    VK_FORMAT_R16G16B16A16_SFLOAT; // of everything that Rebound reads or writes
inline constexpr VkFormat motionFormat = VK_FORMAT_R16G16_SFLOAT;

// Its twin is in shaders/frame.glsl, where the fields are explained.
struct FrameConstants {
    glm::mat4 viewProjection, previousViewProjection, inverseViewProjection, shadowMatrix;
    glm::vec4 eye, shadow;
    glm::ivec4 counts;
};

struct Passes {
    VkSampler nearest = VK_NULL_HANDLE;
    VkDescriptorSetLayout frameLayout = VK_NULL_HANDLE, lightLayout = VK_NULL_HANDLE;
    VkPipelineLayout sceneLayout = VK_NULL_HANDLE, lightPipelineLayout = VK_NULL_HANDLE;
    VkRenderPass shadowPass = VK_NULL_HANDLE, gbufferPass = VK_NULL_HANDLE;
    VkPipeline shadow = VK_NULL_HANDLE, gbuffer = VK_NULL_HANDLE, light = VK_NULL_HANDLE;
};

// Failures are the objects' status.
Passes makePasses(Objects&, VkDescriptorSetLayout materialLayout);

struct GraphicsPipeline {
    std::span<const uint32_t> vertex, fragment;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkRenderPass pass = VK_NULL_HANDLE;
    uint32_t colors = 0;                      // attachments
    VkCompareOp depth = VK_COMPARE_OP_ALWAYS; // ALWAYS: no depth at all
    bool vertices = true;                     // of Vertex; false: the shader makes its own
};
VkPipeline makePipeline(Objects&, const GraphicsPipeline&);
// Of the first image's size.
VkFramebuffer makeFramebuffer(Objects&, VkRenderPass, std::initializer_list<Objects::Image>);

} // namespace rebound::engine
