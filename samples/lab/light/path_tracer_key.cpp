// SPDX-License-Identifier: MIT
#include "lab/light/path_tracer.hpp"
#include "lab/scenes/scene_hash.hpp"

#include <string_view>

namespace rebound::lab {

namespace embedded {
extern const std::string_view pathTracerSource; // a hash of the path tracer's own text
} // namespace embedded

std::string pathTracerKey(const Scene& scene, const CameraView& camera, const PathTracerOptions& options) {
    ContentHash hash;
    hash.addRange(std::span<const char>(embedded::pathTracerSource));
    addGeometry(hash, scene);
    addLights(hash, scene);
    add(hash, camera);
    hash.add(options.extent.width);
    hash.add(options.extent.height);
    hash.add(options.bounces);
    hash.add(options.glossy);
    hash.add(options.seed);
    return hash.digits();
}

} // namespace rebound::lab
