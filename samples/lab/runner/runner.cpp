// SPDX-License-Identifier: MIT
#include "lab/runner/runner.hpp"

#include <algorithm>
#include <cstring>

namespace rebound::runner {

std::vector<std::string> backendNames() {
    std::vector<std::string> names = {"cpu"};
#ifdef REBOUND_HAS_VULKAN
    names.push_back("vulkan");
#endif
#ifdef REBOUND_HAS_OPENGL
    names.push_back("opengl");
#endif
    return names;
}

std::string toText(const BackendInfo& info) {
    if (info.backend != "cpu") return info.backend + " on " + info.device;
    return info.isa + " on " + std::to_string(info.threads) + (info.threads == 1 ? " thread" : " threads");
}

Result<std::unique_ptr<Backend>> createBackend(const BackendChoice& choice) {
    if (choice.backend == "cpu") return createCpuBackend(choice);
#ifdef REBOUND_HAS_VULKAN
    if (choice.backend == "vulkan") return createVulkanBackend(choice);
#endif
#ifdef REBOUND_HAS_OPENGL
    if (choice.backend == "opengl") return createOpenGLBackend(choice);
#endif
    std::string known;
    for (const std::string& name : backendNames()) known += (known.empty() ? "" : ", ") + name;
    return Error{ErrorCode::notFound,
                 "backend is \"" + choice.backend + "\"; one of " + known + " was expected"};
}

Result<const lab::Image*> findPicture(const Plan& plan, const PlanInputs& inputs, const Resource& r) {
    for (const NamedImage<lab::Image>& picture : inputs.images) {
        if (picture.name != r.name) continue;
        if (picture.image.extent() != r.extent)
            return invalidArgument("inputs: " + r.name + " has " + std::to_string(picture.image.width) +
                                   " x " + std::to_string(picture.image.height) + " pixels; " +
                                   std::to_string(r.extent.width) + " x " + std::to_string(r.extent.height) +
                                   " were expected");
        return &picture.image;
    }
    return invalidArgument("inputs: the plan " + plan.technique + " needs " + r.name);
}

Result<SharedBytes> findBytes(const Plan& plan, const PlanInputs& inputs, const Resource& r) {
    for (const NamedBuffer<SharedBytes>& named : inputs.buffers) {
        if (named.name != r.name || !named.buffer) continue;
        if (named.buffer->size() < r.size) return detail::smallBuffer(r, named.buffer->size());
        return named.buffer;
    }
    return invalidArgument("inputs: the plan " + plan.technique + " needs " + r.name);
}

lab::Image rowOf(std::span<const std::byte> bytes) {
    lab::Image row({int(bytes.size() / sizeof(float)), 1}, 1);
    std::memcpy(row.data.data(), bytes.data(), row.data.size() * sizeof(float));
    return row;
}

std::vector<std::byte> bytesOf(const lab::Image& row) {
    std::vector<std::byte> bytes(row.data.size() * sizeof(float));
    std::memcpy(bytes.data(), row.data.data(), bytes.size());
    return bytes;
}

Result<> checkInputs(const Plan& plan, const PlanInputs& inputs) {
    for (const Resource& r : plan.resources) {
        if (r.kind == ResourceKind::input)
            if (auto picture = findPicture(plan, inputs, r); !picture) return picture.error();
        if (r.kind == ResourceKind::inputBuffer)
            if (auto bytes = findBytes(plan, inputs, r); !bytes) return bytes.error();
        if (r.kind != ResourceKind::frameConstants) continue;
        const auto constants = std::find_if(inputs.constants.begin(), inputs.constants.end(),
                                            [&](const NamedConstants& c) { return c.name == r.name; });
        if (constants == inputs.constants.end())
            return invalidArgument("inputs: the plan " + plan.technique + " needs " + r.name);
        if (constants->data.size() != r.size)
            return invalidArgument("inputs: " + r.name + " has " + std::to_string(constants->data.size()) +
                                   " bytes; " + std::to_string(r.size) + " were expected");
    }
    return {};
}

Result<double> PreparedPlan::runFrame(const PlanInputs& inputs) {
    if (auto set = setInputs(inputs); !set) return set.error();
    return run();
}

Format inputFormat(const Resource& r, Precision precision) {
    if (r.format == Format::r32f || r.format == Format::rgba32f || isInteger(r.format)) return r.format;
    return precision == Precision::half ? Format::rgba16f : Format::rgba32f;
}

} // namespace rebound::runner
