// SPDX-License-Identifier: MIT
#include "lab/images/exr_header.hpp"

#include "rebound/extent.hpp"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfStdIO.h>
#include <ImfVersion.h>

#include <array>
#include <cstdint>
#include <string>

namespace rebound::lab {

namespace {

// At most this many bytes come out of one byte of zlib's deflate (1032) or of run-length coding (64).
constexpr int64_t largestDeflateRatio = 1032;

// Reads the file's first eight bytes. The fields are little endian.
Result<int> readVersion(Imf::IStream& stream) {
    std::array<char, 8> bytes{};
    stream.read(bytes.data(), int(bytes.size()));
    const auto field = [&](size_t first) {
        uint32_t value = 0;
        for (size_t i = 0; i < 4; ++i)
            value |= uint32_t(static_cast<unsigned char>(bytes[first + i])) << (8 * i);
        return int(value);
    };
    if (field(0) != Imf::MAGIC) return Error{ErrorCode::invalidData, "it is not an OpenEXR file"};
    return field(4);
}

int64_t sampleSize(const Imf::ChannelList& channels) {
    int64_t size = 0;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
        size += channel.channel().type == Imf::HALF ? 2 : 4;
    return size;
}

Result<> checkSize(const Imath::Box2i& window) {
    const int64_t width = int64_t(window.max.x) - window.min.x + 1;
    const int64_t height = int64_t(window.max.y) - window.min.y + 1;
    if (width >= 1 && height >= 1 && width <= maximumExtent && height <= maximumExtent) return {};
    return Error{ErrorCode::invalidData, "its image is " + std::to_string(width) + " x " +
                                             std::to_string(height) + " pixels; expected 1 to " +
                                             std::to_string(maximumExtent) + " a side"};
}

bool overlap(const Imath::Box2i& a, const Imath::Box2i& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

bool deflates(Imf::Compression compression) {
    return compression == Imf::NO_COMPRESSION || compression == Imf::RLE_COMPRESSION ||
           compression == Imf::ZIPS_COMPRESSION || compression == Imf::ZIP_COMPRESSION;
}

} // namespace

Result<> checkExrHeader(const std::filesystem::path& path) {
    Imf::StdIFStream stream(path.c_str());
    auto version = readVersion(stream);
    if (!version) return version.error();
    if (Imf::isNonImage(*version))
        return Error{ErrorCode::invalidData, "it holds deep data; expected a flat image"};
    if (Imf::isMultiPart(*version))
        return Error{ErrorCode::invalidData, "it holds several parts; expected one image"};
    Imf::Header header;
    int flags = *version;
    header.readFrom(stream, flags);
    const Imath::Box2i window = header.dataWindow();
    for (const Imath::Box2i& box : {window, header.displayWindow()})
        if (auto checked = checkSize(box); !checked) return checked;
    if (!overlap(window, header.displayWindow()))
        return Error{ErrorCode::invalidData, "its data window lies outside its display window"};
    const int64_t width = int64_t(window.max.x) - window.min.x + 1;
    const int64_t height = int64_t(window.max.y) - window.min.y + 1;
    const auto bytes = int64_t(std::filesystem::file_size(path));
    if (deflates(header.compression()) &&
        width * height * sampleSize(header.channels()) / largestDeflateRatio > bytes)
        return Error{ErrorCode::invalidData, "its " + std::to_string(bytes) + " bytes cannot hold the " +
                                                 std::to_string(width) + " x " + std::to_string(height) +
                                                 " pixels that its header claims"};
    return {};
}

} // namespace rebound::lab
