// SPDX-License-Identifier: MIT
#include "lab/techniques/technique.hpp"

#include <algorithm>

namespace rebound::techniques {

Technique screenIndirect();
Technique composition();

const std::vector<Technique>& all() {
    static const std::vector<Technique> techniques = {screenIndirect(), composition()};
    return techniques;
}

std::string names() {
    std::string list;
    for (const Technique& technique : all()) list += (list.empty() ? "" : ", ") + technique.name;
    return list;
}

Result<const Technique*> named(const std::string& what, const std::string& name) {
    for (const Technique& technique : all())
        if (technique.name == name) return &technique;
    return invalidArgument(what + " is \"" + name + "\"; one of " + names() + " was expected");
}

Result<> checkOptions(const Technique& technique, const Draft& draft, Spelling spelling) {
    for (const auto& [option, value] : draft)
        if (std::none_of(technique.options.begin(), technique.options.end(),
                         [&name = option](const Option& known) { return known.name == name; }))
            return invalidArgument(spelled(option, spelling) + " is given, which technique " +
                                   technique.name + " does not have");
    return {};
}

Result<Configured> completed(Configured configured, const Surroundings& surroundings,
                             const std::string& what) {
    if (!configured.inScene) return configured;
    if (!surroundings.scene)
        return invalidArgument(configured.name + " needs the scene around the picture, but " + what +
                               " has none; a scene was expected");
    return configured.inScene(surroundings);
}

std::string spelled(const std::string& option, Spelling spelling) {
    if (spelling == Spelling::options) return "--" + option;
    std::string key = option;
    std::replace(key.begin(), key.end(), '-', '_');
    return key;
}

View viewOf(const lab::Frame& frame) {
    return {frame.depth.extent(),
            frame.camera.orthographic ? Projection::orthographic : Projection::perspective};
}

} // namespace rebound::techniques
