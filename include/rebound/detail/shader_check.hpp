// SPDX-License-Identifier: MIT
// Which shader a pass of a plan runs on a GPU, and whether it may.
#pragma once

#include "rebound/detail/kernel_check.hpp"
#include "rebound/shaders.hpp"

#include <span>
#include <string>
#include <vector>

namespace rebound::detail {

// In the order of the tables; null where none has it.
inline const Shader* findShader(const std::vector<std::span<const Shader* const>>& tables,
                                std::string_view name) {
    for (const auto& table : tables)
        for (const Shader* shader : table)
            if (shader->name == name) return shader;
    return nullptr;
}

// What checkKernelUse() checks, and that the pass writes images of the formats that the shader declares.
inline Result<> checkShaderUse(const Plan& plan, const Pass& pass, const Shader& shader) {
    if (auto valid = checkKernelUse(plan, pass, shader.name, shader.info); !valid) return valid.error();
    for (const PassBinding& b : pass.bindings) {
        const Resource& r = plan.resources[size_t(b.resource)];
        const Format declared = shader.info.formats[b.slot];
        if (b.access == Access::write && isImage(r.kind) && r.format != declared)
            return invalidArgument("plan.passes: " + pass.label + " writes " + r.name + ", which is " +
                                   name(r.format) + ", through slot " + std::to_string(b.slot) + " of " +
                                   std::string(shader.name) + ", which is " + name(declared));
    }
    return {};
}

} // namespace rebound::detail
