// SPDX-License-Identifier: MIT
#include "lab/scenes/mesh_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace rebound::lab {
namespace {

// The two coordinates that a plane of this normal shows best, so that textures lie on walls and floors
// undistorted.
glm::vec2 planar(const glm::vec3& position, const glm::vec3& normal) {
    const glm::vec3 n = glm::abs(normal);
    if (n.y >= n.x && n.y >= n.z) return {position.x, position.z};
    return n.x > n.z ? glm::vec2(position.z, -position.y) : glm::vec2(position.x, -position.y);
}

glm::vec3 polygonNormal(std::span<const glm::vec3> corners) {
    glm::vec3 sum(0.0f);
    for (size_t i = 1; i + 1 < corners.size(); ++i)
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    return glm::normalize(sum);
}

struct Band {
    glm::vec2 begin, end;             // radius and height
    glm::vec2 beginNormal, endNormal; // outwards and up
};

// The bands of a profile, with normals shared where the profile bends little.
std::vector<Band> bandsOf(std::span<const glm::vec2> profile) {
    const float smooth = std::cos(glm::radians(40.0f));
    std::vector<Band> bands;
    for (size_t i = 0; i + 1 < profile.size(); ++i) {
        const glm::vec2 along = glm::normalize(profile[i + 1] - profile[i]);
        const glm::vec2 normal(along.y, -along.x);
        bands.push_back({profile[i], profile[i + 1], normal, normal});
    }
    std::vector<Band> smoothed = bands;
    for (size_t i = 0; i + 1 < bands.size(); ++i)
        if (glm::dot(bands[i].endNormal, bands[i + 1].beginNormal) > smooth)
            smoothed[i].endNormal = smoothed[i + 1].beginNormal =
                glm::normalize(bands[i].endNormal + bands[i + 1].beginNormal);
    return smoothed;
}

} // namespace

MeshBuilder::MeshBuilder(std::string name, int material, float textureRepeats) : repeats(textureRepeats) {
    mesh.name = std::move(name);
    mesh.material = material;
}

uint32_t MeshBuilder::vertex(const glm::vec3& position, const glm::vec3& normal,
                             const glm::vec2& textureCoordinate) {
    mesh.positions.emplace_back(placement * glm::vec4(position, 1.0f));
    mesh.normals.push_back(glm::normalize(glm::mat3(placement) * normal));
    mesh.textureCoordinates.push_back(textureCoordinate);
    return static_cast<uint32_t>(mesh.positions.size() - 1);
}

void MeshBuilder::triangle(uint32_t a, uint32_t b, uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

void MeshBuilder::rod(const glm::vec3& from, const glm::vec3& to, float radius, int segments) {
    const glm::vec3 axis = glm::normalize(to - from);
    const glm::vec3 aside = std::abs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 x = glm::normalize(glm::cross(axis, aside));
    const glm::mat4 before = placement;
    placement = before * glm::mat4(glm::vec4(x, 0.0f), glm::vec4(axis, 0.0f),
                                   glm::vec4(glm::cross(x, axis), 0.0f), glm::vec4(from, 1.0f));
    const float length = glm::distance(from, to);
    const std::array<glm::vec2, 4> profile = {glm::vec2(0, 0), {radius, 0}, {radius, length}, {0, length}};
    revolve(profile, glm::vec3(0.0f), segments);
    placement = before;
}

void MeshBuilder::face(std::span<const glm::vec3> corners) {
    const glm::vec3 normal = polygonNormal(corners);
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::vec3& corner : corners) vertex(corner, normal, repeats * planar(corner, normal));
    for (uint32_t i = 1; i + 1 < corners.size(); ++i) triangle(first, first + i, first + i + 1);
}

void MeshBuilder::box(const glm::vec3& low, const glm::vec3& high) {
    const std::array<glm::vec2, 4> outline = {
        glm::vec2(low.x, low.z), {high.x, low.z}, {high.x, high.z}, {low.x, high.z}};
    prism(outline, low.y, high.y);
}

void MeshBuilder::prism(std::span<const glm::vec2> polygon, float bottom, float top) {
    std::vector<glm::vec3> lower, upper;
    for (size_t i = 0; i < polygon.size(); ++i) {
        lower.emplace_back(polygon[i].x, bottom, polygon[i].y);
        const glm::vec2 reversed = polygon[polygon.size() - 1 - i];
        upper.emplace_back(reversed.x, top, reversed.y);
    }
    face(lower);
    face(upper);
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const std::array<glm::vec3, 4> side = {
            glm::vec3(a.x, bottom, a.y), {a.x, top, a.y}, {b.x, top, b.y}, {b.x, bottom, b.y}};
        face(side);
    }
}

void MeshBuilder::revolve(std::span<const glm::vec2> profile, const glm::vec3& centre, int segments) {
    const auto placeAt = [&](const glm::vec2& point, float angle) {
        return glm::vec3(point.x * std::cos(angle), point.y, -point.x * std::sin(angle));
    };
    float widest = 0.0f;
    for (const glm::vec2& point : profile) widest = std::max(widest, point.x);
    // A whole number, so that the texture meets itself.
    const float turns = std::max(1.0f, std::round(2.0f * std::numbers::pi_v<float> * widest * repeats));
    float length = 0.0f;
    for (const Band& band : bandsOf(profile)) {
        const float nextLength = length + glm::distance(band.begin, band.end);
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (int i = 0; i <= segments; ++i) {
            // The last column is the first one's place again, to the bit, or there would be a gap.
            const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i % segments) /
                                static_cast<float>(segments);
            const float around = turns * static_cast<float>(i) / static_cast<float>(segments);
            vertex(centre + placeAt(band.begin, angle), placeAt(band.beginNormal, angle),
                   {around, -length * repeats});
            vertex(centre + placeAt(band.end, angle), placeAt(band.endNormal, angle),
                   {around, -nextLength * repeats});
        }
        for (uint32_t i = 0; i < static_cast<uint32_t>(segments); ++i) {
            const uint32_t at = first + 2 * i; // begin, end, next begin, next end
            if (band.begin.x > 0.0f) triangle(at, at + 2, at + 1);
            if (band.end.x > 0.0f) triangle(at + 2, at + 3, at + 1);
        }
        length = nextLength;
    }
}

void MeshBuilder::frame(std::span<const glm::vec2> profile, const glm::vec2& half) {
    const std::array<glm::vec2, 4> corners = {glm::vec2(1, 1), {1, -1}, {-1, -1}, {-1, 1}};
    for (size_t c = 0; c < 4; ++c) {
        const glm::vec2 here = corners[c], next = corners[(c + 1) % 4];
        for (size_t i = 0; i < profile.size(); ++i) {
            const glm::vec2 p = profile[i], q = profile[(i + 1) % profile.size()];
            const auto at = [&](const glm::vec2& corner, const glm::vec2& point) {
                return glm::vec3(corner.x * (half.x + point.x), point.y, corner.y * (half.y + point.x));
            };
            const std::array<glm::vec3, 4> side = {at(here, p), at(next, p), at(next, q), at(here, q)};
            face(side);
        }
    }
}

void MeshBuilder::sheet(int columns, int rows, const std::function<MeshPoint(float, float)>& point,
                        const glm::vec2& repeatsOver) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column) {
            const glm::vec2 uv(static_cast<float>(column) / static_cast<float>(columns),
                               static_cast<float>(row) / static_cast<float>(rows));
            const MeshPoint p = point(uv.x, uv.y);
            vertex(p.position, p.normal, uv * repeatsOver);
        }
    const auto width = static_cast<uint32_t>(columns) + 1;
    for (uint32_t row = 0; row < static_cast<uint32_t>(rows); ++row)
        for (uint32_t column = 0; column + 1 < width; ++column) {
            const uint32_t at = first + row * width + column;
            triangle(at, at + 1, at + width);
            triangle(at + 1, at + width + 1, at + width);
        }
}

double signedVolume(const Mesh& mesh) {
    double volume = 0.0;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const auto corner = [&](size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
        volume += glm::dot(corner(0), glm::cross(corner(1), corner(2))) / 6.0;
    }
    return volume;
}

} // namespace rebound::lab
