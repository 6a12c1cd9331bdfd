// SPDX-License-Identifier: MIT
// A deferred renderer: shadow map, G-buffer, direct light, Rebound's indirect light. One queue, two frames in flight.
#pragma once

#include "baked_light.hpp"
#include "camera.hpp"
#include "gpu_scene.hpp"
#include "indirect_light.hpp"
#include "passes.hpp"

#include "lab/engine/command_line.hpp"
#include "lab/images/image.hpp"

namespace rebound::engine {

// Images of the size of the picture. Frames in flight share them: on one queue, barriers keep frames apart.
struct Targets {
    explicit Targets(const host::VulkanContext& context) : objects(context) {}
    Objects objects;
    Objects::Image depth, normal, albedo, emission,
        motion;                        // depth: reversed; motion: what temporal techniques will read
    Objects::Image lit;                // emission + albedo * E / pi
    Objects::Image radiance;           // what of it surfaces send to be gathered
    Objects::Image indirect, composed; // written by Rebound
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    std::array<VkDescriptorSet, framesInFlight> lightSets{};
    bool used = false; // until then, images have no layout
};

class Renderer {
public:
    // The context outlives it; not the scene.
    static Result<std::unique_ptr<Renderer>> create(const host::VulkanContext&, const lab::Scene&,
                                                    std::string preset, vulkan::MemoryAllocator = {});
    // With indirect light from the scene's bake instead of the screen's.
    static Result<std::unique_ptr<Renderer>> create(const host::VulkanContext&, const lab::Scene&,
                                                    const Bake&);

    // Before the first frame, and whenever the size, or the kind of the camera, changes.
    Result<> resize(Extent2D, const lab::CameraView&);

    // Records a frame; frame: 0 or 1, and the GPU is done with the one before of that number. Afterwards composed waits
    // in layout GENERAL, written by compute shaders.
    Result<> record(VkCommandBuffer, int frame, const lab::CameraView&);

    // What moves is there in the frame of that number, to be recorded next.
    void set(const Moment& moment, int frame) { scene->set(moment, frame); }

    const Targets& targets() const { return *current; }
    const IndirectLight& indirectLight() const { return indirect; }
    const BakedLight* bakedLight() const { return baked.get(); }
    // Of whichever light there is.
    Result<std::vector<PassTiming>> timings() const { return baked ? baked->timings() : indirect.timings(); }
    MemoryUse memoryUse() const { return baked ? baked->memoryUse() : indirect.memoryUse(); }
    const Objects::Image& shadows() const { return shadowMap; }

    // The image's first channels, once the GPU is done: for pictures and tests. It was last written by compute shaders,
    // or was an attachment. Device depth is one channel.
    Result<lab::Image> read(const Objects::Image&, int channels) const;

private:
    Renderer(const host::VulkanContext& c, std::string p, IndirectLight light)
        : context(c), preset(std::move(p)), objects(c), indirect(std::move(light)) {}
    Result<> createOnce(const lab::Scene&);
    void makeTargets(Targets&, Extent2D);
    void writeFrame(int frame, const lab::CameraView&, const Camera&);
    void recordRasterPass(VkCommandBuffer, int frame, VkRenderPass, VkFramebuffer, VkPipeline,
                          VkPipelineLayout, Extent2D, std::span<const VkClearValue>) const;
    void recordLightPass(VkCommandBuffer, int frame) const;
    ScreenIndirectFrame<vulkan::Image> indirectFrame(const Camera&) const;
    IlluminanceCompositionFrame<vulkan::Image> bakedFrame(const Camera&) const;
    Result<> recordIndirect(VkCommandBuffer, int frame, const Camera&);
    Result<> compile(const lab::CameraView&, Extent2D);

    const host::VulkanContext& context;
    std::string preset;
    Objects objects;
    std::unique_ptr<GpuScene> scene;
    Passes passes;
    host::VulkanBuffer* frameBuffer = nullptr;
    uint32_t largestSide = 0;     // of the device's images [texels]
    VkDeviceSize frameStride = 0; // from one frame's constants to the next [bytes]
    VkDescriptorSet frameSet = VK_NULL_HANDLE;
    Objects::Image shadowMap;
    VkFramebuffer shadowFramebuffer = VK_NULL_HANDLE;
    std::optional<glm::mat4> previousViewProjection;
    IndirectLight indirect;
    std::unique_ptr<BakedLight> baked;
    std::shared_ptr<Targets> current;

    // What a resize has replaced, and how many frames have been recorded since: kept until the GPU is done with it.
    struct Retired {
        std::shared_ptr<const void> object;
        int age = 0;
    };
    std::vector<Retired> retired;
    void retire(std::shared_ptr<const void> object) { retired.push_back({std::move(object)}); }
    void destroyRetired();
};

// As the options say: with the screen's light, or with that of a bake, which is read.
Result<std::unique_ptr<Renderer>> createRenderer(const host::VulkanContext&, const lab::Scene&,
                                                 const Options&);

} // namespace rebound::engine
