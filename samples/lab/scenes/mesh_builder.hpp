// SPDX-License-Identifier: MIT
// Closed solids for scenes made in code: triangles wind counter-clockwise and normals point outwards.
#pragma once

#include "lab/scenes/scene.hpp"

#include <glm/glm.hpp>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace rebound::lab {

struct MeshPoint {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f}; // any length but zero
};

class MeshBuilder {
public:
    // `repeats`: how often a texture repeats over a metre.
    MeshBuilder(std::string name, int material, float repeats = 1.0f);

    // What is added from now on is moved by this: a rotation and a translation. Textures move along.
    void place(const glm::mat4& motion) { placement = motion; }

    // A round rod between two points, closed at its ends.
    void rod(const glm::vec3& from, const glm::vec3& to, float radius, int segments);

    // A convex planar polygon, counter-clockwise seen from its front.
    void face(std::span<const glm::vec3> corners);

    // Axis-aligned, between two opposite corners.
    void box(const glm::vec3& low, const glm::vec3& high);

    // A convex polygon (x, z) between two heights; x turns towards z.
    void prism(std::span<const glm::vec2> polygon, float bottom, float top);

    // A profile (radius, height) turned around a vertical axis through `centre`, which is its height 0. It
    // runs so that the solid is on its left (upwards outside, downwards inside) and is closed at both ends by
    // the axis: radius 0. Edges of less than 40 degrees look smooth.
    void revolve(std::span<const glm::vec2> profile, const glm::vec3& centre, int segments);

    // A closed profile (distance outwards, height), counter-clockwise, led around a rectangle with mitred
    // corners: a slab with a hole, a cornice, a parapet. `half`: the rectangle's half extents in x and z.
    void frame(std::span<const glm::vec2> profile, const glm::vec2& half);

    // A curved sheet over u and v from 0 to 1, its front where (d/du) x (d/dv) points.
    void sheet(int columns, int rows, const std::function<MeshPoint(float u, float v)>&,
               const glm::vec2& repeatsOver);

    Mesh take() { return std::move(mesh); }

private:
    uint32_t vertex(const glm::vec3& position, const glm::vec3& normal, const glm::vec2& textureCoordinate);
    void triangle(uint32_t a, uint32_t b, uint32_t c);

    Mesh mesh;
    float repeats;
    glm::mat4 placement{1.0f};
};

// The volume inside a mesh's triangles [m^3]; positive for closed solids whose triangles face outwards.
double signedVolume(const Mesh&);

} // namespace rebound::lab
