// SPDX-License-Identifier: MIT
// Motion of what pixels show, to the frame before.
#include "frame_test_scene.hpp"

#include "gltf_draft.hpp"
#include "lab/rays/camera_rays.hpp"
#include "lab/rays/embree_scene.hpp"
#include "lab/scenes/camera_matrices.hpp"
#include "lab/scenes/scene_files.hpp"
#include "lab/sequences/sequence.hpp"
#include "temporary_folder.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

using namespace rebound;
using namespace rebound::lab;

namespace {

constexpr Extent2D size{33, 18};

// Fills the view of frontCamera() at a depth of 4 m.
Scene frontalPlane() {
    Scene scene;
    addMaterial(scene, {0.5f, 0.5f, 0.5f});
    addQuad(scene, {0, 0, -4}, {20, 0, 0}, {0, 20, 0});
    return scene;
}

CameraView frontCamera() {
    CameraView camera;
    camera.target = {0, 0, -1};
    camera.verticalFieldOfView = 1.0f;
    return camera;
}

PreviousFrame previousOf(const Scene& scene, const CameraView& camera) {
    PreviousFrame previous{camera, {}};
    for (const Mesh& mesh : scene.meshes) previous.positions.push_back(mesh.positions);
    return previous;
}

Frame renderedAfter(const PreviousFrame& previous, const Scene& scene, const CameraView& camera) {
    return rendered(scene, camera, {.extent = size, .threads = 1, .previous = &previous});
}

// Pixels that a length of 1 m across the view covers at that depth.
double pixelsPerMetre(double depth) { return size.height / 2.0 / std::tan(0.5) / depth; }

// Of matrices, as an engine projects: the pixel of a point.
glm::dvec2 pixelOf(const CameraView& camera, glm::dvec3 point) {
    const Camera matrices = cameraMatrices(camera, size);
    const glm::dvec4 clip =
        glm::dmat4(matrices.projection) * (glm::dmat4(matrices.view) * glm::dvec4(point, 1.0));
    return {(clip.x / clip.w + 1.0) / 2.0 * size.width, (1.0 - clip.y / clip.w) / 2.0 * size.height};
}

} // namespace

TEST_CASE(
    "what stands still has no motion, to the last bit, and a frame without one before has none to tell") {
    const Scene scene = makeCornellBox();
    const CameraView camera = scene.cameras[0];
    const Frame still = renderedAfter(previousOf(scene, camera), scene, camera);
    REQUIRE(still.motion.extent() == size);
    REQUIRE(still.motion.channels == 2);
    CHECK(std::all_of(still.motion.data.begin(), still.motion.data.end(), [](float m) { return m == 0.0f; }));
    CHECK(rendered(scene, camera, {.extent = size, .threads = 1}).motion.empty());
}

TEST_CASE("motion leads from a pixel to where its surface was: to the left of what moves right, above what "
          "moves down") {
    const Scene before = frontalPlane();
    Scene after = before;
    for (glm::vec3& position : after.meshes[0].positions) position += glm::vec3(0.25f, -0.5f, 0.0f);
    const Frame frame = renderedAfter(previousOf(before, frontCamera()), after, frontCamera());
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            CHECK(double(frame.motion.at(x, y)[0]) ==
                  doctest::Approx(-0.25 * pixelsPerMetre(4.0)).epsilon(1e-5));
            CHECK(double(frame.motion.at(x, y)[1]) ==
                  doctest::Approx(-0.5 * pixelsPerMetre(4.0)).epsilon(1e-5));
        }
}

TEST_CASE("a camera that moves right sees what stands still where it was further to the right") {
    const Scene scene = frontalPlane();
    CameraView moved = frontCamera();
    moved.position.x = moved.target.x = 0.1f;
    const Frame frame = renderedAfter(previousOf(scene, frontCamera()), scene, moved);
    CHECK(double(frame.motion.at(5, 5)[0]) == doctest::Approx(0.1 * pixelsPerMetre(4.0)).epsilon(1e-5));
    CHECK(std::abs(frame.motion.at(5, 5)[1]) < 1e-5f);
    CHECK(frame.previousCamera.position.x == 0.0f);
}

TEST_CASE("motion of what turns agrees with matrices, under a camera that moves too") {
    const glm::mat4 turn =
        glm::rotate(glm::translate(glm::mat4(1.0f), {0.3f, 0.0f, 0.2f}), 0.2f, glm::vec3(0, 1, 0));
    const Scene before = makeCornellBox();
    const auto after = loadScene("builtin:cornell", {}, {{}, {}, {{"tall block", turn}}});
    REQUIRE(after);
    CameraView camera = before.cameras[0];
    const CameraView cameraBefore = camera;
    camera.position += glm::vec3(0.3f, 0.1f, -0.4f);
    const Frame frame = renderedAfter(previousOf(before, cameraBefore), *after, camera);
    const auto embree = EmbreeScene::build(*after);
    REQUIRE(embree);
    const CameraRays rays(camera, size);
    double worst = 0.0;
    int turned = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const CameraRay ray = rays.throughPixel(x, y);
            const auto hit = embree->intersect({glm::vec3(ray.origin), glm::vec3(ray.direction)});
            if (!hit) continue;
            const bool moves = after->meshes[hit->point.location.mesh].name == "tall block";
            turned += moves;
            const glm::dvec3 now = ray.origin + double(hit->distance) * ray.direction;
            const glm::dvec3 then =
                moves ? glm::dvec3(glm::inverse(glm::dmat4(turn)) * glm::dvec4(now, 1.0)) : now;
            const glm::dvec2 expected = pixelOf(cameraBefore, then) - glm::dvec2(x + 0.5, y + 0.5);
            const glm::dvec2 found(frame.motion.at(x, y)[0], frame.motion.at(x, y)[1]);
            worst = std::max(worst, glm::length(found - expected));
        }
    CHECK(turned > 10);
    // Matrices and distances in single precision: 1e-6 of 10 m, at up to 4 pixels a metre.
    CHECK(worst < 2e-4);
}

TEST_CASE("what was behind the camera is beyond every picture") {
    const Scene scene = frontalPlane();
    CameraView turned = frontCamera();
    turned.target = {0, 0, 1};
    const Frame frame = renderedAfter(previousOf(scene, turned), scene, frontCamera());
    CHECK(frame.motion.at(3, 4)[0] == behindCamera);
}

TEST_CASE("a frame before of another scene is refused") {
    PreviousFrame previous = previousOf(frontalPlane(), frontCamera());
    previous.positions[0].pop_back();
    const auto frame = renderFrame(frontalPlane(), frontCamera(), {.extent = size, .previous = &previous});
    REQUIRE(!frame);
    CHECK(frame.error().message.find("previous") != std::string::npos);
}

TEST_CASE("a sequence's frames are those of its scene at their times, each with motion to the one before") {
    SequenceOptions options;
    options.scene = "builtin:cornell";
    options.framesPerSecond = 10.0;
    options.path = *parsePath(R"({"interpolation": "linear",
        "camera": [{"time_s": 0, "position": [0, 2.7, 10], "target": [0, 2.7, 0]},
                   {"time_s": 1, "position": [1, 2.7, 9], "target": [0, 2.7, 0]}],
        "objects": {"short block": {"keys": [{"time_s": 0}, {"time_s": 1, "translation": [1, 0, 0]}]}}})",
                              "path");
    auto sequence = Sequence::open(options);
    REQUIRE_MESSAGE(sequence, (sequence ? "" : sequence.error().message));
    const FrameOptions frameOptions{.extent = size, .threads = 1};
    const auto first = sequence->next(frameOptions), second = sequence->next(frameOptions);
    REQUIRE(first);
    REQUIRE(second);
    CHECK(first->motion.empty());
    CHECK(second->camera.position.x == doctest::Approx(0.1));
    CHECK(second->previousCamera.position.x == doctest::Approx(0.0));
    const glm::mat4 moved = glm::translate(glm::mat4(1.0f), {0.1f, 0, 0});
    const auto scene = loadScene("builtin:cornell", {}, {{}, {}, {{"short block", moved}}});
    REQUIRE(scene);
    CHECK(rendered(*scene, second->camera, frameOptions).depth.data == second->depth.data);
    options.path.objects[0].name = "long block";
    const auto missing = Sequence::open(options);
    REQUIRE(!missing);
    for (const char* text : {"long block", "short block"})
        CHECK(missing.error().message.find(text) != std::string::npos);
}

namespace {

// Two boards below one node, "swing", and one beside it.
test::GltfDraft swingDraft() {
    test::GltfDraft draft;
    draft.addAccessor<float>("VEC3", 4, {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
    draft.addAccessor<uint16_t>("SCALAR", 6, {0, 1, 2, 0, 2, 3});
    for (const char* name : {"left board", "right board", "wall"})
        draft.add("meshes",
                  {{"name", name}, {"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}});
    draft.root["nodes"] = {{{"name", "swing"}, {"translation", {0, 0, -5}}, {"children", {1, 2}}},
                           {{"mesh", 0}, {"translation", {-1.5, 0, 0}}},
                           {{"mesh", 1}, {"translation", {1.5, 0, 0}}},
                           {{"mesh", 2}, {"translation", {0, 0, -9}}, {"scale", {20, 20, 1}}}};
    draft.add("scenes", {{"nodes", {0, 3}}});
    return draft;
}

SequenceOptions swingSequence(const std::filesystem::path& file) {
    SequenceOptions options;
    options.scene = file.string();
    options.framesPerSecond = 10.0;
    options.path = *parsePath(R"({"interpolation": "linear",
        "objects": {"swing": {"keys": [{"time_s": 0}, {"time_s": 1, "translation": [0.5, -1, 0]}]}}})",
                              "path");
    return options;
}

} // namespace

TEST_CASE("a node of a glTF file moves by its name, with all that is below it and nothing else") {
    TemporaryFolder folder;
    writeText(folder / "view.json", R"({"environment": {"type": "constant", "radiance": [1, 1, 1]},
        "cameras": [{"name": "front", "position": [0, 0, 0], "target": [0, 0, -1], "vfov_degrees": 57.29578}]})");
    auto sequence = Sequence::open(swingSequence(swingDraft().save(folder)));
    REQUIRE_MESSAGE(sequence, (sequence ? "" : sequence.error().message));
    const FrameOptions frameOptions{.extent = size, .lightSamples = 1, .threads = 1};
    REQUIRE(sequence->next(frameOptions));
    const auto second = sequence->next(frameOptions);
    REQUIRE(second);
    int onSwing = 0, onWall = 0;
    for (size_t i = 0; i < second->depth.data.size(); ++i) {
        const float depth = second->depth.data[i];
        const bool swings = depth == doctest::Approx(5.0f);
        REQUIRE((swings || depth == doctest::Approx(9.0f)));
        (swings ? onSwing : onWall)++;
        // 0.05 m to the right and 0.1 m down since the frame before.
        CHECK(double(second->motion.data[2 * i]) ==
              doctest::Approx(swings ? -0.05 * pixelsPerMetre(5.0) : 0.0).epsilon(1e-4));
        CHECK(double(second->motion.data[2 * i + 1]) ==
              doctest::Approx(swings ? -0.1 * pixelsPerMetre(5.0) : 0.0).epsilon(1e-4));
    }
    CHECK(onSwing > 50);
    CHECK(onWall > 50);
}

TEST_CASE("a sequence reads its files once") {
    TemporaryFolder folder;
    writeText(folder / "view.json", R"({"environment": {"type": "constant", "radiance": [1, 1, 1]},
        "cameras": [{"name": "front", "position": [0, 0, 0], "target": [0, 0, -1], "vfov_degrees": 60}]})");
    test::GltfDraft draft = swingDraft();
    // A picture, by which light would change if it were lost.
    draft.add("images", {{"uri", "red.png"}});
    draft.add("textures", {{"source", 0}});
    draft.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    const int coordinates = draft.addAccessor<float>("VEC2", 4, {0, 0, 1, 0, 1, 1, 0, 1});
    for (auto& mesh : draft.root["meshes"]) {
        mesh["primitives"][0]["material"] = 0;
        mesh["primitives"][0]["attributes"]["TEXCOORD_0"] = coordinates;
    }
    const test::Bytes png = test::makePng(1, 1, 8, {255, 0, 0, 255});
    test::writeBytes(folder / "red.png", png.data(), png.size());
    const auto file = draft.save(folder);
    const SequenceOptions options = swingSequence(file);
    const glm::mat4 there = placeAt(options.path, options.path.objects[0], 0.2);
    const auto expected = loadScene(file.string(), {}, {{}, {}, {{"swing", there}}});
    REQUIRE_MESSAGE(expected, (expected ? "" : expected.error().message));
    auto sequence = Sequence::open(options);
    REQUIRE(sequence);
    for (const char* name : {"scene.gltf", "scene.bin", "red.png", "view.json"})
        REQUIRE(std::filesystem::remove(folder / name));
    const FrameOptions frameOptions{.extent = size, .lightSamples = 1, .threads = 1};
    REQUIRE(sequence->next(frameOptions));
    REQUIRE(sequence->next(frameOptions));
    const auto third = sequence->next(frameOptions);
    REQUIRE_MESSAGE(third, (third ? "" : third.error().message));
    const Frame whole = rendered(*expected, third->camera, frameOptions);
    CHECK(third->depth.data == whole.depth.data);
    CHECK(third->albedo.data == whole.albedo.data);
    CHECK(third->albedo.at(16, 9)[0] == 1.0f);
    CHECK(third->albedo.at(16, 9)[1] == 0.0f);
    CHECK(third->direct.data == whole.direct.data);
}
