// SPDX-License-Identifier: MIT
// Definitions of plan.hpp.

#include <set>

namespace rebound {
namespace detail {

inline bool isImage(ResourceKind kind) {
    return kind == ResourceKind::input || kind == ResourceKind::output || kind == ResourceKind::transient;
}

inline const char* name(ResourceKind kind) {
    switch (kind) {
    case ResourceKind::input:
        return "input";
    case ResourceKind::output:
        return "output";
    case ResourceKind::transient:
        return "transient";
    case ResourceKind::buffer:
        return "buffer";
    case ResourceKind::frameConstants:
        return "frame constants";
    }
    return "?";
}

inline std::string toText(Extent2D extent) {
    return std::to_string(extent.width) + "x" + std::to_string(extent.height);
}

inline bool isValidExtent(Extent2D e) {
    return e.width >= 1 && e.height >= 1 && e.width <= maximumExtent && e.height <= maximumExtent;
}

inline Result<> validateResource(const Resource& r) {
    if (r.name.empty()) return invalidArgument("plan.resources holds a resource without a name");
    const std::string what = "plan.resources: " + r.name;
    if (isImage(r.kind) && !isValidExtent(r.extent))
        return invalidArgument(what + " is " + toText(r.extent) + "; 1x1 to " +
                               toText({maximumExtent, maximumExtent}) + " was expected");
    if (isImage(r.kind) && (r.channels < 1 || r.channels > 4))
        return invalidArgument(what + " has " + std::to_string(r.channels) +
                               " channels; 1 to 4 were expected");
    if (!isImage(r.kind) && r.size == 0) return invalidArgument(what + " is empty");
    if (r.kind == ResourceKind::buffer && r.data.size() != r.size)
        return invalidArgument(what + " says " + std::to_string(r.size) + " bytes and holds " +
                               std::to_string(r.data.size()));
    return {};
}

inline Result<> validatePass(const Plan& plan, const Pass& pass, std::vector<bool>& written) {
    const std::string what = "plan.passes: " + pass.label;
    if (!isValidExtent(pass.grid))
        return invalidArgument(what + " runs for " + toText(pass.grid) + " pixels");
    if (pass.features.size() > 4) return invalidArgument(what + " has more than 4 features");
    std::set<int> slots, read, writes;
    for (const PassBinding& b : pass.bindings) {
        if (b.slot < 0 || b.slot >= 16 || !slots.insert(b.slot).second)
            return invalidArgument(what + " binds slot " + std::to_string(b.slot) +
                                   ", which is outside 0 to 15 or bound twice");
        if (b.resource < 0 || b.resource >= int(plan.resources.size()))
            return invalidArgument(what + " binds resource " + std::to_string(b.resource) +
                                   ", which does not exist");
        const Resource& r = plan.resources[size_t(b.resource)];
        if (b.access == Access::write && r.kind != ResourceKind::output && r.kind != ResourceKind::transient)
            return invalidArgument(what + " writes " + r.name + ", which is " + name(r.kind));
        const bool madeHere = r.kind == ResourceKind::transient || r.kind == ResourceKind::output;
        if (b.access == Access::read && madeHere && !written[size_t(b.resource)])
            return invalidArgument(what + " reads " + r.name + " before a pass has written it");
        (b.access == Access::read ? read : writes).insert(b.resource);
    }
    for (int r : writes) {
        if (read.contains(r))
            return invalidArgument(what + " reads and writes " + plan.resources[size_t(r)].name);
        written[size_t(r)] = true;
    }
    return {};
}

} // namespace detail

inline Result<> validate(const Plan& plan) {
    std::set<std::string> names, labels;
    for (const Resource& r : plan.resources) {
        if (auto valid = detail::validateResource(r); !valid) return valid.error();
        if (!names.insert(r.name).second)
            return invalidArgument("plan.resources holds two resources named " + r.name);
    }
    std::vector<bool> written(plan.resources.size(), false);
    for (const Pass& pass : plan.passes) {
        if (pass.label.empty() || !labels.insert(pass.label).second)
            return invalidArgument("plan.passes: the label \"" + pass.label + "\" is empty or used twice");
        if (auto valid = detail::validatePass(plan, pass, written); !valid) return valid.error();
    }
    return {};
}

// Text is appended piece by piece: GCC 12 takes "literal" + std::string for an overlap (GCC bug 105651).
inline std::string toText(const Plan& plan) {
    std::string text = "plan ";
    text.append(plan.technique).append("\n");
    for (const Resource& r : plan.resources) {
        text.append("resource ").append(r.name).append(": ").append(detail::name(r.kind)).append(" ");
        if (detail::isImage(r.kind))
            text.append(detail::toText(r.extent))
                .append(" ")
                .append(name(r.format))
                .append(", ")
                .append(std::to_string(r.channels))
                .append(r.channels == 1 ? " channel" : " channels");
        else text.append(std::to_string(r.size)).append(" bytes");
        text.append("\n");
    }
    for (const Pass& pass : plan.passes) {
        text.append("pass ").append(pass.label).append(": ").append(pass.kernel);
        for (size_t i = 0; i < pass.features.size(); ++i)
            text.append(i == 0 ? " <" : ",").append(std::to_string(pass.features[i]));
        text.append(pass.features.empty() ? " for " : "> for ").append(detail::toText(pass.grid));
        for (const PassBinding& b : pass.bindings)
            text.append(b.access == Access::read ? ", reads " : ", writes ")
                .append(plan.resources[size_t(b.resource)].name);
        text.append("\n");
    }
    return text;
}

} // namespace rebound
