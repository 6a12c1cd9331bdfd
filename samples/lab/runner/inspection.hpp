// SPDX-License-Identifier: MIT
// What prepared plans of every backend do alike.
#pragma once

#include "lab/runner/runner.hpp"
#include "lab/runner/texels.hpp"

#include <chrono>
#include <string>

namespace rebound::runner {

inline double millisecondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// The output or output buffer of that name, or an error.
inline Result<ResourceIndex> findOutput(const Plan& plan, const std::string& name) {
    const ResourceIndex index = plan.find(name);
    const ResourceKind kind = index < 0 ? ResourceKind::input : plan.resources[size_t(index)].kind;
    if (kind != ResourceKind::output && kind != ResourceKind::outputBuffer)
        return Error{ErrorCode::notFound, "the plan has no output named " + name};
    return index;
}

// PreparedPlan::inspect() where a pass is done when onPass() is called.
//   contents(ResourceIndex) -> Result<lab::Image>, replace(ResourceIndex, const lab::Image&) -> Result<>
template <class Program, class Frame, class Contents, class Replace>
Result<Record> inspectPasses(Program& program, const Frame& frame, const Record* replacement,
                             Contents contents, Replace replace) {
    const Plan& plan = program.plan();
    Record record(plan.passes.size());
    const auto inspectPass = [&](size_t pass) -> Result<> {
        for (const PassBinding& b : plan.passes[pass].bindings) {
            if (b.access != Access::write) continue;
            Result<lab::Image> image = contents(b.resource);
            if (!image) return image.error();
            if (isImage(plan.resources[size_t(b.resource)].kind))
                roundTo(plan.resources[size_t(b.resource)].format, *image);
            std::vector<WrittenImage>& written = record[pass];
            const lab::Image& next = replacement ? (*replacement)[pass][written.size()].image : *image;
            if (Result<> replaced = replace(b.resource, next); !replaced) return replaced;
            written.push_back({b.resource, *std::move(image)});
        }
        return {};
    };
    Result<> done;
    program.onPass([&](int pass) {
        if (done) done = inspectPass(size_t(pass));
    });
    const Result<> recorded = program.record(frame);
    program.onPass({});
    if (!recorded) return recorded.error();
    if (!done) return done.error();
    return record;
}

} // namespace rebound::runner
