// SPDX-License-Identifier: MIT
// Definitions of plan.hpp: plans behind plans.

namespace rebound {
namespace detail {

inline bool isGivenByHost(ResourceKind k) {
    return isHostImage(k) || isHostBuffer(k) || k == ResourceKind::frameConstants;
}

inline std::string describe(const Resource& r) {
    std::string text = name(r.kind);
    if (isImage(r.kind))
        return text.append(" of ").append(toText(r.extent)).append(" ").append(name(r.format));
    return text.append(" of ").append(std::to_string(r.size)).append(" bytes");
}

// Carries a plan's resources and passes over into a copy of another.
class Appender {
public:
    Appender(const Plan& plan, const Plan& added, const AppendOptions& o)
        : result(plan), appended(added), options(o) {}

    Result<Plan> join() {
        if (auto known = checkBindings(); !known) return known.error();
        for (const Resource& r : appended.resources) {
            auto index = carry(r);
            if (!index) return index.error();
            indices.push_back(*index);
        }
        for (Pass pass : appended.passes) {
            pass.label = options.prefix + pass.label;
            if (std::ranges::any_of(result.passes, [&](const Pass& p) { return p.label == pass.label; }))
                return invalidArgument("append: both plans have a pass labelled " + pass.label +
                                       "; a prefix that tells them apart was expected");
            for (PassBinding& b : pass.bindings) b.resource = indices[size_t(b.resource)];
            result.passes.push_back(std::move(pass));
        }
        if (!result.technique.empty()) result.technique.append(" + ");
        result.technique.append(appended.technique);
        if (auto valid = validate(result); !valid) return valid.error();
        return std::move(result);
    }

private:
    Plan result;
    const Plan& appended;
    const AppendOptions& options;
    std::vector<ResourceIndex> indices; // in the result, by resource of the appended plan

    Result<> checkBindings() const {
        for (const PlanBinding& b : options.bindings) {
            const int i = appended.find(b.resource);
            const bool isInput = i >= 0 && isGivenByHost(appended.resources[size_t(i)].kind) &&
                                 !isWritable(appended.resources[size_t(i)].kind);
            if (!isInput)
                return invalidArgument("append: bindings name " + b.resource +
                                       ", which is no input of the appended plan");
            if (result.find(b.source) < 0)
                return invalidArgument("append: bindings bind " + b.resource + " to " + b.source +
                                       ", which the plan does not have");
        }
        return {};
    }

    // Whether what one plan has can stand for what the other wants.
    static bool serves(const Resource& has, const Resource& wants) {
        if (isImage(wants.kind))
            return isImage(has.kind) && has.extent == wants.extent && has.channels >= wants.channels &&
                   isInteger(has.format) == isInteger(wants.format);
        if (wants.kind == ResourceKind::frameConstants)
            return has.kind == wants.kind && has.size == wants.size;
        return !isImage(has.kind) && has.kind != ResourceKind::frameConstants &&
               has.kind != ResourceKind::frameState && has.size >= wants.size;
    }

    Result<ResourceIndex> carry(const Resource& r) {
        for (const PlanBinding& b : options.bindings)
            if (b.resource == r.name) return bind(r, result.find(b.source));
        if (r.kind == ResourceKind::frameState)
            for (size_t i = 0; i < result.resources.size(); ++i)
                if (result.resources[i].kind == r.kind) return ResourceIndex(i);
        Resource carried = r;
        if (isGivenByHost(r.kind)) carried.name = options.hostPrefix + r.name;
        else if (r.kind != ResourceKind::frameState) carried.name = options.prefix + r.name;
        const int known = result.find(carried.name);
        if (known < 0) return result.add(std::move(carried));
        return merge(carried, known);
    }

    Result<ResourceIndex> bind(const Resource& r, ResourceIndex source) const {
        const Resource& has = result.resources[size_t(source)];
        if (!serves(has, r))
            return invalidArgument("append: " + r.name + ", which is " + describe(r) + ", is bound to " +
                                   has.name + ", which is " + describe(has));
        return source;
    }

    Result<ResourceIndex> merge(const Resource& r, ResourceIndex known) {
        Resource& has = result.resources[size_t(known)];
        const bool isRead = isGivenByHost(r.kind) && !isWritable(r.kind) && r.kind == has.kind;
        if (!isRead)
            return invalidArgument("append: both plans have " + r.name +
                                   "; a prefix that tells them apart was expected");
        Resource wanted = r;
        wanted.channels = 1; // the host hands in as many as either wants
        wanted.size = isHostBuffer(r.kind) ? 0 : r.size;
        if (!serves(has, wanted))
            return invalidArgument("append: " + r.name + " is " + describe(has) + " in one plan and " +
                                   describe(r) + " in the other; a host prefix that tells them apart was " +
                                   "expected");
        has.channels = std::max(has.channels, r.channels);
        has.size = std::max(has.size, r.size);
        return known;
    }
};

} // namespace detail

inline Result<> append(Plan& plan, const Plan& appended, const AppendOptions& options) {
    if (auto valid = validate(plan); !valid) return valid.error();
    if (auto valid = validate(appended); !valid) return valid.error();
    auto joined = detail::Appender(plan, appended, options).join();
    if (!joined) return joined.error();
    plan = *std::move(joined);
    return {};
}

inline Result<> keepInside(Plan& plan, std::string_view output) {
    const int i = plan.find(output);
    if (i < 0 || plan.resources[size_t(i)].kind != ResourceKind::output)
        return invalidArgument("output is " + std::string(output) + ", which is no output of the plan");
    plan.resources[size_t(i)].kind = ResourceKind::transient;
    return {};
}

} // namespace rebound
