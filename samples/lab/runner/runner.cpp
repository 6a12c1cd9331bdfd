// SPDX-License-Identifier: MIT
#include "lab/runner/runner.hpp"

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

Format inputFormat(const Resource& r, Precision precision) {
    if (r.format == Format::r32f) return Format::r32f;
    return precision == Precision::half ? Format::rgba16f : Format::rgba32f;
}

} // namespace rebound::runner
