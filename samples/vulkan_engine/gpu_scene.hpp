// SPDX-License-Identifier: MIT
// A scene on the GPU: one vertex and one index buffer, textures, and a descriptor set a material.
#pragma once

#include "lights.hpp"
#include "objects.hpp"

#include "lab/scene.hpp"

namespace rebound::engine {

struct Vertex {
    glm::vec3 position, normal;
    glm::vec2 textureCoordinate;
};

// Push constants; their twin is in shaders/material.glsl.
struct MaterialConstants {
    glm::vec4 baseColor, emission;
};

class GpuScene {
public:
    // The context outlives it.
    static Result<std::unique_ptr<GpuScene>> create(const host::VulkanContext&, const lab::Scene&);

    // Draws everything with the bound pipeline of that layout, whose set 1 is a material's.
    void draw(VkCommandBuffer, VkPipelineLayout) const;

    VkDescriptorSetLayout materialLayout = VK_NULL_HANDLE;
    LightSetup lights;
    VkBuffer lightBuffer = VK_NULL_HANDLE;

private:
    struct Part {
        uint32_t firstIndex, indexCount;
        int32_t vertexOffset;
        size_t material;
    };
    explicit GpuScene(const host::VulkanContext& context) : objects(context) {}
    void addMeshes(const lab::Scene&);
    void addMaterials(VkDevice, const lab::Scene&);

    Objects objects;
    VkBuffer vertices = VK_NULL_HANDLE, indices = VK_NULL_HANDLE;
    std::vector<Part> parts;
    std::vector<VkDescriptorSet> sets; // by material
    std::vector<MaterialConstants> constants;
};

} // namespace rebound::engine
