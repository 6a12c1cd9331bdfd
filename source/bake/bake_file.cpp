// SPDX-License-Identifier: MIT
// A file is a header, then the sections in their order, each from a multiple of 64 bytes on.
//
//   bytes 0 to 7     "RBNDBAKE"
//   bytes 8 to 23    XXH3, 128 bits, of everything that follows (low half first)
//   from byte 24 on  struct FileHeader
#include "rebound/bake/bake_file.hpp"

#include "file_mapping.hpp"
#include "file_writer.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <vector>

namespace rebound {

namespace {

namespace fs = std::filesystem;

constexpr char magic[8] = {'R', 'B', 'N', 'D', 'B', 'A', 'K', 'E'};
constexpr size_t checksumStart = sizeof magic, checksumEnd = checksumStart + 16;
constexpr uint32_t fileVersion = 2; // counts changes of BakeLayout, of sections and of this header
constexpr uint64_t sectionAlignment = 64;

struct FileHeader {
    uint32_t version;
    uint32_t reserved;
    uint64_t fileSize;
    uint64_t offset[bakeSectionCount]; // of sections [bytes from the file's start]
    BakeLayout layout;
};
// Written as it lies in memory: whole words without gaps.
static_assert(sizeof(BakeLayout) == 4 * size_t{3 + 4 * maximumBakeStages + 24} &&
                  std::is_trivially_copyable_v<BakeLayout>,
              "a new layout needs a new fileVersion, and this sum changed");
static_assert(offsetof(FileHeader, layout) == 16 + 8 * bakeSectionCount);
constexpr size_t headerSize = offsetof(FileHeader, layout) + sizeof(BakeLayout);

uint64_t aligned(uint64_t offset) {
    return (offset + sectionAlignment - 1) / sectionAlignment * sectionAlignment;
}

FileHeader headerOf(const BakeLayout& layout) {
    FileHeader header{};
    header.version = fileVersion;
    header.layout = layout;
    uint64_t end = checksumEnd + headerSize;
    for (int i = 0; i < bakeSectionCount; ++i) {
        header.offset[i] = aligned(end);
        end = header.offset[i] + 4 * uint64_t(sizeOf(layout, BakeSection(i)));
    }
    header.fileSize = end;
    return header;
}

using Bytes = std::span<const std::byte>;

// What follows the checksum, in pieces that need no copy of sections.
std::vector<Bytes> piecesOf(const Bake& bake, const FileHeader& header) {
    static constexpr std::byte zeros[sectionAlignment] = {};
    std::vector<Bytes> pieces{Bytes(reinterpret_cast<const std::byte*>(&header), headerSize)};
    uint64_t end = checksumEnd + headerSize;
    for (int i = 0; i < bakeSectionCount; ++i) {
        pieces.push_back(Bytes(zeros, size_t(header.offset[i] - end)));
        pieces.push_back(std::as_bytes(bake.section(BakeSection(i))));
        end = header.offset[i] + pieces.back().size();
    }
    return pieces;
}

void putLittleEndian(std::byte* to, uint64_t value) {
    for (int i = 0; i < 8; ++i) to[i] = std::byte(value >> (8 * i));
}

std::array<std::byte, 16> bytesOf(XXH128_hash_t hash) {
    std::array<std::byte, 16> bytes;
    putLittleEndian(bytes.data(), hash.low64);
    putLittleEndian(bytes.data() + 8, hash.high64);
    return bytes;
}

Error notABake(const fs::path& path, const std::string& why) {
    return {ErrorCode::invalidData, path.string() + " " + why};
}

Result<> checkByteOrder() {
    if constexpr (std::endian::native != std::endian::little)
        return Error{ErrorCode::unsupported, "bakes are little-endian; this processor is not"};
    return {};
}

// Everything but what the checksum says of it.
Result<FileHeader> readHeader(Bytes file, const fs::path& path) {
    if (file.size() < sizeof magic || std::memcmp(file.data(), magic, sizeof magic) != 0)
        return notABake(path, "is no bake; a file written by rebound bake was expected");
    if (file.size() < checksumEnd + headerSize)
        return notABake(path, "is cut short: " + std::to_string(file.size()) +
                                  " bytes are less than a bake's header");
    FileHeader header;
    std::memcpy(static_cast<void*>(&header), file.data() + checksumEnd, headerSize);
    if (header.version != fileVersion)
        return notABake(path, "is a bake of version " + std::to_string(header.version) + "; version " +
                                  std::to_string(fileVersion) + " was expected: bake it again");
    if (header.fileSize != file.size())
        return notABake(path, "is " + std::to_string(file.size()) + " bytes long; " +
                                  std::to_string(header.fileSize) +
                                  " were expected: it is cut short or altered");
    return header;
}

Result<> checkSum(Bytes file, const fs::path& path) {
    const auto sum = bytesOf(XXH3_128bits(file.data() + checksumEnd, file.size() - checksumEnd));
    if (std::memcmp(sum.data(), file.data() + checksumStart, sum.size()) == 0) return {};
    return notABake(path, "was altered after it was written: its checksum does not fit");
}

} // namespace

Result<> writeBake(const Bake& bake, const fs::path& path) {
    if (auto order = checkByteOrder(); !order) return order;
    if (auto valid = validate(bake); !valid) return valid;
    const FileHeader header = headerOf(bake.layout);
    std::vector<Bytes> pieces = piecesOf(bake, header);
    XXH3_state_t state;
    XXH3_128bits_reset(&state);
    for (const Bytes& piece : pieces) XXH3_128bits_update(&state, piece.data(), piece.size());
    const auto sum = bytesOf(XXH3_128bits_digest(&state));
    pieces.insert(pieces.begin(), {std::as_bytes(std::span(magic)), std::span(sum)});
    return detail::writeFile(path, pieces);
}

Result<Bake> readBake(const fs::path& path) {
    if (auto order = checkByteOrder(); !order) return order.error();
    auto mapping = detail::mapFile(path);
    if (!mapping) return mapping.error();
    const Bytes file = mapping->bytes;
    auto header = readHeader(file, path);
    if (!header) return header.error();
    if (auto sum = checkSum(file, path); !sum) return sum.error();

    Bake bake;
    bake.layout = header->layout;
    bake.storage = mapping->storage;
    // A layout that is out of range has any sizes; those that do not fit this file are never looked at.
    const FileHeader expected = headerOf(bake.layout);
    if (std::memcmp(&expected, &*header, headerSize) != 0)
        return notABake(path, "says sizes of sections that contradict each other");
    for (int i = 0; i < bakeSectionCount; ++i)
        bake.sections[size_t(i)] = {reinterpret_cast<const uint32_t*>(file.data() + header->offset[i]),
                                    sizeOf(bake.layout, BakeSection(i))};
    if (auto valid = validate(bake); !valid)
        return notABake(path, "cannot be used: " + valid.error().message);
    return bake;
}

} // namespace rebound
