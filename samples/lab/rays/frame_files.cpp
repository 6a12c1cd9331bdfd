// SPDX-License-Identifier: MIT
#include "lab/files/file_bytes.hpp"
#include "lab/files/input_error.hpp"
#include "lab/files/json_text.hpp"
#include "lab/images/image_files.hpp"
#include "lab/rays/frame.hpp"
#include "lab/scenes/camera_json.hpp"
#include "lab/scenes/scene_files.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <utility>

namespace rebound::lab {

namespace {

namespace fs = std::filesystem;

constexpr size_t largestMetaFile = size_t(1) << 24; // [bytes]

// Grey becomes three equal channels, and alpha is dropped.
Image toThreeChannels(const Image& image) {
    Image result(image.extent(), 3);
    const size_t channels = size_t(image.channels);
    for (size_t pixel = 0; pixel < result.data.size() / 3; ++pixel)
        for (size_t c = 0; c < 3; ++c)
            result.data[pixel * 3 + c] = image.data[pixel * channels + std::min(c, channels - 1)];
    return result;
}

Result<> readThree(const fs::path& file, ExrContent content, Frame& frame, Image& output) {
    auto image = readExr(file, {content, 0.0f, &frame.notes});
    if (!image) return image.error();
    output = image->channels == 3 ? *std::move(image) : toThreeChannels(*image);
    return {};
}

Result<> readDepth(const fs::path& file, Frame& frame) {
    auto image = readExr(file, {ExrContent::depth, 0.0f, &frame.notes});
    if (!image) return image.error();
    frame.depth = *std::move(image);
    return {};
}

// How a frame was taken.
struct Taken {
    CameraView camera;
    bool emissionIsDirectLight = true;
};

Result<Taken> readMeta(const fs::path& file) {
    const auto meta = guardInput(file, [&] {
        const std::vector<uint8_t> bytes = readFileBytes(file, largestMetaFile, file);
        auto root = parseJsonObject({reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                                    "a frame's description");
        if (!root.contains("camera")) refuse("\"camera\" is missing");
        if (root.contains("emissive_materials") && !root["emissive_materials"].is_boolean())
            refuse(std::string("\"emissive_materials\" is ").append(shown(root["emissive_materials"])) +
                   "; expected true or false");
        return root;
    });
    if (!meta) return meta.error();
    auto camera = cameraFromJson((*meta)["camera"], file.string() + ": camera");
    if (!camera) return camera.error();
    return Taken{*std::move(camera), meta->value("emissive_materials", true)};
}

Result<Taken> readTaken(const fs::path& folder, const fs::path& viewFile, const std::string& name) {
    if (!viewFile.empty()) {
        Scene onlyCameras;
        const auto view = readViewFile(viewFile);
        if (!view) return view.error();
        applyViewFile(*view, onlyCameras);
        if (onlyCameras.cameras.empty())
            return Error{ErrorCode::notFound, std::string("'").append(viewFile.string()) +
                                                  "': it has no cameras; expected the one of the frame"};
        auto camera = findCamera(onlyCameras, name);
        if (!camera) return camera.error();
        return Taken{*std::move(camera), onlyCameras.emissiveMaterialsLight};
    }
    auto taken = readMeta(folder / "meta.json");
    if (taken && !name.empty() && name != taken->camera.name)
        return Error{ErrorCode::notFound, "camera \"" + name + "\" is not the one of " +
                                              (folder / "meta.json").string() + ", \"" + taken->camera.name +
                                              "\""};
    return taken;
}

std::string percentOf(size_t count, size_t all) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g %%", 100.0 * double(count) / double(all));
    return text;
}

// Far behind all else, at one depth, is sky, or a wall that faces the camera.
void noteBackground(Frame& frame, const fs::path& file) {
    const std::vector<float>& depth = frame.depth.data;
    constexpr size_t share = 20; // a twentieth of the pixels
    constexpr float farBehind = 1.5f;
    float largest = 0.0f, next = 0.0f;
    for (const float d : depth) {
        if (d == 0.0f || !std::isfinite(d)) return; // who marks empty pixels marks the sky
        if (d > largest) next = std::exchange(largest, d);
        else if (d < largest) next = std::max(next, d);
    }
    const auto count = size_t(std::count(depth.begin(), depth.end(), largest));
    if (next > 0.0f && largest > farBehind * next && count > depth.size() / share)
        frame.notes.push_back(
            file.string() + ": " + percentOf(count, depth.size()) +
            " of the pixels hold the largest depth, " + std::to_string(largest) +
            " m, far behind all others, and none is 0; if they are sky, 0 was expected there");
}

// Other programs mark the sky by infinity, by a number that is too large, by the far plane, or by the largest half.
void understandSky(Frame& frame, const fs::path& file) {
    constexpr float farthest = 1e7f; // where Rebound's techniques end [m]
    constexpr float largestHalf = 65504.0f;
    constexpr float besideTheFarPlane = 1.0f - 1e-6f;
    std::vector<float>& depth = frame.depth.data;
    const bool hasFarPlane = frame.camera.farPlane != CameraView().farPlane; // stated, that is
    const float end = hasFarPlane ? std::min(farthest, frame.camera.farPlane * besideTheFarPlane) : farthest;
    const auto isSky = [&](float d) { return d >= end || d == largestHalf; };
    size_t sky = 0;
    for (float& d : depth)
        if (isSky(d)) {
            d = 0.0f;
            ++sky;
        }
    if (sky > 0)
        frame.notes.push_back(file.string() + ": " + std::to_string(sky) +
                              (sky == 1 ? " pixel (" : " pixels (") + percentOf(sky, depth.size()) +
                              ") with infinity, or a depth at or beyond the far plane, 1e7 m or the largest "
                              "half, taken for no surface");
    noteBackground(frame, file);
}

Result<Frame> readParts(const fs::path& folder, const fs::path& viewFile, const std::string& cameraName) {
    Frame frame;
    auto taken = readTaken(folder, viewFile, cameraName);
    if (!taken) return taken.error();
    frame.camera = std::move(taken->camera);
    frame.emissionIsDirectLight = taken->emissionIsDirectLight;
    if (auto read = readDepth(folder / "depth.exr", frame); !read) return read.error();
    if (auto read = readThree(folder / "normal.exr", ExrContent::normal, frame, frame.normal); !read)
        return read.error();
    if (auto read = readThree(folder / "albedo.exr", ExrContent::color, frame, frame.albedo); !read)
        return read.error();
    if (auto read = readThree(folder / "direct.exr", ExrContent::color, frame, frame.direct); !read)
        return read.error();
    std::error_code ignored;
    if (fs::exists(folder / "emission.exr", ignored))
        if (auto read = readThree(folder / "emission.exr", ExrContent::color, frame, frame.emission); !read)
            return read.error();
    understandSky(frame, folder / "depth.exr");
    if (auto valid = validate(frame); !valid)
        return Error{valid.error().code, folder.string() + ": " + valid.error().message};
    return frame;
}

} // namespace

Result<Frame> readFrame(const fs::path& folder, const fs::path& viewFile, const std::string& cameraName) {
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored))
        return Error{ErrorCode::notFound,
                     folder.string() + " is not a folder; expected one that holds a frame"};
    try {
        return readParts(folder, viewFile, cameraName);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "out of memory while reading the frame in " + folder.string()};
    }
}

} // namespace rebound::lab
