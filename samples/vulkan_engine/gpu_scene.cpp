// SPDX-License-Identifier: MIT
#include "gpu_scene.hpp"

#include <cstring>

namespace rebound::engine {
namespace {

VkSamplerAddressMode addressMode(lab::Wrap wrap) {
    switch (wrap) {
    case lab::Wrap::mirror:
        return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case lab::Wrap::clamp:
        return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    default:
        return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    }
}

} // namespace

Result<std::unique_ptr<GpuScene>> GpuScene::create(const host::VulkanContext& context,
                                                   const lab::Scene& scene) {
    std::unique_ptr<GpuScene> result(new GpuScene(context));
    result->addMeshes(sceneDataOf(scene));
    result->addMaterials(context.device(), scene);
    result->lights = lightsOf(scene);
    const auto lights = std::as_bytes(std::span(result->lights.lights));
    for (host::VulkanBuffer*& buffer : result->lightBuffers) {
        buffer = result->objects.mappedBuffer(lights.size(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        if (buffer) std::memcpy(buffer->mapped, lights.data(), lights.size());
    }
    if (!result->objects.status()) return result->objects.status().error();
    return result;
}

void GpuScene::addMeshes(const SceneData& data) {
    vertices = objects.buffer(std::as_bytes(std::span(data.vertices)), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    indices = objects.buffer(std::as_bytes(std::span(data.indices)), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    parts = data.parts;
    constants = data.materials;
}

void GpuScene::addMaterials(VkDevice device, const lab::Scene& scene) {
    constexpr VkDescriptorType sampled = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    materialLayout = objects.setLayout({sampled, sampled}, VK_SHADER_STAGE_FRAGMENT_BIT);
    const std::byte white[4] = {std::byte(255), std::byte(255), std::byte(255), std::byte(255)};
    std::vector<Objects::Image> images = {objects.texture({1, 1}, VK_FORMAT_R8G8B8A8_SRGB, white)};
    std::vector<VkSampler> samplers = {
        objects.sampler(VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_REPEAT)};
    for (const lab::Texture& texture : scene.textures) {
        images.push_back(objects.texture({texture.width, texture.height}, VK_FORMAT_R8G8B8A8_SRGB,
                                         std::as_bytes(std::span(texture.rgba))));
        samplers.push_back(
            objects.sampler(VK_FILTER_LINEAR, addressMode(texture.wrapS), addressMode(texture.wrapT)));
    }
    const uint32_t count = uint32_t(scene.materials.size());
    const VkDescriptorPool pool = objects.descriptorPool(count, {{sampled, 2 * count}});
    for (const lab::Material& material : scene.materials) {
        const VkDescriptorSet set = objects.descriptorSet(pool, materialLayout);
        if (objects.failed()) return;
        uint32_t binding = 0;
        for (int texture : {material.baseColorTexture, material.emissionTexture}) {
            const size_t index = size_t(texture + 1); // lab::none is -1: white
            writeImage(device, set, binding++, sampled, samplers[index], images[index].view,
                       VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        }
        sets.push_back(set);
    }
}

// Lights that are switched off stay in the list, so that it keeps its length.
void GpuScene::set(const Moment& moment, int frame) {
    moved.previousOffset = moved.offset;
    moved.offset = glm::vec4(moment.offset, 0.0f);
    lights = moment.lights;
    const auto bytes = std::as_bytes(std::span(lights.lights));
    std::memcpy(lightBuffers[size_t(frame)]->mapped, bytes.data(), bytes.size());
}

void GpuScene::draw(VkCommandBuffer commands, VkPipelineLayout layout) const {
    const VkDeviceSize start = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &start);
    vkCmdBindIndexBuffer(commands, indices, 0, VK_INDEX_TYPE_UINT32);
    for (const SceneData::Part& part : parts) {
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 1, 1, &sets[part.material],
                                0, nullptr);
        constexpr VkShaderStageFlags stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
        const ObjectConstants object = part.moves ? moved : ObjectConstants{};
        vkCmdPushConstants(commands, layout, stages, 0, sizeof(MaterialConstants), &constants[part.material]);
        vkCmdPushConstants(commands, layout, stages, sizeof(MaterialConstants), sizeof object, &object);
        vkCmdDrawIndexed(commands, part.indexCount, 1, part.firstIndex, part.vertexOffset, 0);
    }
}

} // namespace rebound::engine
