// SPDX-License-Identifier: MIT
// What every device has in common. A device wraps what the engine already has and offers, with its own types,
//
//   Result<Program> compile(const Plan&)               checks the plan, allocates what it needs, once
//   MemoryUse memoryUse(const Plan&)                   what compile would allocate
//   Result<> Program::record(..., FrameInputs<Image>)  one frame
//   Program::timings()                                 a PassTiming a pass of the last frame, if asked for
//
// where Image is the device's handle to an image of the host.
#pragma once

#include "rebound/plan.hpp"

#include <string_view>

namespace rebound {

template <class Image>
struct NamedImage {
    std::string_view name; // of an input or output of the plan
    Image image;
};

struct NamedConstants {
    std::string_view name; // of frame constants of the plan
    std::vector<std::byte> data;
};

// Everything that the host hands in with a frame. Techniques fill it: see ScreenIndirectFrame.
template <class Image>
struct FrameInputs {
    std::vector<NamedImage<Image>> images;
    std::vector<NamedConstants> constants;
};

struct PassTiming {
    std::string label; // of the pass
    double milliseconds = 0;
};

namespace detail {

// The host's images and constants in the order of the plan's resources, each exactly once.
template <class Image>
struct ResolvedInputs {
    std::vector<const Image*> images;
    std::vector<const void*> constants;
};

template <class Image>
Result<ResolvedInputs<Image>> resolveInputs(const Plan& plan, const FrameInputs<Image>& inputs) {
    ResolvedInputs<Image> resolved{std::vector<const Image*>(plan.resources.size(), nullptr),
                                   std::vector<const void*>(plan.resources.size(), nullptr)};
    for (const NamedImage<Image>& named : inputs.images) {
        const int i = plan.find(named.name);
        const bool external = i >= 0 && (plan.resources[size_t(i)].kind == ResourceKind::input ||
                                         plan.resources[size_t(i)].kind == ResourceKind::output);
        if (!external)
            return invalidArgument("inputs.images: the plan has no input or output named " +
                                   std::string(named.name));
        if (resolved.images[size_t(i)])
            return invalidArgument("inputs.images: " + std::string(named.name) + " is given twice");
        resolved.images[size_t(i)] = &named.image;
    }
    for (const NamedConstants& named : inputs.constants) {
        const int i = plan.find(named.name);
        if (i < 0 || plan.resources[size_t(i)].kind != ResourceKind::frameConstants)
            return invalidArgument("inputs.constants: the plan has no frame constants named " +
                                   std::string(named.name));
        if (named.data.size() != plan.resources[size_t(i)].size)
            return invalidArgument("inputs.constants: " + std::string(named.name) + " has " +
                                   std::to_string(named.data.size()) + " bytes; " +
                                   std::to_string(plan.resources[size_t(i)].size) + " were expected");
        if (resolved.constants[size_t(i)])
            return invalidArgument("inputs.constants: " + std::string(named.name) + " is given twice");
        resolved.constants[size_t(i)] = named.data.data();
    }
    for (size_t i = 0; i < plan.resources.size(); ++i) {
        const Resource& r = plan.resources[i];
        const bool external = r.kind == ResourceKind::input || r.kind == ResourceKind::output;
        if ((external && !resolved.images[i]) ||
            (r.kind == ResourceKind::frameConstants && !resolved.constants[i]))
            return invalidArgument("inputs: " + r.name + " is missing");
    }
    return resolved;
}

} // namespace detail
} // namespace rebound
