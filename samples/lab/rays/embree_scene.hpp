// SPDX-License-Identifier: MIT
// Ray casting in a scene: what a ray meets, with its material evaluated, and whether anything is in its way.
#pragma once

#include "lab/scenes/scene.hpp"

#include <functional>
#include <limits>
#include <memory>
#include <optional>

namespace rebound::lab {

// Points origin + t * direction for t in [minimum, maximum]; direction need not be of unit length.
struct Ray {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0, 0, -1};
    float minimum = 0.0f;
    float maximum = std::numeric_limits<float>::infinity();
};

// A place on a triangle: barycentric weights u and v of its second and third corner.
struct SurfaceLocation {
    uint32_t mesh = 0;     // index into Scene::meshes
    uint32_t triangle = 0; // of that mesh
    float u = 0.0f;
    float v = 0.0f;
};

struct SurfacePoint {
    SurfaceLocation location;
    glm::vec3 position{0.0f};        // [m]
    glm::vec3 geometricNormal{0.0f}; // unit, of the triangle, turned towards the viewer
    glm::vec3 shadingNormal{0.0f};   // unit, interpolated between corners, turned towards the viewer
    glm::vec3 albedo{0.0f};          // diffuse reflectance
    glm::vec3 emission{0.0f};        // radiance [W m^-2 sr^-1]
    float clearance = 0.0f; // rays that start this far off, along the geometric normal, miss this surface [m]
};

// How far a ray of that length has to end before a surface to miss it [m].
float endClearance(float rayLength);

struct SurfaceHit {
    SurfacePoint point;
    float distance = 0.0f; // t of the ray
};

// The place alone, without its material.
struct LocationHit {
    SurfaceLocation location;
    float distance = 0.0f; // t of the ray
};

// Cut-outs of alpha-masked materials are holes for every ray. All queries may run in parallel.
class EmbreeScene {
public:
    // Validates the scene, and refers to it from then on: it has to outlive the result, unchanged.
    static Result<EmbreeScene> build(const Scene&);

    EmbreeScene(EmbreeScene&&) noexcept;
    EmbreeScene& operator=(EmbreeScene&&) noexcept;
    ~EmbreeScene();

    // The nearest surface, if there is one.
    std::optional<SurfaceHit> intersect(const Ray&) const;

    // The place of the nearest surface, for callers that need its material now and then only.
    std::optional<LocationHit> locate(const Ray&) const;

    bool occluded(const Ray&) const;

    // Whether nothing lies between a point and a target on the side that the geometric normal faces.
    bool visible(const SurfacePoint& from, glm::vec3 target) const;

    // The same for a target on a surface, which does not hide itself on the side that its geometric normal
    // faces.
    bool visible(const SurfacePoint& from, const SurfacePoint& target) const;

    // Whether nothing lies in a direction from a point, on the side that the geometric normal faces.
    bool open(const SurfacePoint& from, glm::vec3 direction) const;

    // The surface at a location, seen along a direction. Precondition: the location is in range.
    SurfacePoint surfaceAt(const SurfaceLocation&, glm::vec3 viewDirection) const;

    glm::vec3 positionAt(const SurfaceLocation&) const;

    const Material& materialAt(const SurfaceLocation&) const;

    // Whether a location falls into a cut-out.
    bool isHole(const SurfaceLocation&) const;

    const Scene& scene() const;

    // Called for every ray from then on, by the thread that casts it, with whether only occlusion is asked for. For
    // measurements; empty: never.
    using RayObserver = std::function<void(const Ray&, bool isShadowRay)>;
    void observeRays(RayObserver);

private:
    struct State;
    explicit EmbreeScene(std::unique_ptr<State>);

    std::unique_ptr<State> state;
};

} // namespace rebound::lab
