// SPDX-License-Identifier: MIT
// Definitions of plan.hpp.

#include <array>
#include <set>

namespace rebound {

inline const char* name(Format f) {
    constexpr std::array<const char*, 5> names{"r32f", "rgba16f", "rgba32f", "r32ui", "rgba32ui"};
    static_assert(names.size() == size_t(Format::rgba32ui) + 1);
    return names[size_t(f)];
}

inline const char* name(ResourceKind kind) {
    constexpr std::array<const char*, 11> names{"input",           "output",           "transient",
                                                "history",         "buffer",           "input buffer",
                                                "output buffer",   "transient buffer", "persistent buffer",
                                                "frame constants", "frame state"};
    static_assert(names.size() == size_t(ResourceKind::frameState) + 1);
    return names[size_t(kind)];
}

inline Resource frameStateResource() {
    return {"frame state", ResourceKind::frameState, Format::r32f, 1, {}, {}, 4 * sizeof(int32_t)};
}

inline size_t sizeOf(const Resource& r) {
    return isImage(r.kind) ? bytesPerTexel(r.format) * size_t(r.extent.width) * size_t(r.extent.height)
                           : r.size;
}

namespace detail {

inline std::string toText(Extent2D extent) {
    return std::to_string(extent.width) + "x" + std::to_string(extent.height);
}

inline bool isValidExtent(Extent2D e) {
    return e.width >= 1 && e.height >= 1 && e.width <= maximumExtent && e.height <= maximumExtent;
}

inline Result<> validateSize(const Resource& r, const std::string& what) {
    if (r.size == 0) return invalidArgument(what + " is empty");
    if (r.size > maximumBufferSize)
        return invalidArgument(what + " has " + std::to_string(r.size) + " bytes; at most " +
                               std::to_string(maximumBufferSize) + " were expected");
    const size_t held = r.data ? r.data->size() : 0;
    if (r.kind == ResourceKind::buffer && held != r.size)
        return invalidArgument(what + " says " + std::to_string(r.size) + " bytes and holds " +
                               std::to_string(held));
    if (r.kind == ResourceKind::frameState && r.size != frameStateResource().size)
        return invalidArgument(what + " has " + std::to_string(r.size) + " bytes; " +
                               std::to_string(frameStateResource().size) + " were expected");
    return {};
}

inline Result<> validateResource(const Resource& r) {
    if (r.name.empty()) return invalidArgument("plan.resources holds a resource without a name");
    const std::string what = "plan.resources: " + r.name;
    if (!isImage(r.kind)) return validateSize(r, what);
    if (!isValidExtent(r.extent))
        return invalidArgument(what + " is " + toText(r.extent) + "; 1x1 to " +
                               toText({maximumExtent, maximumExtent}) + " was expected");
    if (r.channels < 1 || r.channels > 4)
        return invalidArgument(what + " has " + std::to_string(r.channels) +
                               " channels; 1 to 4 were expected");
    return {};
}

inline Result<> validateRange(const Pass& pass, const std::string& what) {
    const bool hasGrid = pass.grid.width != 0 || pass.grid.height != 0;
    if (pass.items == 0 && !isValidExtent(pass.grid))
        return invalidArgument(what + " runs for " + toText(pass.grid) + " pixels");
    if (pass.items != 0 && hasGrid)
        return invalidArgument(what + " has a grid of " + toText(pass.grid) + " pixels and " +
                               std::to_string(pass.items) + " items; one of both was expected");
    if (pass.items < 0 || pass.items > maximumItems)
        return invalidArgument(what + " runs for " + std::to_string(pass.items) + " items; 1 to " +
                               std::to_string(maximumItems) + " was expected");
    return {};
}

inline Result<> validateBinding(const Plan& plan, const PassBinding& b, const std::string& what,
                                const std::vector<bool>& written) {
    if (b.resource < 0 || b.resource >= int(plan.resources.size()))
        return invalidArgument(what + " binds resource " + std::to_string(b.resource) +
                               ", which does not exist");
    const Resource& r = plan.resources[size_t(b.resource)];
    if (b.access == Access::write && !isWritable(r.kind))
        return invalidArgument(what + " writes " + r.name + ", which is " + name(r.kind));
    if (b.access == Access::readPrevious && r.kind != ResourceKind::history)
        return invalidArgument(what + " reads what the frame before has left in " + r.name + ", which is " +
                               name(r.kind) + "; history was expected");
    // A persistent buffer holds the frame before until then.
    const bool madeHere = isWritable(r.kind) && r.kind != ResourceKind::persistentBuffer;
    if (b.access == Access::read && madeHere && !written[size_t(b.resource)])
        return invalidArgument(what + " reads " + r.name + " before a pass has written it");
    return {};
}

inline Result<> validatePass(const Plan& plan, const Pass& pass, std::vector<bool>& written) {
    const std::string what = "plan.passes: " + pass.label;
    if (auto valid = validateRange(pass, what); !valid) return valid;
    if (pass.features.size() > 4) return invalidArgument(what + " has more than 4 features");
    std::set<int> slots, read, writes;
    for (const PassBinding& b : pass.bindings) {
        if (b.slot < 0 || b.slot >= slotCount || !slots.insert(b.slot).second)
            return invalidArgument(what + " binds slot " + std::to_string(b.slot) +
                                   ", which is outside 0 to 15 or bound twice");
        if (auto valid = validateBinding(plan, b, what, written); !valid) return valid;
        if (b.access == Access::read) read.insert(b.resource);
        if (b.access == Access::write) writes.insert(b.resource);
    }
    for (int r : writes) {
        if (read.contains(r) && (!pass.readsElsewhere || isImage(plan.resources[size_t(r)].kind)))
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
    const std::vector<Lifetime> lives = lifetimes(plan);
    for (size_t i = 0; i < written.size(); ++i)
        if (isPersistent(plan.resources[i].kind) && lives[i].last >= 0 && !written[i])
            return invalidArgument("plan.passes read " + plan.resources[i].name + ", which is " +
                                   name(plan.resources[i].kind) + " that no pass writes");
    return {};
}

inline Result<MemoryUse> memoryUse(const Plan& plan) {
    if (auto valid = validate(plan); !valid) return valid.error();
    std::vector<size_t> sizes;
    MemoryUse use;
    for (const Resource& r : plan.resources) {
        sizes.push_back(sizeOf(r));
        if (r.kind == ResourceKind::history) use.persistent += 2 * sizes.back();
        else if (r.kind == ResourceKind::persistentBuffer) use.persistent += sizes.back();
        else if (!isImage(r.kind) && !isTransient(r.kind) && !isHostBuffer(r.kind))
            use.buffers += sizes.back();
    }
    const TransientLayout layout = layoutTransients(plan, sizes, transientAlignment);
    use.transient = layout.size;
    use.transientUnshared = layout.sizeUnshared;
    return use;
}

// Text is appended piece by piece: GCC 12 takes "literal" + std::string for an overlap (GCC bug 105651).
inline std::string toText(const Plan& plan) {
    std::string text = "plan ";
    text.append(plan.technique).append("\n");
    for (const Resource& r : plan.resources) {
        text.append("resource ").append(r.name).append(": ").append(name(r.kind)).append(" ");
        if (isImage(r.kind))
            text.append(detail::toText(r.extent))
                .append(" ")
                .append(name(r.format))
                .append(", ")
                .append(std::to_string(r.channels))
                .append(r.channels == 1 ? " channel" : " channels");
        else text.append(std::to_string(r.size)).append(" bytes");
        text.append("\n");
    }
    constexpr std::array<const char*, 3> verbs{", reads ", ", writes ", ", reads previous "};
    for (const Pass& pass : plan.passes) {
        text.append("pass ").append(pass.label).append(": ").append(pass.kernel);
        for (size_t i = 0; i < pass.features.size(); ++i)
            text.append(i == 0 ? " <" : ",").append(std::to_string(pass.features[i]));
        text.append(pass.features.empty() ? " for " : "> for ");
        if (pass.items > 0) text.append(std::to_string(pass.items)).append(" items");
        else text.append(detail::toText(pass.grid));
        for (const PassBinding& b : pass.bindings)
            text.append(verbs[size_t(b.access)]).append(plan.resources[size_t(b.resource)].name);
        text.append("\n");
    }
    return text;
}

} // namespace rebound
