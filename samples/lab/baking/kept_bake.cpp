// SPDX-License-Identifier: MIT
#include "lab/baking/kept_bake.hpp"

#include "lab/baking/bake_of_scene.hpp"
#include "lab/scenes/scene_hash.hpp"
#include "rebound/bake/bake_file.hpp"

#include <chrono>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace rebound::lab {

namespace embedded {
extern const std::string_view bakerSource; // a hash of the baker's own text
} // namespace embedded

namespace fs = std::filesystem;

std::string bakeKey(const Scene& scene, const BakeSettings& settings) {
    ContentHash hash;
    hash.addRange(std::span<const char>(embedded::bakerSource));
    addGeometry(hash, scene);
    hash.add(settings.surfels);
    hash.add(settings.caches);
    hash.add(settings.spacing);
    hash.add(settings.lightMap);
    hash.add(settings.links);
    hash.add(settings.bands);
    hash.add(settings.raysPerLink);
    hash.add(settings.linkForm);
    hash.add(settings.hierarchy);
    hash.add(settings.seed);
    return hash.digits();
}

fs::path bakeFolder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return fs::path(value ? value : "");
    };
    if (const fs::path own = variable("REBOUND_CACHE"); !own.empty()) return own;
    if (const fs::path caches = variable("XDG_CACHE_HOME"); !caches.empty()) return caches / "rebound";
    if (const fs::path home = variable("HOME"); !home.empty()) return home / ".cache" / "rebound";
    std::error_code ignored;
    return fs::temp_directory_path(ignored) / "rebound";
}

Result<ObtainedBake> keptBake(std::shared_ptr<const EmbreeScene> scene, const BakeSettings& settings,
                              const fs::path& folder) {
    const fs::path file = folder / (bakeKey(scene->scene(), settings) + ".bake");
    if (auto kept = readBake(file)) return ObtainedBake{*std::move(kept), file, 0.0};
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure)
        return Error{ErrorCode::inputOutput,
                     folder.string() + ": cannot create the folder: " + failure.message()};
    const auto began = std::chrono::steady_clock::now();
    auto bake = bakeOfScene(std::move(scene), settings);
    if (!bake) return bake.error();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    if (auto written = writeBake(*bake, file); !written) return written.error();
    return ObtainedBake{*std::move(bake), file, took.count()};
}

} // namespace rebound::lab
