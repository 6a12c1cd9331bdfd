// SPDX-License-Identifier: MIT
#include "rebound/bake/bake_scene.hpp"

#include <string>

namespace rebound {

namespace {

Error outOfRange(const char* name, const std::string& value, const std::string& expected) {
    return invalidArgument(std::string("settings.") + name + " is " + value + "; " + expected +
                           " was expected");
}

template <class Number>
Result<> checkRange(const char* name, Number value, Number least, Number most) {
    if (value >= least && value <= most) return {};
    return outOfRange(name, std::to_string(value), std::to_string(least) + " to " + std::to_string(most));
}

} // namespace

Result<> validate(const BakeSettings& settings) {
    for (const Result<>& check : {
             checkRange("surfels", settings.surfels, 1u, 1u << 20),
             checkRange("caches", settings.caches, 8u, 1u << 24),
             checkRange("lightMap", settings.lightMap, 0u, 1u << 20),
             checkRange("links", settings.links, 1u, 4096u),
             checkRange("bands", settings.bands, 2u, 4u),
             checkRange("raysPerLink", settings.raysPerLink, 1u, 1024u),
             checkRange("threads", settings.threads, 0, 1024),
         })
        if (!check) return check;
    constexpr float longest = 1e5f; // the largest scene's diagonal [m]
    if (!(settings.spacing >= 0.0f && settings.spacing <= longest))
        return outOfRange("spacing", std::to_string(settings.spacing), "0, or up to 100000 m,");
    if (settings.linkForm != LinkForm::coefficients && settings.linkForm != LinkForm::direction)
        return outOfRange("linkForm", std::to_string(uint32_t(settings.linkForm)),
                          "coefficients or direction");
    if (settings.hierarchy != BakeHierarchy::cluster && settings.hierarchy != BakeHierarchy::kdTree &&
        settings.hierarchy != BakeHierarchy::paper)
        return outOfRange("hierarchy", std::to_string(int(settings.hierarchy)), "cluster, kdTree or paper");
    return {};
}

} // namespace rebound
