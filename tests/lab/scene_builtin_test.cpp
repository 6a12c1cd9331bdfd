// SPDX-License-Identifier: MIT
// The scenes made in code, and the solids that they are made of.
#include "lab/scenes/atrium_parts.hpp"
#include "lab/scenes/builtin_textures.hpp"
#include "lab/scenes/mesh_builder.hpp"
#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

namespace rebound::lab {
namespace {

glm::vec3 corner(const Mesh& mesh, size_t i) { return mesh.positions[mesh.indices[i]]; }

// Each edge of a closed solid is run along as often one way as the other. Places are compared on a grid of 10
// micrometres, as neighbours compute them in different ways.
bool isClosed(const Mesh& mesh) {
    using Place = std::tuple<int, int, int>;
    const auto place = [&](size_t i) {
        const glm::vec3 p = glm::round(corner(mesh, i) * 1e5f);
        return Place(static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z));
    };
    std::map<std::pair<Place, Place>, int> balance;
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const Place a = place(i), b = place(i % 3 == 2 ? i - 2 : i + 1);
        if (a != b) balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
    return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

// The share of triangles, by area, whose corners' normals are on the side that their winding says.
double outwardShare(const Mesh& mesh) {
    double outward = 0.0, all = 0.0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 area =
            glm::cross(corner(mesh, i + 1) - corner(mesh, i), corner(mesh, i + 2) - corner(mesh, i));
        bool agrees = true;
        for (size_t k = 0; k < 3; ++k)
            agrees = agrees && glm::dot(mesh.normals[mesh.indices[i + k]], area) >= 0.0f;
        all += glm::length(area);
        outward += agrees ? glm::length(area) : 0.0;
    }
    return outward / all;
}

void checkSolid(const Mesh& mesh) {
    CAPTURE(mesh.name);
    CHECK(isClosed(mesh));
    CHECK(signedVolume(mesh) > 0.0);
    // Smoothed normals of the cloth's tightest folds may lean beyond a triangle's plane.
    CHECK(outwardShare(mesh) > 0.99);
}

TEST_CASE("boxes, prisms, turned and mitred solids enclose their volume") {
    // Single rounding errors over some hundred triangles, relative to the volume.
    constexpr double rounding = 1e-4;
    MeshBuilder box("box", 0);
    box.box({-1, 2, 3}, {2, 4, 7});
    const Mesh boxMesh = box.take();
    checkSolid(boxMesh);
    CHECK(std::abs(signedVolume(boxMesh) / 24.0 - 1.0) < rounding);

    MeshBuilder prism("prism", 0);
    prism.prism(std::array<glm::vec2, 3>{glm::vec2(0, 0), {2, 0}, {0, 3}}, 1.0f, 5.0f);
    const Mesh prismMesh = prism.take();
    checkSolid(prismMesh);
    CHECK(std::abs(signedVolume(prismMesh) / 12.0 - 1.0) < rounding);

    // A regular polygon of n corners on the unit circle has the area n / 2 sin(2 pi / n).
    constexpr int segments = 12;
    MeshBuilder cylinder("cylinder", 0);
    cylinder.revolve(std::array<glm::vec2, 4>{glm::vec2(0, 0), {1, 0}, {1, 2}, {0, 2}}, {5, 6, 7}, segments);
    const Mesh cylinderMesh = cylinder.take();
    checkSolid(cylinderMesh);
    const double polygon = segments / 2.0 * std::sin(2.0 * std::numbers::pi / segments);
    CHECK(std::abs(signedVolume(cylinderMesh) / (2.0 * polygon) - 1.0) < rounding);

    // A slab 10 x 8 with a hole 6 x 4, half a metre thick.
    MeshBuilder frame("frame", 0);
    frame.frame(std::array<glm::vec2, 4>{glm::vec2(0, 0), {2, 0}, {2, 0.5f}, {0, 0.5f}}, {3, 2});
    const Mesh frameMesh = frame.take();
    checkSolid(frameMesh);
    CHECK(std::abs(signedVolume(frameMesh) / ((80.0 - 24.0) / 2.0) - 1.0) < rounding);
}

TEST_CASE("an arch is its wall less half a disc") {
    const WallPlane planes[] = {{{1, 2, 3}, {1, 0, 0}, {0, 0, 1}}, {{1, 2, 3}, {0, 0, -1}, {1, 0, 0}}};
    for (const WallPlane& plane : planes) {
        MeshBuilder builder("arch", 0);
        addArch(builder, plane, {-1.5f, 1.5f, 2.0f, 4.0f, 1.0f, 0.5f});
        const Mesh mesh = builder.take();
        checkSolid(mesh);
        // Half a circle of 24 chords has 0.3 % less area than a half disc of 1.57 square metres: 0.1 % of the
        // arch.
        CHECK(std::abs(signedVolume(mesh) / (0.5 * (6.0 - std::numbers::pi / 2.0)) - 1.0) < 2e-3);
    }
}

TEST_CASE("each part of the atrium is a closed solid that faces outwards") {
    const WallPlane plane;
    const auto check = [](const char* name, const auto& add) {
        MeshBuilder builder(name, 0);
        add(builder);
        checkSolid(builder.take());
    };
    check("column", [](MeshBuilder& b) { addColumn(b, {1, 0, 2}, 3.0f, 0.24f); });
    check("balustrade", [&](MeshBuilder& b) { addBalustrade(b, plane, -1.0f, 1.0f, 0.5f); });
    check("drape", [&](MeshBuilder& b) { addDrape(b, plane, {0.0f, 1.5f, 5.0f, 2.0f, 4.0f, 1.0f}); });
    check("vase", [](MeshBuilder& b) { addVase(b, {0, 0, 0}, 0.9f); });
    check("plant", [](MeshBuilder& b) { addPlant(b, {0, 0, 0}, 1.0f, 10, 0.0f); });
}

TEST_CASE("the built-in scenes are valid, lit, and have their cameras") {
    CHECK(builtinScenes().size() == 5);
    for (const std::string& name : builtinScenes()) {
        CAPTURE(name);
        const Result<Scene> scene = loadScene(name);
        REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
        CHECK(!scene->lights.empty());
        for (const Mesh& mesh : scene->meshes)
            if (mesh.name != "hills" && mesh.name != "forest")
                checkSolid(mesh); // those are open below the horizon
    }
    const Scene cornell = makeCornellBox();
    CHECK(cornell.cameras.at(0).name == "front");
    CHECK(cornell.cameras.size() == 2);
    const Scene atrium = makeAtrium();
    for (const char* camera : {"nave", "arcade", "gallery"}) CHECK(findCamera(atrium, camera));
    CHECK(atrium.triangleCount() > 20000);
    CHECK(atrium.triangleCount() < 150000);
    for (const auto& [scene, cameras] :
         {std::pair(makeStudy(), std::array{"desk", "room", "shelves"}),
          std::pair(makeStreet(), std::array{"cafe", "crossing", "square"}),
          std::pair(makeTunnel(), std::array{"railing", "grating", "ledge"})}) {
        CAPTURE(scene.name);
        for (const char* camera : cameras) CHECK(findCamera(scene, camera));
        CHECK(scene.triangleCount() > 5000);
        CHECK(scene.triangleCount() < 150000);
    }
}

TEST_CASE("the published blocks of the box have square corners and their height") {
    const Scene scene = makeCornellBox();
    for (const auto& [name, height] : {std::pair("short block", 1.65f), std::pair("tall block", 3.3f)}) {
        const std::string wanted = name;
        const auto block = std::find_if(scene.meshes.begin(), scene.meshes.end(),
                                        [&](const Mesh& mesh) { return mesh.name == wanted; });
        REQUIRE(block != scene.meshes.end());
        // The published corners are rounded to millimetres of a block of 16 cm: its base is within 2 %
        // of 1.65 m squared.
        CHECK(std::abs(signedVolume(*block) / (1.65 * 1.65 * static_cast<double>(height)) - 1.0) < 0.02);
    }
}

TEST_CASE("the atrium is the same every time") {
    const Scene a = makeAtrium(), b = makeAtrium();
    REQUIRE(a.meshes.size() == b.meshes.size());
    for (size_t i = 0; i < a.meshes.size(); ++i) {
        CHECK(a.meshes[i].positions == b.meshes[i].positions);
        CHECK(a.meshes[i].normals == b.meshes[i].normals);
        CHECK(a.meshes[i].indices == b.meshes[i].indices);
    }
    for (size_t i = 0; i < a.textures.size(); ++i) CHECK(a.textures[i].rgba == b.textures[i].rgba);
}

TEST_CASE("textures of stone meet themselves and keep within their two shades") {
    const Texture texture = makeStoneTexture("stone", {glm::vec3(0.5f), glm::vec3(0.25f)});
    const auto at = [&](int x, int y) {
        return int(
            texture
                .rgba[(static_cast<size_t>(y) * static_cast<size_t>(texture.width) + static_cast<size_t>(x)) *
                      4]);
    };
    // Linear 0.25 and 0.5 are 137 and 188 as sRGB.
    int low = 255, high = 0, insideStep = 0, seamStep = 0;
    for (int y = 0; y < texture.height; ++y) {
        seamStep = std::max(seamStep, std::abs(at(0, y) - at(texture.width - 1, y)));
        for (int x = 0; x < texture.width; ++x) {
            low = std::min(low, at(x, y));
            high = std::max(high, at(x, y));
            insideStep = std::max(insideStep, std::abs(at(x, y) - at(std::max(x - 1, 0), y)));
        }
    }
    CHECK(low >= 137);
    CHECK(high <= 188);
    CHECK(high > low);
    CHECK(seamStep <= insideStep);
}

} // namespace
} // namespace rebound::lab
