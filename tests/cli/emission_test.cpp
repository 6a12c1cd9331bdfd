// SPDX-License-Identifier: MIT
// Light of emissive surfaces arrives once, whichever way it goes.
#include "command_line.hpp"

#include "../lab/gltf_draft.hpp"

#include "lab/images/image_files.hpp"
#include "lab/rays/frame.hpp"
#include "lab/scenes/scene_files.hpp"

#include <algorithm>

namespace rebound::cli {
namespace {

using lab::test::GltfDraft;
using lab::test::Json;

// A lamp of 0.6 m x 0.6 m, 0.4 m above a black floor of 4 m x 4 m, both seen from the side. The lamp faces the floor and
// stands a little upright, so that the camera sees its glowing side.
GltfDraft lampDraft() {
    GltfDraft draft;
    draft.addAccessor<float>("VEC3", 4, {-2, 0, -2, 2, 0, -2, 2, 0, 2, -2, 0, 2});
    draft.addAccessor<float>("VEC3", 4,
                             {-0.3f, 0.4f, -0.3f, 0.3f, 0.4f, -0.3f, 0.3f, 0.9f, -0.6f, -0.3f, 0.9f, -0.6f});
    draft.addAccessor<uint16_t>("SCALAR", 6, {0, 1, 2, 0, 2, 3});
    for (int mesh : {0, 1}) {
        draft.add("meshes", {{"primitives",
                              {{{"attributes", {{"POSITION", mesh}}}, {"indices", 2}, {"material", mesh}}}}});
        draft.add("nodes", {{"mesh", mesh}});
    }
    const Json black = {{"baseColorFactor", {0, 0, 0, 1}}};
    draft.add("materials", {{"pbrMetallicRoughness", black}});
    draft.add("materials", {{"pbrMetallicRoughness", black}, {"emissiveFactor", {1, 1, 1}}});
    draft.add("scenes", {{"nodes", {0, 1}}});
    draft.root["scene"] = 0;
    return draft;
}

constexpr const char* camera =
    R"("cameras": [{"name": "c", "position": [0, 1.4, 4], "target": [0, 0.3, 0], "vfov_degrees": 40}])";

lab::Image read(const std::filesystem::path& file) {
    auto image = lab::readExr(file);
    REQUIRE_MESSAGE(image, (image ? "" : image.error().message));
    return *image;
}

float largest(const lab::Image& image) { return *std::max_element(image.data.begin(), image.data.end()); }

void succeeds(const std::string& arguments, const lab::TemporaryFolder& folder) {
    const Outcome outcome = run(arguments, folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
}

} // namespace

TEST_CASE("where emissive surfaces light directly, nothing of it is gathered again") {
    const lab::TemporaryFolder folder;
    lampDraft().save(folder, "lamp.gltf");
    lab::writeText(folder / "on.json", std::string("{") + camera + "}");
    lab::writeText(folder / "off.json", std::string("{\"emissive_materials\": false, ") + camera + "}");
    const std::string common = " --size 96x54 --precision float";

    // All surfaces are black: nothing reflects, and so nothing may be gathered.
    succeeds("render lamp.gltf --view on.json --out on" + common, folder);
    CHECK(largest(read(folder / "on" / "indirect.exr")) < 1e-5f);
    const lab::Image seen = read(folder / "on" / "direct.exr");
    CHECK(largest(seen) == 1.0f); // the lamp

    // Left to be gathered, it arrives by gathering alone.
    succeeds("render lamp.gltf --view off.json --out off" + common, folder);
    // A hundred times what may be there above: 24x14 texels, and a mean over 5x5 of them, leave little of the peak.
    CHECK(largest(read(folder / "off" / "indirect.exr")) > 1e-3f);
    CHECK(read(folder / "off" / "direct.exr").data == seen.data);

    // The path tracer says the same of both, and writes frames that --frame gathers from in the same way.
    const std::string traced = " --technique reference --bounces 1 --spp 64 --size 96x54";
    succeeds("render lamp.gltf --view on.json --out traced-on" + traced, folder);
    succeeds("render lamp.gltf --view off.json --out traced-off" + traced, folder);
    CHECK(largest(read(folder / "traced-on" / "indirect.exr")) < 1e-5f);
    CHECK(largest(read(folder / "traced-on" / "direct.exr")) > 0.01f);
    CHECK(largest(read(folder / "traced-off" / "indirect.exr")) > 0.01f);
    CHECK(largest(read(folder / "traced-off" / "direct.exr")) == 0.0f);
    succeeds("render --frame traced-on --precision float --out again-on", folder);
    succeeds("render --frame traced-off --precision float --out again-off", folder);
    CHECK(largest(read(folder / "again-on" / "indirect.exr")) < 1e-5f);
    const lab::Image again = read(folder / "again-off" / "indirect.exr"),
                     off = read(folder / "off" / "indirect.exr");
    for (size_t i = 0; i < off.data.size(); ++i) // the camera's angle has gone through a text
        CHECK(double(again.data[i]) == doctest::Approx(double(off.data[i])).epsilon(1e-4).scale(0.01));
}

} // namespace rebound::cli
