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
#include <new>

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

Result<> readColor(const fs::path& file, Image& output) {
    auto image = readExr(file);
    if (!image) return image.error();
    output = image->channels == 3 ? *std::move(image) : toThreeChannels(*image);
    return {};
}

Result<> readDepth(const fs::path& file, Image& output) {
    auto image = readExr(file);
    if (!image) return image.error();
    if (image->channels != 1)
        return Error{ErrorCode::invalidData, file.string() + " has " + std::to_string(image->channels) +
                                                 " channels; expected depth in one channel, Y"};
    output = *std::move(image);
    return {};
}

Result<CameraView> readMetaCamera(const fs::path& file) {
    const auto meta = guardInput(file, [&] {
        const std::vector<uint8_t> bytes = readFileBytes(file, largestMetaFile, file);
        auto root = parseJsonObject({reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                                    "a frame's description");
        if (!root.contains("camera")) refuse("\"camera\" is missing");
        return root;
    });
    if (!meta) return meta.error();
    return cameraFromJson((*meta)["camera"], file.string() + ": camera");
}

Result<CameraView> readCamera(const fs::path& folder, const fs::path& viewFile, const std::string& name) {
    if (!viewFile.empty()) {
        Scene onlyCameras;
        if (auto applied = applyViewFile(viewFile, onlyCameras); !applied) return applied.error();
        return findCamera(onlyCameras, name);
    }
    auto camera = readMetaCamera(folder / "meta.json");
    if (camera && !name.empty() && name != camera->name)
        return Error{ErrorCode::notFound, "camera \"" + name + "\" is not the one of " +
                                              (folder / "meta.json").string() + ", \"" + camera->name + "\""};
    return camera;
}

Result<Frame> readParts(const fs::path& folder, const fs::path& viewFile, const std::string& cameraName) {
    Frame frame;
    auto camera = readCamera(folder, viewFile, cameraName);
    if (!camera) return camera.error();
    frame.camera = *camera;
    if (auto read = readDepth(folder / "depth.exr", frame.depth); !read) return read.error();
    if (auto read = readColor(folder / "normal.exr", frame.normal); !read) return read.error();
    if (auto read = readColor(folder / "albedo.exr", frame.albedo); !read) return read.error();
    if (auto read = readColor(folder / "direct.exr", frame.direct); !read) return read.error();
    std::error_code ignored;
    if (fs::exists(folder / "emission.exr", ignored))
        if (auto read = readColor(folder / "emission.exr", frame.emission); !read) return read.error();
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
