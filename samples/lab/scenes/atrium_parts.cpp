// SPDX-License-Identifier: MIT
#include "lab/scenes/atrium_parts.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace rebound::lab {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

using Profile = std::vector<glm::vec2>; // radius, height

Profile scaled(const Profile& profile, float radius, float height) {
    Profile result;
    for (const glm::vec2& point : profile) result.push_back(point * glm::vec2(radius, height));
    return result;
}

void addPlaneBox(MeshBuilder& mesh, const WallPlane& plane, const glm::vec3& low, const glm::vec3& high) {
    const glm::vec3 a = plane.at(low.x, low.y, low.z), b = plane.at(high.x, high.y, high.z);
    mesh.box(glm::min(a, b), glm::max(a, b));
}

} // namespace

void addArch(MeshBuilder& mesh, const WallPlane& plane, const Arch& arch) {
    constexpr int segments = 24;
    const float middle = (arch.begin + arch.end) / 2.0f, half = arch.thickness / 2.0f;
    const auto under = [&](float u) {
        const float angle = pi * (1.0f - u);
        return glm::vec2(middle + arch.radius * std::cos(angle),
                         arch.spring + std::max(arch.radius * std::sin(angle), 0.0f));
    };
    // The lower edge from end to end; above each of its parts is a block.
    std::vector<glm::vec2> edge = {{arch.begin, arch.spring}};
    for (int i = 0; i <= segments; ++i) edge.push_back(under(static_cast<float>(i) / segments));
    edge.emplace_back(arch.end, arch.spring);
    const auto at = [&](const glm::vec2& p, float t) { return plane.at(p.x, p.y, t); };
    const auto quad = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
        mesh.face(std::array<glm::vec3, 4>{a, b, c, d});
    };
    for (size_t i = 0; i + 1 < edge.size(); ++i) {
        const glm::vec2 p = edge[i], q = edge[i + 1], above(p.x, arch.top), next(q.x, arch.top);
        quad(at(p, half), at(q, half), at(next, half), at(above, half));
        quad(at(q, -half), at(p, -half), at(above, -half), at(next, -half));
        quad(at(above, half), at(next, half), at(next, -half), at(above, -half));
        if (i == 0 || i + 2 == edge.size()) quad(at(p, -half), at(q, -half), at(q, half), at(p, half));
    }
    const auto vault = [&](float u, float v) {
        const glm::vec2 p = under(u);
        const glm::vec2 inwards = glm::vec2(middle, arch.spring) - p;
        return MeshPoint{at(p, v > 0.5f ? half : -half),
                         inwards.x * plane.along + glm::vec3(0.0f, inwards.y, 0.0f)};
    };
    mesh.sheet(segments, 1, vault, {pi * arch.radius, arch.thickness});
    for (const auto& [p, s] : {std::pair(edge.front(), 1.0f), std::pair(edge.back(), -1.0f)}) {
        const glm::vec2 above(p.x, arch.top);
        quad(at(p, -half * s), at(p, half * s), at(above, half * s), at(above, -half * s));
    }
}

void addColumn(MeshBuilder& mesh, const glm::vec3& foot, float height, float radius) {
    const float plinth = 0.16f, abacus = 0.12f;
    const float r = radius, h = height - plinth - abacus;
    const float wide = 1.5f * r;
    mesh.box(foot - glm::vec3(wide, 0, wide), foot + glm::vec3(wide, plinth, wide));
    mesh.box(foot + glm::vec3(-wide, height - abacus, -wide), foot + glm::vec3(wide, height, wide));
    const Profile profile = {{0, 0},
                             {1.42f * r, 0},
                             {1.48f * r, 0.03f},
                             {1.48f * r, 0.07f},
                             {1.38f * r, 0.10f},
                             {1.18f * r, 0.115f},
                             {1.16f * r, 0.15f},
                             {1.24f * r, 0.18f},
                             {1.2f * r, 0.22f},
                             {1.0f * r, 0.25f},
                             {0.99f * r, h / 3},
                             {0.93f * r, 2 * h / 3},
                             {0.84f * r, h - 0.42f},
                             {0.96f * r, h - 0.40f},
                             {0.96f * r, h - 0.36f},
                             {0.86f * r, h - 0.34f},
                             {0.92f * r, h - 0.22f},
                             {1.1f * r, h - 0.1f},
                             {1.42f * r, h},
                             {0, h}};
    mesh.revolve(profile, foot + glm::vec3(0, plinth, 0), 28);
}

void addBalustrade(MeshBuilder& mesh, const WallPlane& plane, float begin, float end, float floor) {
    const float low = 0.12f, rail = 0.86f, top = 0.98f;
    addPlaneBox(mesh, plane, {begin, floor, -0.11f}, {end, floor + low, 0.11f});
    addPlaneBox(mesh, plane, {begin, floor + rail, -0.14f}, {end, floor + top, 0.14f});
    const Profile baluster = scaled({{0, 0},
                                     {0.8f, 0},
                                     {0.8f, 0.06f},
                                     {0.5f, 0.1f},
                                     {0.95f, 0.25f},
                                     {1.0f, 0.36f},
                                     {0.75f, 0.52f},
                                     {0.45f, 0.7f},
                                     {0.42f, 0.84f},
                                     {0.8f, 0.9f},
                                     {0.8f, 1},
                                     {0, 1}},
                                    0.075f, rail - low);
    const int count = static_cast<int>((end - begin) / 0.3f);
    for (int i = 0; i < count; ++i) {
        const float s = begin + (end - begin) * (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
        mesh.revolve(baluster, plane.at(s, floor + low, 0.0f), 10);
    }
}

void addDrape(MeshBuilder& mesh, const WallPlane& plane, const Drape& drape) {
    constexpr int columns = 48, rows = 10;
    constexpr float halfThickness = 0.006f;
    // u from left to right, v from the lower edge up.
    const auto middle = [&](float u, float v) {
        const float fall = 1.0f - v;
        const float gathered = 1.0f - 0.16f * std::sin(pi * std::min(1.0f, 1.2f * fall));
        const float depth = 0.02f + 0.085f * fall;
        const float wave =
            std::sin(2.0f * pi * drape.folds * u + drape.phase + 0.7f * std::sin(5.0f * u + 2.0f * fall)) +
            0.35f * std::sin(2.0f * pi * 2.3f * drape.folds * u + 3.0f * fall + drape.phase);
        const float sag = 0.05f * std::sin(pi * u) * fall;
        const float height = drape.bottom + (drape.top - drape.bottom) * v - sag;
        return glm::vec3(drape.middle + (u - 0.5f) * drape.width * gathered, height, depth * wave);
    };
    const auto point = [&](float u, float v, float side) {
        constexpr float step = 1e-3f;
        const glm::vec3 m = middle(u, v);
        const glm::vec3 du = middle(u + step, v) - middle(u - step, v),
                        dv = middle(u, v + step) - middle(u, v - step);
        const glm::vec3 n = glm::normalize(glm::cross(du, dv));
        return MeshPoint{plane.at(m.x, m.y, m.z + side * halfThickness),
                         side * (n.x * plane.along + glm::vec3(0, n.y, 0) + n.z * plane.through)};
    };
    const auto turned = [&](MeshPoint p, const glm::vec3& normal) {
        p.normal = normal;
        return p;
    };
    // The other side's columns fall on this one's to the bit.
    const auto opposite = [](float u) { return (columns - std::round(u * columns)) / columns; };
    const glm::vec2 repeats(drape.width, drape.top - drape.bottom);
    const glm::vec3 up(0, 1, 0);
    mesh.sheet(
        columns, rows, [&](float u, float v) { return point(u, v, 1); }, repeats);
    mesh.sheet(
        columns, rows, [&](float u, float v) { return point(opposite(u), v, -1); }, repeats);
    mesh.sheet(
        columns, 1, [&](float u, float v) { return turned(point(u, 0, 2 * v - 1), -up); }, repeats);
    mesh.sheet(
        columns, 1, [&](float u, float v) { return turned(point(u, 1, 1 - 2 * v), up); }, repeats);
    mesh.sheet(
        1, rows, [&](float u, float v) { return turned(point(0, v, 2 * u - 1), -plane.along); }, repeats);
    mesh.sheet(
        1, rows, [&](float u, float v) { return turned(point(1, v, 1 - 2 * u), plane.along); }, repeats);
}

void addVase(MeshBuilder& mesh, const glm::vec3& foot, float height) {
    const Profile profile = {{0, 0},         {0.55f, 0},    {0.58f, 0.05f}, {0.42f, 0.10f}, {0.62f, 0.22f},
                             {0.9f, 0.42f},  {1.0f, 0.58f}, {0.94f, 0.74f}, {0.72f, 0.86f}, {0.7f, 0.92f},
                             {0.88f, 0.97f}, {0.9f, 1.0f},  {0.8f, 1.0f},   {0.62f, 0.92f}, {0.64f, 0.85f},
                             {0.86f, 0.74f}, {0.9f, 0.7f},  {0, 0.7f}};
    mesh.revolve(scaled(profile, 0.42f * height, height), foot, 32);
}

void addPlant(MeshBuilder& mesh, const glm::vec3& foot, float height, int leaves, float phase) {
    constexpr int parts = 7;
    const auto quad = [&](const std::array<glm::vec3, 3>& a, const std::array<glm::vec3, 3>& b, size_t i) {
        mesh.face(std::array<glm::vec3, 4>{a[i], b[i], b[(i + 1) % 3], a[(i + 1) % 3]});
    };
    for (int leaf = 0; leaf < leaves; ++leaf) {
        // Turned by the golden angle, the inner ones steeper.
        const float angle = phase + 2.39996f * static_cast<float>(leaf);
        const float share = (static_cast<float>(leaf) + 0.5f) / static_cast<float>(leaves);
        const glm::vec3 outwards(std::cos(angle), 0.0f, std::sin(angle)),
            across(-outwards.z, 0.0f, outwards.x);
        const float reach = height * (0.15f + 0.65f * share), rise = height * (1.15f - 0.45f * share);
        const auto ring = [&](int part) {
            const float v = static_cast<float>(part) / parts;
            const glm::vec3 spine = foot + outwards * (0.03f + reach * v) +
                                    glm::vec3(0, rise * (1.9f * v - 1.25f * share * v * v - 0.6f * v * v), 0);
            const float width = 0.075f * height * (0.15f + std::sin(pi * std::min(0.97f, 0.12f + 0.88f * v)));
            return std::array<glm::vec3, 3>{spine - width * across, spine + glm::vec3(0, -0.3f * width, 0),
                                            spine + width * across};
        };
        std::array<glm::vec3, 3> previous = ring(0);
        mesh.face(std::array<glm::vec3, 3>{previous[0], previous[1], previous[2]});
        for (int part = 1; part <= parts; ++part) {
            const std::array<glm::vec3, 3> next = ring(part);
            for (size_t i = 0; i < 3; ++i) quad(previous, next, i);
            previous = next;
        }
        mesh.face(std::array<glm::vec3, 3>{previous[2], previous[1], previous[0]});
    }
}

} // namespace rebound::lab
