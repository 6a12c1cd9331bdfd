// SPDX-License-Identifier: MIT
// Whether a pass binds what its kernel declares; the same for every device.
#pragma once

#include "rebound/kernel/kernel_interface.h"
#include "rebound/plan.hpp"

#include <string>
#include <string_view>

namespace rebound::detail {

// Of kinds alone.
inline bool fits(BindingKind kind, const Resource& r, Access access) {
    const bool reads = access != Access::write;
    const bool isOwnImage = r.kind == ResourceKind::transient || r.kind == ResourceKind::history;
    const bool isConstants = r.kind == ResourceKind::frameConstants || r.kind == ResourceKind::frameState;
    switch (kind) {
    case BindingKind::none:
        return false;
    case BindingKind::texture:
    case BindingKind::uintTexture:
        return reads && isOwnImage;
    case BindingKind::input:
    case BindingKind::uintInput:
        return reads && isImage(r.kind);
    case BindingKind::image:
        return !reads && isOwnImage;
    case BindingKind::output:
        return !reads && isImage(r.kind);
    case BindingKind::buffer:
    case BindingKind::values:
        return reads && !isImage(r.kind) && !isConstants;
    case BindingKind::outputValues:
        return !reads && !isImage(r.kind);
    case BindingKind::constants:
        return reads && (isConstants || r.kind == ResourceKind::buffer);
    }
    return false;
}

// Whether the kernel takes the slot's image for one of unsigned integers.
inline bool takesIntegers(const KernelInfo& info, int slot) {
    const BindingKind kind = info.kinds[slot];
    return kind == BindingKind::uintTexture || kind == BindingKind::uintInput ||
           isInteger(info.formats[slot]);
}

inline Result<> checkBinding(const Plan& plan, const Pass& pass, const PassBinding& binding,
                             std::string_view kernel, const KernelInfo& info) {
    const Resource& r = plan.resources[size_t(binding.resource)];
    const size_t atLeast = info.sizes[binding.slot];
    const std::string what = "plan.passes: " + pass.label;
    const std::string slot = "slot " + std::to_string(binding.slot) + " of " + std::string(kernel);
    if (!fits(info.kinds[binding.slot], r, binding.access))
        return invalidArgument(what + " binds " + r.name + " to " + slot + ", which does not take it");
    const BindingKind kind = info.kinds[binding.slot];
    const bool isOfNumbers = kind == BindingKind::values || kind == BindingKind::outputValues;
    if (isOfNumbers && r.format != info.formats[binding.slot])
        return invalidArgument(what + " binds " + r.name + ", which is of " + name(r.format) + ", to " +
                               slot + ", which is of " + name(info.formats[binding.slot]));
    if (isImage(r.kind) && isInteger(r.format) != takesIntegers(info, binding.slot))
        return invalidArgument(what + " binds " + r.name + ", which is " + name(r.format) + ", to " + slot +
                               ", which takes " +
                               (takesIntegers(info, binding.slot) ? "unsigned integers" : "floats"));
    if (binding.access == Access::write && isImage(r.kind) && r.extent != pass.grid)
        return invalidArgument(what + " writes " + r.name + ", whose size is not that of the pass's grid");
    const bool isCovered = r.extent.width >= pass.grid.width && r.extent.height >= pass.grid.height;
    if ((info.grids >> binding.slot & 1) != 0 && !isCovered)
        return invalidArgument(what + " binds " + r.name + ", which is " + toText(r.extent) + ", to " + slot +
                               ", which reads it at every pixel of a grid of " + toText(pass.grid));
    if (r.size < atLeast)
        return invalidArgument(what + " binds " + r.name + ", which has " + std::to_string(r.size) +
                               " bytes, to " + slot + ", which takes " + std::to_string(atLeast));
    return {};
}

inline int combinationOf(const Pass& pass, const KernelInfo& info) {
    int index = 0, stride = 1;
    for (size_t i = 0; i < pass.features.size(); ++i) {
        index += stride * pass.features[i];
        stride *= info.featureCounts[i];
    }
    return index;
}

inline Result<> checkFeatures(const Pass& pass, std::string_view kernel, const KernelInfo& info) {
    for (size_t i = 0; i < pass.features.size(); ++i)
        if (const int count = info.featureCounts[i]; pass.features[i] < 0 || pass.features[i] >= count)
            return invalidArgument("plan.passes: " + pass.label + " sets feature " + std::to_string(i) +
                                   " of " + std::string(kernel) + " to " + std::to_string(pass.features[i]) +
                                   "; 0 to " + std::to_string(count - 1) + " was expected");
    if (info.combinations[combinationOf(pass, info)]) return {};
    std::string values;
    for (int value : pass.features) values.append(values.empty() ? "" : ",").append(std::to_string(value));
    return invalidArgument("plan.passes: " + pass.label + " sets the features of " + std::string(kernel) +
                           " to " + values + ", which is not among the combinations that it lists");
}

// Features within their ranges and combined as the kernel lists, each slot bound to what it takes, none left out. Of a valid
// plan.
inline Result<> checkKernelUse(const Plan& plan, const Pass& pass, std::string_view kernel,
                               const KernelInfo& info) {
    if (auto valid = checkFeatures(pass, kernel, info); !valid) return valid;
    if (info.forItems != (pass.items > 0))
        return invalidArgument("plan.passes: " + pass.label + " runs " + std::string(kernel) + " for " +
                               (info.forItems ? "pixels; items were" : "items; pixels were") + " expected");
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
