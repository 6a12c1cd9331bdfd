// SPDX-License-Identifier: MIT
#include "lab/charts/source_hashes.hpp"

#include "lab/scenes/content_hash.hpp"

#include <span>
#include <string_view>

namespace rebound::charts {

namespace embedded {
extern const std::string_view cpuSource, vulkanSource, openglSource, labSource;
} // namespace embedded

namespace {

std::span<const char> charactersOf(std::string_view text) { return text; }

} // namespace

std::string sourceHash(const std::string& backend) {
    lab::ContentHash hash;
    hash.addRange(charactersOf(embedded::labSource));
    hash.addRange(charactersOf(backend == "vulkan"   ? embedded::vulkanSource
                               : backend == "opengl" ? embedded::openglSource
                                                     : embedded::cpuSource));
    return hash.digits();
}

std::string planHash(const Plan& plan) {
    lab::ContentHash hash;
    hash.addRange(charactersOf(toText(plan)));
    for (const Resource& resource : plan.resources)
        if (resource.data) hash.addRange(*resource.data);
    return hash.digits();
}

} // namespace rebound::charts
