// SPDX-License-Identifier: MIT
// Whether a pass binds what its kernel declares; the same for every device.
#pragma once

#include "rebound/kernel/kernel_interface.h"
#include "rebound/plan.hpp"

#include <string>
#include <string_view>

namespace rebound::detail {

inline bool fits(BindingKind kind, const Resource& r, Access access) {
    const bool reads = access == Access::read;
    switch (kind) {
    case BindingKind::none:
        return false;
    case BindingKind::texture:
        return reads && r.kind == ResourceKind::transient;
    case BindingKind::input:
        return reads && isImage(r.kind);
    case BindingKind::image:
        return !reads && r.kind == ResourceKind::transient;
    case BindingKind::output:
        return !reads && (r.kind == ResourceKind::output || r.kind == ResourceKind::transient);
    case BindingKind::buffer:
        return reads && r.kind == ResourceKind::buffer;
    case BindingKind::constants:
        return reads && (r.kind == ResourceKind::buffer || r.kind == ResourceKind::frameConstants);
    }
    return false;
}

inline Result<> checkBinding(const Plan& plan, const Pass& pass, const PassBinding& binding,
                             std::string_view kernel, const KernelInfo& info) {
    const Resource& r = plan.resources[size_t(binding.resource)];
    const size_t atLeast = info.sizes[binding.slot];
    const std::string slot = "slot " + std::to_string(binding.slot) + " of " + std::string(kernel);
    if (!fits(info.kinds[binding.slot], r, binding.access))
        return invalidArgument("plan.passes: " + pass.label + " binds " + r.name + " to " + slot +
                               ", which does not take it");
    if (binding.access == Access::write && r.extent != pass.grid)
        return invalidArgument("plan.passes: " + pass.label + " writes " + r.name +
                               ", whose size is not that of the pass's grid");
    const bool isCovered = r.extent.width >= pass.grid.width && r.extent.height >= pass.grid.height;
    if ((info.grids >> binding.slot & 1) != 0 && !isCovered)
        return invalidArgument("plan.passes: " + pass.label + " binds " + r.name + ", which is " +
                               toText(r.extent) + ", to " + slot +
                               ", which reads it at every pixel of a grid of " + toText(pass.grid));
    if (r.size < atLeast)
        return invalidArgument("plan.passes: " + pass.label + " binds " + r.name + ", which has " +
                               std::to_string(r.size) + " bytes, to " + slot + ", which takes " +
                               std::to_string(atLeast));
    return {};
}

// Features within their ranges, each slot bound to what it takes, none left out. Of a valid plan.
inline Result<> checkKernelUse(const Plan& plan, const Pass& pass, std::string_view kernel,
                               const KernelInfo& info) {
    for (size_t i = 0; i < pass.features.size(); ++i)
        if (const int count = info.featureCounts[i]; pass.features[i] < 0 || pass.features[i] >= count)
            return invalidArgument("plan.passes: " + pass.label + " sets feature " + std::to_string(i) +
                                   " of " + std::string(kernel) + " to " + std::to_string(pass.features[i]) +
                                   "; 0 to " + std::to_string(count - 1) + " was expected");
    bool bound[slotCount] = {};
    for (const PassBinding& binding : pass.bindings) {
        if (auto valid = checkBinding(plan, pass, binding, kernel, info); !valid) return valid.error();
        bound[binding.slot] = true;
    }
    for (int slot = 0; slot < slotCount; ++slot)
        if (info.kinds[slot] != BindingKind::none && !bound[slot])
            return invalidArgument("plan.passes: " + pass.label + " leaves slot " + std::to_string(slot) +
                                   " of " + std::string(kernel) + " unbound");
    return {};
}

inline Error unknownKernel(const Pass& pass) {
    return {ErrorCode::notFound, "plan.passes: " + pass.label + " runs " + pass.kernel +
                                     ", which is not among the kernels of this device"};
}

} // namespace rebound::detail
