// SPDX-License-Identifier: MIT
// An open court between two storeys of arcades, hung with coloured cloth: sunlight falls on floor and walls,
// and most of what is seen is lit by what they reflect.
#include "lab/scenes/scene_files.hpp"

#include "lab/scenes/atrium_parts.hpp"
#include "lab/scenes/builtin_textures.hpp"
#include "lab/scenes/mesh_builder.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace rebound::lab {
namespace {

// Half extents of the court's column lines and of the outer walls' inner faces [m].
constexpr glm::vec2 court(11.0f, 3.6f);
constexpr glm::vec2 hall(14.4f, 7.0f);
constexpr float wallThickness = 0.6f;
constexpr int longBays = 8, shortBays = 3;

struct Storey {
    float floor, spring, top; // heights [m]
    float columnRadius;
};
constexpr Storey ground{0.0f, 3.0f, 4.5f, 0.24f};
constexpr Storey gallery{4.9f, 7.2f, 8.6f, 0.19f};
constexpr float parapetTop = 9.6f;

struct Side {
    WallPlane plane; // faces the court, its origin at the side's middle
    float half;      // along it
    int bays;

    float bayWidth() const { return 2.0f * half / static_cast<float>(bays); }
    float line(int i) const { return -half + bayWidth() * static_cast<float>(i); }
};

std::array<Side, 4> sides() {
    return {Side{{{0, 0, -court.y}, {1, 0, 0}, {0, 0, 1}}, court.x, longBays},
            Side{{{0, 0, court.y}, {-1, 0, 0}, {0, 0, -1}}, court.x, longBays},
            Side{{{-court.x, 0, 0}, {0, 0, -1}, {1, 0, 0}}, court.y, shortBays},
            Side{{{court.x, 0, 0}, {0, 0, 1}, {-1, 0, 0}}, court.y, shortBays}};
}

// The materials, in the order of the scene's list.
enum Surface { masonry, carved, paving, plaster, wood, red, green, blue, terracotta, leaf, surfaceCount };

struct Atrium {
    std::vector<MeshBuilder> meshes;

    Atrium() {
        constexpr std::array<const char*, surfaceCount> names = {
            "walls",     "carved stone", "paving",     "plaster", "wood",
            "red cloth", "green cloth",  "blue cloth", "vases",   "plants"};
        for (int i = 0; i < surfaceCount; ++i)
            meshes.emplace_back(names[static_cast<size_t>(i)], i, i == masonry || i == paving ? 0.5f : 1.0f);
    }
    MeshBuilder& operator[](Surface surface) { return meshes[surface]; }
};

std::array<glm::vec2, 4> rectangle(float inner, float outer, float low, float high) {
    return {glm::vec2(inner, low), {outer, low}, {outer, high}, {inner, high}};
}

void addShell(Atrium& atrium) {
    const glm::vec2 outer = hall + wallThickness;
    atrium[paving].box({-outer.x, -0.4f, -outer.y}, {outer.x, 0.0f, outer.y});
    atrium[masonry].frame(rectangle(0.0f, wallThickness, 0.0f, gallery.top + 0.4f), hall);
    // Slabs reach from a little before the columns into the outer walls. The corridors are of one width all
    // around.
    const float reach = hall.x - court.x + 0.2f;
    atrium[plaster].frame(rectangle(-0.3f, reach, ground.top, gallery.floor - 0.08f), court);
    atrium[paving].frame(rectangle(-0.3f, reach, gallery.floor - 0.08f, gallery.floor), court);
    atrium[plaster].frame(rectangle(-0.3f, reach, gallery.top, gallery.top + 0.4f), court);
}

void addCornices(Atrium& atrium) {
    const auto cornice = [&](float bottom, float projection) {
        const std::array<glm::vec2, 6> profile = {glm::vec2(-0.28f, bottom),
                                                  {-0.2f, bottom},
                                                  {-0.2f, bottom + 0.36f},
                                                  {-0.3f - projection, bottom + 0.36f},
                                                  {-0.3f - projection, bottom + 0.26f},
                                                  {-0.34f, bottom + 0.1f}};
        atrium[carved].frame(profile, court);
    };
    cornice(ground.top + 0.02f, 0.16f);
    cornice(gallery.top + 0.02f, 0.22f);
    atrium[masonry].frame(rectangle(-0.15f, 0.2f, gallery.top + 0.4f, parapetTop - 0.12f), court);
    atrium[carved].frame(rectangle(-0.24f, 0.29f, parapetTop - 0.12f, parapetTop), court);
    // A dado and a band along the outer walls.
    atrium[carved].frame(rectangle(-0.06f, 0.1f, 0.0f, 0.5f), hall);
    atrium[carved].frame(rectangle(-0.05f, 0.1f, ground.spring, ground.spring + 0.14f), hall);
    atrium[carved].frame(rectangle(-0.05f, 0.1f, gallery.floor, gallery.floor + 0.3f), hall);
}

// Beams and pilasters behind a column, to the outer wall.
void addBeam(Atrium& atrium, const Side& side, float s, const Storey& storey) {
    const float depth = hall.x - court.x;
    const auto box = [&](float width, float low, float high, float from, float to, Surface surface) {
        const glm::vec3 a = side.plane.at(s - width / 2, low, -from),
                        b = side.plane.at(s + width / 2, high, -to);
        atrium[surface].box(glm::min(a, b), glm::max(a, b));
    };
    box(0.34f, storey.top - 0.38f, storey.top, 0.2f, depth + 0.1f, plaster);
    box(0.5f, storey.floor, storey.top - 0.38f, depth - 0.12f, depth + 0.1f, carved);
}

void addArcade(Atrium& atrium, const Side& side, const Storey& storey) {
    for (int i = 0; i < side.bays; ++i) {
        Arch arch;
        arch.begin = side.line(i);
        arch.end = side.line(i + 1);
        arch.spring = storey.spring;
        arch.top = storey.top;
        arch.radius = side.bayWidth() / 2.0f - 1.4f * storey.columnRadius;
        arch.thickness = 0.44f;
        addArch(atrium[carved], side.plane, arch);
    }
    for (int i = 1; i < side.bays; ++i) {
        addColumn(atrium[carved], side.plane.at(side.line(i), storey.floor, 0.0f),
                  storey.spring - storey.floor, storey.columnRadius);
        addBeam(atrium, side, side.line(i), storey);
    }
}

void addCornerPiers(Atrium& atrium, const Storey& storey) {
    for (const float x : {-court.x, court.x})
        for (const float z : {-court.y, court.y}) {
            const float half = 1.4f * storey.columnRadius;
            atrium[carved].box({x - half, storey.floor, z - half}, {x + half, storey.top, z + half});
            atrium[carved].box({x - half - 0.05f, storey.floor, z - half - 0.05f},
                               {x + half + 0.05f, storey.floor + 0.3f, z + half + 0.05f});
            atrium[carved].box({x - half - 0.04f, storey.spring - 0.14f, z - half - 0.04f},
                               {x + half + 0.04f, storey.spring, z + half + 0.04f});
        }
}

void addBalustrades(Atrium& atrium, const Side& side) {
    const float clear = 1.55f * gallery.columnRadius;
    for (int i = 0; i < side.bays; ++i)
        addBalustrade(atrium[carved], side.plane, side.line(i) + clear, side.line(i + 1) - clear,
                      gallery.floor);
}

// A rod of square section along a side, with cloth below it.
void addHanging(Atrium& atrium, Surface cloth, const WallPlane& plane, const Drape& drape, float rodLength) {
    addDrape(atrium[cloth], plane, drape);
    const glm::vec3 a = plane.at(drape.middle - rodLength / 2, drape.top - 0.02f, -0.035f);
    const glm::vec3 b = plane.at(drape.middle + rodLength / 2, drape.top + 0.05f, 0.035f);
    atrium[wood].box(glm::min(a, b), glm::max(a, b));
}

// Curtains in the gallery's arches, up to where these begin to bend.
void addCurtains(Atrium& atrium, const Side& side, int seed) {
    int number = seed;
    for (const int bay : {1, 3, 5, 6}) {
        Drape drape;
        drape.middle = side.line(bay) + side.bayWidth() / 2.0f;
        drape.width = side.bayWidth() - 2.6f * gallery.columnRadius;
        drape.top = gallery.spring - 0.2f;
        drape.bottom = gallery.floor + 1.05f;
        drape.folds = 5.0f + static_cast<float>(number % 3);
        drape.phase = 1.3f * static_cast<float>(number);
        addHanging(atrium, Surface(red + number++ % 3), side.plane, drape,
                   side.bayWidth() - 1.6f * gallery.columnRadius);
    }
}

// Banners before the cornice, from the balustrade far down, each on two brackets.
void addBanners(Atrium& atrium, const Side& side, int seed) {
    WallPlane before = side.plane;
    before.origin += 0.62f * side.plane.through;
    int number = seed;
    for (const int bay : {2, 4, 7}) {
        Drape drape;
        drape.middle = side.line(bay) + side.bayWidth() / 2.0f;
        drape.width = 1.5f;
        drape.top = gallery.floor + 0.9f;
        drape.bottom = 1.9f + 0.35f * static_cast<float>(number % 3);
        drape.folds = 4.0f;
        drape.phase = 0.9f * static_cast<float>(number);
        addHanging(atrium, Surface(red + number++ % 3), before, drape, 1.7f);
        for (const float s : {-0.7f, 0.7f}) {
            const glm::vec3 a = before.at(drape.middle + s - 0.02f, drape.top - 0.01f, -0.62f);
            const glm::vec3 b = before.at(drape.middle + s + 0.02f, drape.top + 0.04f, 0.02f);
            atrium[wood].box(glm::min(a, b), glm::max(a, b));
        }
    }
}

void addDoors(Atrium& atrium) {
    for (const float z : {-1.0f, 1.0f})
        for (const float x : {-6.9f, -1.4f, 4.1f, 9.6f}) {
            const float face = z * hall.y, out = z * (hall.y - 0.1f);
            const auto box = [&](float left, float right, float low, float high, float depth,
                                 Surface surface) {
                const glm::vec3 a(x + left, low, face), b(x + right, high, out - z * depth);
                atrium[surface].box(glm::min(a, b), glm::max(a, b));
            };
            box(-0.6f, 0.6f, 0.0f, 2.3f, -0.02f, wood);
            box(-0.78f, -0.6f, 0.0f, 2.5f, 0.05f, carved);
            box(0.6f, 0.78f, 0.0f, 2.5f, 0.05f, carved);
            box(-0.6f, 0.6f, 2.3f, 2.5f, 0.05f, carved);
        }
}

void addPots(Atrium& atrium) {
    float phase = 0.0f;
    for (const float x : {-8.3f, -2.75f, 2.75f, 8.3f})
        for (const float z : {-2.4f, 2.4f}) {
            const glm::vec3 foot(x, 0.0f, z);
            addVase(atrium[terracotta], foot, 0.85f);
            addPlant(atrium[leaf], foot + glm::vec3(0, 0.6f, 0), 1.0f, 36, phase += 1.0f);
        }
    // A basin on steps in the middle.
    atrium[carved].box({-1.3f, 0.0f, -1.3f}, {1.3f, 0.14f, 1.3f});
    atrium[carved].box({-0.95f, 0.14f, -0.95f}, {0.95f, 0.28f, 0.95f});
    const std::array<glm::vec2, 14> basin = {glm::vec2(0, 0), {0.4f, 0},     {0.34f, 0.12f}, {0.2f, 0.22f},
                                             {0.18f, 0.45f},  {0.3f, 0.56f}, {0.75f, 0.7f},  {0.86f, 0.8f},
                                             {0.88f, 0.9f},   {0.8f, 0.9f},  {0.76f, 0.84f}, {0.62f, 0.77f},
                                             {0.2f, 0.72f},   {0, 0.72f}};
    atrium[carved].revolve(basin, {0.0f, 0.28f, 0.0f}, 40);
}

Material makeMaterial(const char* name, const glm::vec3& reflectance, int texture = none) {
    Material material;
    material.name = name;
    material.baseColor = glm::vec4(reflectance, 1.0f);
    material.baseColorTexture = texture;
    return material;
}

void addMaterials(Scene& scene) {
    const Stone sandstone{{0.66f, 0.56f, 0.43f}, {0.42f, 0.33f, 0.23f}};
    const Stone limestone{{0.74f, 0.68f, 0.57f}, {0.56f, 0.49f, 0.38f}};
    const Stone marble{{0.72f, 0.67f, 0.58f}, {0.55f, 0.49f, 0.4f}};
    const Stone porphyry{{0.5f, 0.3f, 0.22f}, {0.33f, 0.19f, 0.14f}};
    scene.textures = {makeMasonryTexture("masonry", sandstone, {0.24f, 0.2f, 0.16f}),
                      makeStoneTexture("limestone", limestone),
                      makeTileTexture("paving", marble, porphyry, {0.2f, 0.17f, 0.14f})};
    const glm::vec3 whole(1.0f);
    scene.materials = {makeMaterial("masonry", whole, 0),
                       makeMaterial("limestone", whole, 1),
                       makeMaterial("paving", whole, 2),
                       makeMaterial("plaster", {0.72f, 0.66f, 0.56f}),
                       makeMaterial("wood", {0.16f, 0.09f, 0.05f}),
                       makeMaterial("red cloth", {0.6f, 0.04f, 0.035f}),
                       makeMaterial("green cloth", {0.05f, 0.33f, 0.07f}),
                       makeMaterial("blue cloth", {0.05f, 0.12f, 0.5f}),
                       makeMaterial("terracotta", {0.55f, 0.24f, 0.13f}),
                       makeMaterial("leaves", {0.11f, 0.27f, 0.06f})};
}

Light makeSun() {
    Light sun;
    sun.name = "sun";
    sun.type = LightType::directional;
    sun.direction = glm::normalize(glm::vec3(0.42f, -1.0f, 0.3f));
    sun.intensity = 20.0f * glm::vec3(1.0f, 0.93f, 0.82f);
    return sun;
}

CameraView makeCamera(const char* name, const glm::vec3& position, const glm::vec3& target) {
    CameraView camera;
    camera.name = name;
    camera.position = position;
    camera.target = target;
    camera.verticalFieldOfView = glm::radians(60.0f);
    camera.farPlane = 200.0f;
    return camera;
}

} // namespace

Scene makeAtrium() {
    Atrium atrium;
    addShell(atrium);
    addCornices(atrium);
    for (const Storey& storey : {ground, gallery}) {
        for (const Side& side : sides()) addArcade(atrium, side, storey);
        addCornerPiers(atrium, storey);
    }
    for (const Side& side : sides()) addBalustrades(atrium, side);
    int seed = 0;
    for (const Side& side : sides())
        if (side.bays == longBays) {
            addCurtains(atrium, side, seed);
            addBanners(atrium, side, seed + 2);
            ++seed;
        }
    addDoors(atrium);
    addPots(atrium);

    Scene scene;
    scene.name = "atrium";
    addMaterials(scene);
    for (MeshBuilder& mesh : atrium.meshes) scene.meshes.push_back(mesh.take());
    scene.lights = {makeSun()};
    scene.environment = {0.55f, 0.75f, 1.1f};
    scene.cameras = {makeCamera("nave", {-10.2f, 1.8f, -0.5f}, {6.0f, 3.6f, 0.3f}),
                     makeCamera("arcade", {-9.6f, 1.7f, 5.4f}, {4.0f, 1.9f, 3.4f}),
                     makeCamera("gallery", {10.4f, 6.6f, 5.0f}, {-5.0f, 4.6f, -1.5f})};
    return scene;
}

} // namespace rebound::lab
