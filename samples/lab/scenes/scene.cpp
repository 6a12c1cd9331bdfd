// SPDX-License-Identifier: MIT
#include "lab/scenes/scene.hpp"

#include "lab/files/input_error.hpp"
#include "lab/rays/camera_rays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rebound::lab {
namespace {

// Squares of distances stay far inside a float's range.
constexpr float largestCoordinate = 1e15f; // [m]

// Normals that went through a file as bytes or half floats are normalised on reading; this leaves room for
// rounding.
constexpr float unitTolerance = 1e-3f;

bool isFinite(float value) { return std::isfinite(value); }

template <glm::length_t size>
bool isFinite(const glm::vec<size, float>& v) {
    for (glm::length_t i = 0; i < size; ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

bool isUnit(const glm::vec3& v) { return isFinite(v) && std::abs(glm::length(v) - 1.0f) <= unitTolerance; }

bool isPlace(const glm::vec3& v) {
    return isFinite(v) && std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= largestCoordinate;
}

bool isLight(const glm::vec3& v) { return isFinite(v) && v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f; }

bool isShare(float value) { return value >= 0.0f && value <= 1.0f; }

void require(bool condition, const std::string& subject, const char* expectation) {
    if (!condition) refuse(subject + " " + expectation);
}

template <class Item>
std::string naming(const char* kind, const std::vector<Item>& items, const Item& item) {
    return std::string(kind) + " " + std::to_string(&item - items.data()) + " ('" + item.name + "')";
}

bool refersTo(int index, size_t count) {
    return index == none || (index >= 0 && static_cast<size_t>(index) < count);
}

void checkTexture(const Texture& texture, const std::string& subject) {
    require(texture.width > 0 && texture.height > 0, subject, "is empty");
    const size_t texels = static_cast<size_t>(texture.width) * static_cast<size_t>(texture.height);
    require(texture.rgba.size() == texels * 4, subject, "does not hold four bytes for each texel");
}

void checkMaterial(const Material& material, size_t textureCount, const std::string& subject) {
    for (glm::length_t i = 0; i < 4; ++i)
        require(isShare(material.baseColor[i]), subject, "has a base colour outside 0 to 1");
    require(isLight(material.emission), subject, "has an emission that is negative or not finite");
    require(isFinite(material.alphaCutoff), subject, "has an alpha cutoff that is not finite");
    require(isShare(material.metallic), subject, "has a metallic share outside 0 to 1");
    require(isShare(material.roughness), subject, "has a roughness outside 0 to 1");
    require(refersTo(material.baseColorTexture, textureCount), subject,
            "refers to a base colour texture that is missing");
    require(refersTo(material.emissionTexture, textureCount), subject,
            "refers to an emission texture that is missing");
}

void checkMesh(const Mesh& mesh, const Scene& scene, const std::string& subject) {
    require(mesh.material >= 0 && static_cast<size_t>(mesh.material) < scene.materials.size(), subject,
            "refers to a material that is missing");
    const size_t vertexCount = mesh.positions.size();
    require(mesh.normals.size() == vertexCount, subject, "does not have one normal for each vertex");
    require(mesh.textureCoordinates.empty() || mesh.textureCoordinates.size() == vertexCount, subject,
            "does not have one texture coordinate for each vertex");
    require(mesh.emissionCoordinates.empty() || mesh.emissionCoordinates.size() == vertexCount, subject,
            "does not have one texture coordinate of its emission for each vertex");
    require(mesh.colors.empty() || mesh.colors.size() == vertexCount, subject,
            "does not have one colour for each vertex");
    require(mesh.indices.size() % 3 == 0, subject, "has a number of indices that is not a multiple of 3");
    const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
    const bool placesEmission = !mesh.textureCoordinates.empty() || !mesh.emissionCoordinates.empty();
    require(vertexCount == 0 || ((material.baseColorTexture == none || !mesh.textureCoordinates.empty()) &&
                                 (material.emissionTexture == none || placesEmission)),
            subject, "has a textured material, but no texture coordinates");
    require(std::all_of(mesh.positions.begin(), mesh.positions.end(), isPlace), subject,
            "has a position that is not finite or farther than 1e15 m from the origin");
    require(std::all_of(mesh.normals.begin(), mesh.normals.end(), isUnit), subject,
            "has a normal that is not of unit length");
    require(std::all_of(mesh.textureCoordinates.begin(), mesh.textureCoordinates.end(),
                        [](const glm::vec2& v) { return isFinite(v); }),
            subject, "has a texture coordinate that is not finite");
    require(std::all_of(mesh.emissionCoordinates.begin(), mesh.emissionCoordinates.end(),
                        [](const glm::vec2& v) { return isFinite(v); }),
            subject, "has a texture coordinate of its emission that is not finite");
    require(std::all_of(mesh.colors.begin(), mesh.colors.end(),
                        [](const glm::vec4& c) {
                            return isShare(c.r) && isShare(c.g) && isShare(c.b) && isShare(c.a);
                        }),
            subject, "has a colour outside 0 to 1");
    require(
        std::all_of(mesh.indices.begin(), mesh.indices.end(), [&](uint32_t i) { return i < vertexCount; }),
        subject, "has an index beyond its vertices");
}

void checkLight(const Light& light, const std::string& subject) {
    require(isLight(light.intensity), subject, "has an intensity that is negative or not finite");
    require(light.type == LightType::directional || isPlace(light.position), subject,
            "has a position that is not finite or farther than 1e15 m from the origin");
    require(light.type == LightType::point || isUnit(light.direction), subject,
            "has a direction that is not of unit length");
    if (light.type == LightType::spot)
        require(light.innerCone >= 0.0f && light.innerCone <= light.outerCone &&
                    light.outerCone <= std::numbers::pi_v<float>,
                subject, "has cone angles that are not in the order 0, inner, outer, pi");
    if (light.type == LightType::area) {
        require(isUnit(light.right) && std::abs(glm::dot(light.right, light.direction)) <= unitTolerance,
                subject, "has a right that is not a unit vector at a right angle to its direction");
        require(isFinite(light.size) && light.size.x > 0.0f && light.size.y > 0.0f, subject,
                "has a size that is not positive");
    }
}

void checkCamera(const CameraView& camera) {
    if (const Result<> valid = validate(camera); !valid) refuse(valid.error().message);
}

void check(const Scene& scene) {
    for (const Texture& texture : scene.textures)
        checkTexture(texture, naming("texture", scene.textures, texture));
    for (const Material& material : scene.materials)
        checkMaterial(material, scene.textures.size(), naming("material", scene.materials, material));
    for (const Mesh& mesh : scene.meshes) checkMesh(mesh, scene, naming("mesh", scene.meshes, mesh));
    for (const Light& light : scene.lights) checkLight(light, naming("light", scene.lights, light));
    for (const CameraView& camera : scene.cameras) checkCamera(camera);
    require(isLight(scene.environment), "the environment", "is negative or not finite");
    require(scene.triangleCount() > 0, "the scene", "has no triangles");
}

} // namespace

size_t Scene::triangleCount() const {
    size_t count = 0;
    for (const Mesh& mesh : meshes) count += mesh.indices.size() / 3;
    return count;
}

Result<> validate(const Scene& scene) {
    try {
        check(scene);
    } catch (const InputError& failure) {
        return Error{failure.error().code, "scene '" + scene.name + "': " + failure.error().message};
    }
    return {};
}

Result<CameraView> findCamera(const Scene& scene, const std::string& name) {
    if (scene.cameras.empty()) return Error{ErrorCode::notFound, "scene '" + scene.name + "' has no cameras"};
    if (name.empty()) return scene.cameras.front();
    std::string known;
    for (const CameraView& camera : scene.cameras) {
        if (camera.name == name) return camera;
        known += (known.empty() ? "'" : ", '") + camera.name + "'";
    }
    return Error{ErrorCode::notFound,
                 "scene '" + scene.name + "' has no camera '" + name + "'; its cameras are " + known};
}

} // namespace rebound::lab
