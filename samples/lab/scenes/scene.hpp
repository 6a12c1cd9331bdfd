// SPDX-License-Identifier: MIT
// A scene as the lab sees it: triangles in world space, materials, lights and cameras, at one moment.
// Metres, right handed, y up; colours are linear Rec. 709.
#pragma once

#include "rebound/result.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace rebound::lab {

enum class Wrap { repeat, mirror, clamp };

// 8-bit RGBA, row 0 on top as in glTF (v = 0). Colour textures hold sRGB, alpha is linear.
struct Texture {
    std::string name;
    int width = 0;
    int height = 0;
    Wrap wrapS = Wrap::repeat;
    Wrap wrapT = Wrap::repeat;
    std::vector<uint8_t> rgba;
};

inline constexpr int none = -1;

// Lambertian and two-sided for the light that Rebound computes; metallic and roughness are kept for glossy paths.
struct Material {
    std::string name;
    glm::vec4 baseColor{1.0f};   // times the texture: diffuse reflectance and opacity, each 0 to 1
    int baseColorTexture = none; // index into Scene::textures
    glm::vec3 emission{0.0f};    // emissiveFactor * emissiveStrength: radiance [W m^-2 sr^-1]
    int emissionTexture = none;
    bool alphaMasked = false; // texels of opacity below alphaCutoff are holes, for light too
    float alphaCutoff = 0.5f;
    float metallic = 0.0f;
    float roughness = 1.0f;
};

// Indexed triangles of one material, transformed to world space.
struct Mesh {
    std::string name;
    int material = 0;                           // index into Scene::materials
    std::vector<glm::vec3> positions;           // [m]
    std::vector<glm::vec3> normals;             // unit; generated where a file has none
    std::vector<glm::vec4> colors;              // factors of the base colour, 0 to 1; empty, or one a vertex
    std::vector<glm::vec2> textureCoordinates;  // of the base colour; empty, or one a vertex
    std::vector<glm::vec2> emissionCoordinates; // of the emission; empty: those of the base colour
    std::vector<uint32_t> indices;              // three a triangle
};

enum class LightType { directional, point, spot, area };

struct Light {
    std::string name;
    LightType type = LightType::directional;
    glm::vec3 position{0.0f};      // [m]; an area light's centre
    glm::vec3 direction{0, -1, 0}; // unit: the way light travels, a spot's axis, an area light's normal
    // directional: irradiance on a plane that faces it [W m^-2]; point and spot: radiant intensity [W sr^-1];
    // area: radiance of its emitting side [W m^-2 sr^-1].
    glm::vec3 intensity{1.0f};
    float innerCone = 0.0f; // spot: half apex angle inside which light is full [rad]
    float outerCone =
        0.785398f;            // spot: half apex angle outside which there is none [rad]; equal: a hard edge
    glm::vec3 right{1, 0, 0}; // area: unit, along the rectangle's first side
    glm::vec2 size{1.0f};     // area: length along right, and along direction x right [m]
};

struct CameraView {
    std::string name;
    glm::vec3 position{0.0f};   // [m]
    glm::vec3 target{0, 0, -1}; // [m]
    glm::vec3 up{0, 1, 0};
    bool orthographic = false;
    float verticalFieldOfView = 1.0f; // full angle [rad]; perspective only
    float orthographicHeight = 1.0f;  // full height of the view [m]; orthographic only
    float nearPlane = 0.05f;          // [m]
    float farPlane = 1000.0f;         // [m]
};

struct Scene {
    std::string name;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Light> lights; // never seen by a camera
    std::vector<CameraView> cameras;
    glm::vec3 environment{0.0f}; // constant radiance from everywhere outside [W m^-2 sr^-1]
    // Whether light straight from emissive surfaces is direct light. False: they are seen to glow, and what they send is
    // light of a surface like any other's, which is indirect light for whoever receives it.
    bool emissiveMaterialsLight = true;

    std::vector<std::string>
        notes; // what its file holds that the lab leaves out or takes for something else: sentences

    size_t triangleCount() const;
};

// Checks what every consumer of a scene relies on: at least one triangle; indices, materials and textures in range;
// finite positions, unit normals; finite, non-negative light.
Result<> validate(const Scene&);

// The camera of that name; with an empty name, the first. An unknown name's error lists those that exist.
Result<CameraView> findCamera(const Scene&, const std::string& name);

} // namespace rebound::lab
