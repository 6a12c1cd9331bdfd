// SPDX-License-Identifier: MIT
#include "lab/light/path_tracer.hpp"
#include "lab/scenes/content_hash.hpp"

#include <string_view>

namespace rebound::lab {

namespace embedded {
extern const std::string_view pathTracerSource; // a hash of the path tracer's own text
} // namespace embedded

namespace {

void add(ContentHash& hash, const Texture& texture) {
    hash.add(texture.width);
    hash.add(texture.height);
    hash.add(texture.wrapS);
    hash.add(texture.wrapT);
    hash.addRange(texture.rgba);
}

void add(ContentHash& hash, const Material& material) {
    hash.add(material.baseColor);
    hash.add(material.baseColorTexture);
    hash.add(material.emission);
    hash.add(material.emissionTexture);
    hash.add(material.alphaMasked);
    hash.add(material.alphaCutoff);
    hash.add(material.metallic);
    hash.add(material.roughness);
}

void add(ContentHash& hash, const Mesh& mesh) {
    hash.add(mesh.material);
    hash.addRange(mesh.positions);
    hash.addRange(mesh.normals);
    hash.addRange(mesh.colors);
    hash.addRange(mesh.textureCoordinates);
    hash.addRange(mesh.emissionCoordinates);
    hash.addRange(mesh.indices);
}

void add(ContentHash& hash, const Light& light) {
    hash.add(light.type);
    hash.add(light.position);
    hash.add(light.direction);
    hash.add(light.intensity);
    hash.add(light.innerCone);
    hash.add(light.outerCone);
    hash.add(light.right);
    hash.add(light.size);
}

void add(ContentHash& hash, const CameraView& camera) {
    hash.add(camera.position);
    hash.add(camera.target);
    hash.add(camera.up);
    hash.add(camera.orthographic);
    hash.add(camera.verticalFieldOfView);
    hash.add(camera.orthographicHeight);
    hash.add(camera.nearPlane);
    hash.add(camera.farPlane);
}

template <class Part>
void addAll(ContentHash& hash, const std::vector<Part>& parts) {
    hash.add(parts.size());
    for (const Part& part : parts) add(hash, part);
}

} // namespace

std::string pathTracerKey(const Scene& scene, const CameraView& camera, const PathTracerOptions& options) {
    ContentHash hash;
    hash.addRange(std::span<const char>(embedded::pathTracerSource));
    addAll(hash, scene.textures);
    addAll(hash, scene.materials);
    addAll(hash, scene.meshes);
    addAll(hash, scene.lights);
    hash.add(scene.environment);
    hash.add(scene.emissiveMaterialsLight);
    add(hash, camera);
    hash.add(options.extent.width);
    hash.add(options.extent.height);
    hash.add(options.bounces);
    hash.add(options.glossy);
    hash.add(options.seed);
    return hash.digits();
}

} // namespace rebound::lab
