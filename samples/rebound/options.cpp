// SPDX-License-Identifier: MIT
#include "options.hpp"

#include "lab/techniques/named_values.hpp"
#include "memory_check.hpp"

#include <sstream>
#include <utility>

namespace rebound::cli {

std::vector<std::string> splitList(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
    return parts;
}

Result<Extent2D> parseSize(const std::string& text) { return measure::parseSize("--size", text); }

Result<const techniques::Technique*> techniqueOf(const TechniqueOptions& options) {
    const auto technique = techniques::named("--technique", options.name);
    if (!technique) return technique;
    if (auto known = techniques::checkOptions(**technique, options.draft, techniques::Spelling::options);
        !known)
        return known.error();
    return technique;
}

Result<techniques::Configured> configure(const TechniqueOptions& options, const techniques::View& view) {
    const auto technique = techniqueOf(options);
    if (!technique) return technique.error();
    return (*technique)->parse(options.draft, view, techniques::Spelling::options);
}

Result<std::unique_ptr<runner::Backend>> createBackend(const DeviceChoice& choice) {
    const auto isa = cpu::isaFromName(choice.isa);
    if (!isa) return Error{isa.error().code, "--" + isa.error().message};
    if (choice.backend == "cpu" && !choice.device.empty())
        return techniques::unexpected("--device", choice.device, "--backend vulkan or opengl");
    auto backend = runner::createBackend({choice.backend, choice.device, *isa, choice.threads, false});
    if (backend || backend.error().message.starts_with("Vulkan: ") ||
        backend.error().message.starts_with("OpenGL: "))
        return backend;
    return Error{backend.error().code, "--" + backend.error().message};
}

Result<runner::Precision> precisionOf(const DeviceChoice& choice) {
    return measure::precisionNamed("--precision", choice.precision);
}

Result<Preparation> prepare(const TechniqueOptions& technique, const DeviceChoice& choice) {
    const auto extent = parseSize(technique.size);
    if (!extent) return extent.error();
    const auto configured = configure(technique, {*extent});
    if (!configured) return configured.error();
    const auto precision = precisionOf(choice);
    if (!precision) return precision.error();
    auto backend = createBackend(choice);
    if (!backend) return backend.error();
    if (auto enough = checkMemory(**backend, configured->plan, *extent); !enough) return enough.error();
    return Preparation{*std::move(backend), *precision, *extent};
}

} // namespace rebound::cli
