// SPDX-License-Identifier: MIT
#include "lab/files/output_file.hpp"
#include "lab/images/image_files.hpp"

#include <png.h>

#include <new>

namespace rebound::lab {

namespace {

Result<std::vector<std::byte>> encodePng(const Picture& picture) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = png_uint_32(picture.width);
    image.height = png_uint_32(picture.height);
    image.format = PNG_FORMAT_RGB;
    // Rows, filter bytes and zlib's worst case; libpng says how much of it it used.
    const size_t raw = (size_t(picture.width) * 3 + 1) * size_t(picture.height);
    constexpr size_t headersAndChunks = 4096;
    std::vector<std::byte> bytes(raw + raw / 64 + headersAndChunks);
    png_alloc_size_t size = bytes.size();
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr) == 0)
        return Error{ErrorCode::inputOutput, "it cannot be encoded"};
    bytes.resize(size);
    return bytes;
}

} // namespace

Result<> writePng(const std::filesystem::path& path, const Picture& picture) {
    const bool inRange = picture.width >= 1 && picture.height >= 1 && picture.width <= maximumExtent * 4 &&
                         picture.height <= maximumExtent * 4;
    if (!inRange || picture.rgb.size() != size_t(picture.width) * size_t(picture.height) * 3)
        return invalidArgument("cannot write " + path.string() + ": the picture is " +
                               std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                               " with " + std::to_string(picture.rgb.size()) +
                               " bytes; expected at least 1 x 1 and three bytes a pixel");
    try {
        auto bytes = encodePng(picture);
        if (!bytes)
            return Error{bytes.error().code, "cannot write " + path.string() + ": " + bytes.error().message};
        return writeFile(path, *bytes);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "cannot write " + path.string() + ": out of memory"};
    }
}

} // namespace rebound::lab
