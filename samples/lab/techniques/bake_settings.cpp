// SPDX-License-Identifier: MIT
#include "lab/techniques/bake_settings.hpp"

#include "lab/techniques/draft_values.hpp"

#include <array>
#include <cstdio>

namespace rebound::techniques {

namespace {

constexpr std::pair<const char*, BakeHierarchy> hierarchyNames[] = {
    {"cluster", BakeHierarchy::cluster}, {"paper", BakeHierarchy::paper}, {"kdtree", BakeHierarchy::kdTree}};
constexpr std::pair<const char*, LinkForm> linkFormNames[] = {{"coefficients", LinkForm::coefficients},
                                                              {"direction", LinkForm::direction}};

// The paper's two settings: surfels, links.                                                    [PIC, table 1]
struct Quality {
    uint32_t surfels, caches, links, lightMap;
};
constexpr std::pair<const char*, Quality> qualityNames[] = {{"moderate", {32768, 10000, 128, 0}},
                                                            {"high", {131072, 10000, 254, 40000}}};

// What validate() says, with options' names.
Error renamed(Error error, Spelling spelling) {
    constexpr std::array<std::pair<std::string_view, const char*>, 7> options{{
        {"settings.surfels", "surfels"},
        {"settings.caches", "caches"},
        {"settings.spacing", "spacing"},
        {"settings.lightMap", "lightmap"},
        {"settings.links", "links"},
        {"settings.bands", "bands"},
        {"settings.raysPerLink", "rays-per-link"},
    }};
    for (const auto& [setting, option] : options)
        if (error.message.starts_with(setting))
            error.message.replace(0, setting.size(), spelled(option, spelling));
    return error;
}

} // namespace

std::vector<Option> bakeOptions() {
    return {
        {"quality", "NAME",
         "moderate: 32768 surfels, 10000 caches, 128 links a cache; high: 131072, 10000, 254,\n"
         "and 40000 caches in a light map. The options below replace its values (default: moderate)"},
        {"surfels", "N", "that send light, about so many, 1 to 1048576"},
        {"caches", "N", "that receive it, at most so many, 8 to 16777216"},
        {"spacing", "L", "of the grid of caches [m]; 0: as fine as their number allows (default: 0)"},
        {"lightmap", "N", "caches on surfaces beside them, about so many, 0 to 1048576; 0: none"},
        {"links", "N", "of each cache to senders, 1 to 4096"},
        {"bands", "N", "of spherical harmonics, 2 to 4 (default: 3)"},
        {"rays-per-link", "N", "that tell what a cache sees of a sender, 1 to 1024 (default: 8)"},
        {"link-form", "FORM",
         "what a link keeps: coefficients, or a direction, which takes less memory\n"
         "(default: coefficients)"},
        {"hierarchy", "WHICH", "of surfels: cluster, paper (its distance) or kdtree (default: cluster)"},
    };
}

Result<BakeSettings> bakeSettingsOf(const Draft& draft, Spelling spelling) {
    BakeSettings settings;
    DraftValues values(draft, spelling);
    Quality quality = qualityNames[0].second;
    values.replaceByName<Quality>(quality, "quality", qualityNames);
    settings.surfels = quality.surfels;
    settings.caches = quality.caches;
    settings.links = quality.links;
    settings.lightMap = quality.lightMap;
    values.replaceByNumber(settings.surfels, "surfels", "a whole number, 1 to 1048576,");
    values.replaceByNumber(settings.caches, "caches", "a whole number, 8 to 16777216,");
    values.replaceByNumber(settings.spacing, "spacing", "a number of metres, or 0,");
    values.replaceByNumber(settings.lightMap, "lightmap", "a whole number, 0 to 1048576,");
    values.replaceByNumber(settings.links, "links", "a whole number, 1 to 4096,");
    values.replaceByNumber(settings.bands, "bands", "2, 3 or 4");
    values.replaceByNumber(settings.raysPerLink, "rays-per-link", "a whole number, 1 to 1024,");
    values.replaceByName<LinkForm>(settings.linkForm, "link-form", linkFormNames);
    values.replaceByName<BakeHierarchy>(settings.hierarchy, "hierarchy", hierarchyNames);
    if (!values.error()) return values.error().error();
    if (auto valid = validate(settings); !valid) return renamed(valid.error(), spelling);
    return settings;
}

Json toJson(const BakeSettings& s) {
    Json json;
    json["surfels"] = s.surfels;
    json["caches"] = s.caches;
    json["spacing"] = s.spacing;
    json["lightmap"] = s.lightMap;
    json["links"] = s.links;
    json["bands"] = s.bands;
    json["rays_per_link"] = s.raysPerLink;
    json["link_form"] = nameIn<LinkForm>(linkFormNames, s.linkForm);
    json["hierarchy"] = nameIn<BakeHierarchy>(hierarchyNames, s.hierarchy);
    return json;
}

std::string nameOf(const BakeSettings& s) {
    char text[160];
    std::snprintf(text, sizeof text, "%u surfels, %u caches, %u links, %u bands", s.surfels, s.caches,
                  s.links, s.bands);
    std::string name = text;
    const BakeSettings usual;
    if (s.lightMap > 0) name += ", " + std::to_string(s.lightMap) + " in a light map";
    if (s.spacing > 0.0f) {
        std::snprintf(text, sizeof text, ", spacing %g", double(s.spacing));
        name += text;
    }
    if (s.raysPerLink != usual.raysPerLink) name += ", " + std::to_string(s.raysPerLink) + " rays a link";
    if (s.linkForm != usual.linkForm) name += std::string(", ") + nameIn<LinkForm>(linkFormNames, s.linkForm);
    if (s.hierarchy != usual.hierarchy)
        name += std::string(", ") + nameIn<BakeHierarchy>(hierarchyNames, s.hierarchy);
    return name;
}

} // namespace rebound::techniques
