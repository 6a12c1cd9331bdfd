// SPDX-License-Identifier: MIT
#include "lab/scenes/scene_hash.hpp"

namespace rebound::lab {

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

template <class Part>
void addAll(ContentHash& hash, const std::vector<Part>& parts) {
    hash.add(parts.size());
    for (const Part& part : parts) add(hash, part);
}

} // namespace

void addGeometry(ContentHash& hash, const Scene& scene) {
    addAll(hash, scene.textures);
    addAll(hash, scene.materials);
    addAll(hash, scene.meshes);
}

void addLights(ContentHash& hash, const Scene& scene) {
    addAll(hash, scene.lights);
    hash.add(scene.environment);
    hash.add(scene.emissiveMaterialsLight);
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

} // namespace rebound::lab
