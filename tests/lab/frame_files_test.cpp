// SPDX-License-Identifier: MIT
#include "lab/images/image_files.hpp"
#include "lab/scenes/camera_json.hpp"

#include "exr_draft.hpp"
#include "frame_test_scene.hpp"
#include "temporary_folder.hpp"

#include <nlohmann/json.hpp>

using namespace rebound;
using namespace rebound::lab;

namespace {

constexpr const char* meta = R"({"scene": "floor", "camera": {"name": "down", "position": [0, 2, 0],
    "target": [0, 0, 0], "up": [0, 0, -1], "vfov_degrees": 50, "near": 0.1, "far": 20}})";

constexpr const char* view = R"({"cameras": [
    {"name": "first", "position": [1, 2, 3], "target": [0, 0, 0], "vfov_degrees": 40, "up": [0, 1, 0], "near": 0.1, "far": 20},
    {"name": "second", "position": [4, 5, 6], "target": [0, 0, 0], "vfov_degrees": 30,
     "up": [0, 1, 0], "near": 0.1, "far": 20}],
    "lights": [], "environment": {"type": "constant", "radiance": [0, 0, 0]}, "emissive_materials": true,
    "units": {"length": "metres"}})";

void store(const Frame& frame, const TemporaryFolder& folder) {
    REQUIRE(writeExr(folder / "depth.exr", frame.depth, ExrPrecision::full));
    REQUIRE(writeExr(folder / "normal.exr", frame.normal, ExrPrecision::full));
    REQUIRE(writeExr(folder / "albedo.exr", frame.albedo, ExrPrecision::full));
    REQUIRE(writeExr(folder / "direct.exr", frame.direct, ExrPrecision::full));
    if (!frame.emission.empty())
        REQUIRE(writeExr(folder / "emission.exr", frame.emission, ExrPrecision::full));
    writeText(folder / "meta.json", meta);
}

Frame smallFrame() {
    Scene scene = floorScene();
    scene.environment = {1, 2, 3};
    addQuad(scene, {0, 0.5f, 0}, {0, 0, 0.3f}, {0.3f, 0, 0}, addMaterial(scene, glm::vec3(0.2f), {4, 5, 6}));
    return rendered(scene, downCamera(), {.extent = {12, 8}, .lightSamples = 4, .threads = 1});
}

Result<CameraView> parsed(const char* text) {
    return cameraFromJson(nlohmann::json::parse(text), "view.json: camera 3");
}

} // namespace

TEST_CASE("a stored frame is read back") {
    const TemporaryFolder folder;
    const Frame frame = smallFrame();
    store(frame, folder);
    const auto read = readFrame(folder.path());
    REQUIRE_MESSAGE(read, (read ? "" : read.error().message));
    CHECK(read->depth.data == frame.depth.data);
    CHECK(read->normal.data == frame.normal.data);
    CHECK(read->albedo.data == frame.albedo.data);
    CHECK(read->direct.data == frame.direct.data);
    CHECK(read->emission.data == frame.emission.data);
    CHECK(read->camera.name == "down");
    CHECK(read->camera.position == glm::vec3(0, 2, 0));
    CHECK(read->camera.up == glm::vec3(0, 0, -1));
    CHECK(read->camera.verticalFieldOfView == doctest::Approx(50 * 3.14159265 / 180));
    CHECK(read->camera.nearPlane == 0.1f);
    CHECK(read->camera.farPlane == 20.0f);
    CHECK(readFrame(folder.path(), {}, "down"));
    CHECK_FALSE(readFrame(folder.path(), {}, "up"));
    std::filesystem::remove(folder / "emission.exr");
    CHECK(readFrame(folder.path())->emission.empty());
}

TEST_CASE("what other programs mark the sky by counts as no surface, and is noted") {
    const TemporaryFolder folder;
    const Frame frame = smallFrame();
    for (const float sky : {std::numeric_limits<float>::infinity(), 1e10f, 65504.0f, 20.0f}) { // far is 20 m
        CAPTURE(sky);
        Frame marked = frame;
        *marked.depth.at(3, 2) = *marked.depth.at(4, 2) = sky;
        store(marked, folder);
        const auto read = readFrame(folder.path());
        REQUIRE_MESSAGE(read, (read ? "" : read.error().message));
        CHECK(*read->depth.at(3, 2) == 0.0f);
        CHECK(*read->depth.at(5, 2) == *frame.depth.at(5, 2));
        REQUIRE(read->notes.size() == 1);
        CHECK(read->notes[0].find("depth.exr: 2 pixels (2.1 %)") != std::string::npos);
    }
    store(frame, folder);
    CHECK(readFrame(folder.path())->notes.empty());

    // Nothing says that this is sky; but it may be.
    Frame walled = frame;
    for (int x = 0; x < 12; ++x) *walled.depth.at(x, 0) = 9.0f;
    store(walled, folder);
    const auto read = readFrame(folder.path());
    CHECK(*read->depth.at(3, 0) == 9.0f);
    REQUIRE(read->notes.size() == 1);
    CHECK(read->notes[0].find("12 % of the pixels hold the largest depth, 9.0") != std::string::npos);
}

TEST_CASE("the images of a frame are read as what they are") {
    const TemporaryFolder folder;
    const Frame frame = smallFrame();
    store(frame, folder);
    // Normals by axes, depth called Z, with a part of the picture only.
    ExrDraft normal, depth;
    normal.displayWindow = normal.dataWindow = depth.displayWindow = {{0, 0}, {11, 7}};
    for (size_t i = 0; i < frame.normal.data.size(); ++i)
        normal.channels[std::string(1, "XYZ"[i % 3])].push_back(frame.normal.data[i]);
    normal.write(folder / "normal.exr");
    depth.dataWindow = {{2, 1}, {5, 3}};
    for (int y = 1; y <= 3; ++y)
        for (int x = 2; x <= 5; ++x) depth.channels["Z"].push_back(*frame.depth.at(x, y));
    depth.write(folder / "depth.exr");
    const auto read = readFrame(folder.path());
    REQUIRE_MESSAGE(read, (read ? "" : read.error().message));
    CHECK(read->normal.data == frame.normal.data);
    CHECK(*read->depth.at(2, 1) == *frame.depth.at(2, 1));
    CHECK(*read->depth.at(5, 3) == *frame.depth.at(5, 3));
    CHECK(*read->depth.at(1, 1) == 0.0f); // no surface, and still in its place
    REQUIRE(read->notes.size() == 1);
    CHECK(read->notes[0].find("its data window, 2, 1 to 5, 3") != std::string::npos);
}

TEST_CASE("a stored frame says whether its emission is direct light") {
    const TemporaryFolder folder;
    store(smallFrame(), folder);
    CHECK(readFrame(folder.path())->emissionIsDirectLight);
    nlohmann::json described = nlohmann::json::parse(meta);
    for (const bool flag : {true, false}) {
        described["emissive_materials"] = flag;
        writeText(folder / "meta.json", described.dump());
        CHECK(readFrame(folder.path())->emissionIsDirectLight == flag);
    }
    nlohmann::json viewed = nlohmann::json::parse(view);
    viewed["emissive_materials"] = true;
    writeText(folder / "view.json", viewed.dump());
    CHECK(readFrame(folder.path(), folder / "view.json")->emissionIsDirectLight); // meta.json says otherwise
    described["emissive_materials"] = "yes";
    writeText(folder / "meta.json", described.dump());
    const auto read = readFrame(folder.path());
    REQUIRE(!read);
    CHECK(read.error().message.find("\"emissive_materials\" is \"yes\"; expected true or false") !=
          std::string::npos);
    viewed.erase("cameras");
    writeText(folder / "view.json", viewed.dump());
    CHECK(readFrame(folder.path(), folder / "view.json").error().message.find("no cameras") !=
          std::string::npos);
}

TEST_CASE("a view file's camera replaces the stored one") {
    const TemporaryFolder folder;
    store(smallFrame(), folder);
    std::filesystem::remove(folder / "meta.json");
    writeText(folder / "view.json", view);
    const auto first = readFrame(folder.path(), folder / "view.json");
    REQUIRE_MESSAGE(first, (first ? "" : first.error().message));
    CHECK(first->camera.name == "first");
    const auto second = readFrame(folder.path(), folder / "view.json", "second");
    REQUIRE(second);
    CHECK(second->camera.position == glm::vec3(4, 5, 6));
    const auto third = readFrame(folder.path(), folder / "view.json", "third");
    REQUIRE(!third);
    CHECK(third.error().message.find("third") != std::string::npos);
}

TEST_CASE("grey and alpha are taken for what they are") {
    const TemporaryFolder folder;
    Frame frame = smallFrame();
    store(frame, folder);
    Image grey(frame.depth.extent(), 1, 0.25f);
    Image alpha(frame.depth.extent(), 4, 0.5f);
    REQUIRE(writeExr(folder / "albedo.exr", grey));
    REQUIRE(writeExr(folder / "direct.exr", alpha));
    const auto read = readFrame(folder.path());
    REQUIRE(read);
    CHECK(colorAt(read->albedo, 3, 2) == glm::vec3(0.25f));
    CHECK(colorAt(read->direct, 3, 2) == glm::vec3(0.5f));
}

TEST_CASE("what is wrong with a stored frame is named") {
    const auto message = [](const TemporaryFolder& folder) {
        const auto read = readFrame(folder.path());
        REQUIRE(!read);
        return read.error().message;
    };
    const auto names = [&](const TemporaryFolder& folder, const char* part) {
        return message(folder).find(part) != std::string::npos;
    };
    const TemporaryFolder folder;
    CHECK(names(folder, "meta.json"));
    const Frame frame = smallFrame();
    store(frame, folder);
    std::filesystem::remove(folder / "albedo.exr");
    CHECK(names(folder, "albedo.exr"));
    REQUIRE(writeExr(folder / "albedo.exr", Image({3, 3}, 3)));
    CHECK(names(folder, "albedo has 3 x 3"));
    store(frame, folder);
    REQUIRE(writeExr(folder / "depth.exr", frame.normal));
    CHECK(names(folder, "depth.exr"));
    store(frame, folder);
    for (const char* bad : {"", "{", "[]", "{}", "3", R"({"camera": 3})", R"({"camera": {}})"}) {
        writeText(folder / "meta.json", bad);
        CHECK(names(folder, "meta.json"));
    }
    writeText(folder / "meta.json",
              R"({"camera": )" + std::string(100000, '[') + std::string(100000, ']') + "}");
    CHECK(names(folder, "nested deeper"));
    CHECK_FALSE(readFrame(folder / "nowhere"));
    CHECK_FALSE(readFrame(folder / "depth.exr"));
}

TEST_CASE("cameras in JSON") {
    const auto orthographic =
        parsed(R"({"position": [0, 1, 2], "target": [0, 0, 0], "orthographic_height": 3})");
    REQUIRE(orthographic);
    CHECK(orthographic->orthographic);
    CHECK(orthographic->orthographicHeight == 3.0f);
    CHECK(orthographic->up == glm::vec3(0, 1, 0));
    for (const char* bad : {
             "[]",
             R"({"target": [0, 0, 0], "vfov_degrees": 50})",
             R"({"position": [0, 1, 2], "vfov_degrees": 50})",
             R"({"position": [0, 1, 2], "target": [0, 0, 0]})",
             R"({"position": [0, 1, 2], "target": [0, 0, 0], "vfov_degrees": 50, "orthographic_height": 1})",
             R"({"position": [0, 1], "target": [0, 0, 0], "vfov_degrees": 50})",
             R"({"position": [0, 1, 1e300], "target": [0, 0, 0], "vfov_degrees": 50})",
             R"({"position": [0, 1, "2"], "target": [0, 0, 0], "vfov_degrees": 50})",
             R"({"position": [0, 1, 2], "target": [0, 1, 2], "vfov_degrees": 50})",
             R"({"position": [0, 1, 2], "target": [0, 3, 2], "vfov_degrees": 50})",
             R"({"position": [0, 1, 2], "target": [0, 0, 0], "vfov_degrees": 0})",
             R"({"position": [0, 1, 2], "target": [0, 0, 0], "vfov_degrees": 180})",
             R"({"position": [0, 1, 2], "target": [0, 0, 0], "vfov_degrees": "50"})",
             R"({"position": [0, 1, 2], "target": [0, 0, 0], "vfov_degrees": 50, "near": 5, "far": 4})",
             R"({"position": [0, 1, 2], "target": [0, 0, 0], "vfov_degrees": 50, "name": 4})",
         }) {
        CAPTURE(bad);
        const auto camera = parsed(bad);
        REQUIRE(!camera);
        CHECK(camera.error().code == ErrorCode::invalidData);
        CHECK(camera.error().message.find("view.json: camera 3") == 0);
    }
}

TEST_CASE("a frame is valid when its images are there and of one size") {
    const Frame good = smallFrame();
    CHECK(validate(good));
    CHECK_FALSE(validate(Frame()));
    for (Image Frame::*part : {&Frame::depth, &Frame::normal, &Frame::albedo, &Frame::direct}) {
        Frame bad = good;
        (bad.*part) = {};
        CHECK_FALSE(validate(bad));
        CHECK(outgoingRadiance(bad).empty());
        bad.*part = Image({5, 5}, part == &Frame::depth ? 1 : 3);
        CHECK_FALSE(validate(bad));
        bad = good;
        (bad.*part).data.pop_back();
        CHECK_FALSE(validate(bad));
    }
    Frame bad = good;
    bad.emission = Image({12, 8}, 1);
    CHECK_FALSE(validate(bad));
}
