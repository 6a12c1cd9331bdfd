// SPDX-License-Identifier: MIT
// Shaders with the layouts of their slots, and pipelines for their features; kept by the device, so that a plan of
// another size compiles none.
#include "device_state.hpp"

namespace rebound::vulkan {
namespace {

Result<> createSetLayout(const Device::Shared& d, const Shader& shader, Kernel& kernel) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (uint32_t slot = 0; slot < uint32_t(slotCount); ++slot) {
        const BindingKind kind = shader.info.kinds[slot];
        if (kind == BindingKind::none) continue;
        VkDescriptorSetLayoutBinding b{slot, descriptorType(kind), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
        if (b.descriptorType == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER) b.pImmutableSamplers = &d.sampler;
        bindings.push_back(b);
    }
    auto info =
        structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    info.bindingCount = uint32_t(bindings.size());
    info.pBindings = bindings.data();
    return d.check(d.vk.CreateDescriptorSetLayout(d.device, &info, nullptr, &kernel.setLayout),
                   "creating the descriptor set layout of " + std::string(shader.name));
}

// On failure the kernel keeps what was made; the device destroys it.
Result<> createKernel(const Device::Shared& d, const Shader& shader, Kernel& kernel) {
    const std::string name(shader.name);
    auto moduleInfo = structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    moduleInfo.codeSize = shader.spirv.size_bytes();
    moduleInfo.pCode = shader.spirv.data();
    if (!kernel.module)
        if (auto made = d.check(d.vk.CreateShaderModule(d.device, &moduleInfo, nullptr, &kernel.module),
                                "creating the shader module of " + name);
            !made)
            return made;
    if (!kernel.setLayout)
        if (auto made = createSetLayout(d, shader, kernel); !made) return made;
    auto layoutInfo = structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    layoutInfo.setLayoutCount = 1;
    layoutInfo.pSetLayouts = &kernel.setLayout;
    if (!kernel.layout)
        if (auto made = d.check(d.vk.CreatePipelineLayout(d.device, &layoutInfo, nullptr, &kernel.layout),
                                "creating the pipeline layout of " + name);
            !made)
            return made;
    d.setName(VK_OBJECT_TYPE_SHADER_MODULE, handleBits(kernel.module), name);
    return {};
}

Result<VkPipeline> createPipeline(const Device::Shared& d, const Shader& shader, const Kernel& kernel,
                                  const std::vector<int>& features) {
    std::vector<VkSpecializationMapEntry> entries;
    for (uint32_t i = 0; i < features.size(); ++i)
        entries.push_back({i, i * uint32_t(sizeof(int)), sizeof(int)});
    const VkSpecializationInfo specialization{uint32_t(entries.size()), entries.data(),
                                              features.size() * sizeof(int), features.data()};
    auto info = structure<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = kernel.module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &specialization;
    info.layout = kernel.layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    if (auto made = d.check(d.vk.CreateComputePipelines(d.device, d.cache, 1, &info, nullptr, &pipeline),
                            "creating a pipeline of " + std::string(shader.name));
        !made)
        return made.error();
    std::string name(shader.name);
    for (int value : features) name.append(" ").append(std::to_string(value)); // GCC bug 105651
    d.setName(VK_OBJECT_TYPE_PIPELINE, handleBits(pipeline), name);
    return pipeline;
}

} // namespace

Result<const Kernel*> obtainKernel(Device::Shared& d, const Shader& shader) {
    const std::lock_guard lock(d.mutex);
    Kernel& kernel = d.kernels[&shader];
    if (!kernel.layout)
        if (auto made = createKernel(d, shader, kernel); !made) return made.error();
    return static_cast<const Kernel*>(&kernel);
}

Result<VkPipeline> obtainPipeline(Device::Shared& d, const Shader& shader, const std::vector<int>& features) {
    const std::lock_guard lock(d.mutex);
    Kernel& kernel = d.kernels[&shader];
    if (const auto found = kernel.pipelines.find(features); found != kernel.pipelines.end())
        return found->second;
    auto pipeline = createPipeline(d, shader, kernel, features);
    if (pipeline) kernel.pipelines.emplace(features, *pipeline);
    return pipeline;
}

} // namespace rebound::vulkan
