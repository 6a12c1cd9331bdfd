// SPDX-License-Identifier: MIT
// A scene on the GPU: one vertex and one index buffer, textures, and a descriptor set a material.
#pragma once

#include "objects.hpp"

#include "lab/engine/moment.hpp"
#include "lab/engine/scene_data.hpp"

#include <array>

namespace rebound::engine {

class GpuScene {
public:
    // The context outlives it.
    static Result<std::unique_ptr<GpuScene>> create(const host::VulkanContext&, const lab::Scene&);

    // Draws everything with the bound pipeline of that layout, whose set 1 is a material's.
    void draw(VkCommandBuffer, VkPipelineLayout) const;

    // From the next frame on, whose number in flight it is.
    void set(const Moment&, int frame);

    VkDescriptorSetLayout materialLayout = VK_NULL_HANDLE;
    LightSetup lights;
    std::array<host::VulkanBuffer*, framesInFlight>
        lightBuffers{}; // as many as the scene has; by frame in flight

private:
    explicit GpuScene(const host::VulkanContext& context) : objects(context) {}
    void addMeshes(const SceneData&);
    void addMaterials(VkDevice, const lab::Scene&);

    Objects objects;
    VkBuffer vertices = VK_NULL_HANDLE, indices = VK_NULL_HANDLE;
    std::vector<SceneData::Part> parts;
    std::vector<VkDescriptorSet> sets;        // by material
    std::vector<MaterialConstants> constants; // by material, pushed
    ObjectConstants moved;                    // of parts that move, pushed
};

} // namespace rebound::engine
