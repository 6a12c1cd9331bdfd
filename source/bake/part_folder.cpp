// SPDX-License-Identifier: MIT
// A file is named <key>-<task>-<part>.part and holds
//
//   bytes 0 to 7    "RBNDPART"
//   bytes 8 to 23   XXH3, 128 bits, of everything that follows (low half first)
//   bytes 24 to 39  the key that its name has
//   bytes 40 to 47  number of the part and of the 32-bit numbers that follow
//   from byte 48 on these numbers
//
// all of it as words of this machine: parts are read by the machines that made them, and no others.
#include "rebound/bake/part_folder.hpp"

#include "content_key.hpp"
#include "file_mapping.hpp"
#include "file_writer.hpp"

#include "rebound/bake/bake_crew.hpp"

#include <array>
#include <cstring>
#include <system_error>

namespace rebound {

namespace {

namespace fs = std::filesystem;
using Words = std::array<uint32_t, 4>;
using Bytes = std::span<const std::byte>;

constexpr char magic[8] = {'R', 'B', 'N', 'D', 'P', 'A', 'R', 'T'};
constexpr std::string_view extension = ".part", temporaryExtension = ".partial";
constexpr size_t keyDigits = 32;

struct PartHeader {
    Words key;
    uint32_t part;
    uint32_t numbers;
};
constexpr size_t sumStart = sizeof magic, headerStart = sumStart + sizeof(Words),
                 numbersStart = headerStart + sizeof(PartHeader);
static_assert(numbersStart == 48);

Words sumOf(Bytes header, Bytes numbers) {
    detail::ContentKey sum;
    sum.addAll(header);
    sum.addAll(numbers);
    return sum.words();
}

Words keyOf(const BakeTask& task, const std::string& identity) {
    detail::ContentKey key;
    key.add(uint64_t(identity.size()));
    key.addAll(std::span<const char>(identity));
    key.addAll(std::span<const char>(task.name));
    key.add(task.key);
    return key.words();
}

std::string digitsOf(const Words& words) {
    std::string digits;
    for (const uint32_t word : words)
        for (int shift = 28; shift >= 0; shift -= 4) digits += "0123456789abcdef"[word >> shift & 15u];
    return digits;
}

// Why a file is not that part; empty: it is.
std::string faultOf(Bytes file, const PartHeader& expected) {
    if (file.size() < numbersStart || std::memcmp(file.data(), magic, sizeof magic) != 0)
        return "is no part of a bake, or is cut short";
    PartHeader header;
    std::memcpy(&header, file.data() + headerStart, sizeof header);
    if (header.key != expected.key || header.part != expected.part) return "is a part of something else";
    if (file.size() != numbersStart + 4 * uint64_t(header.numbers)) return "is cut short or has grown";
    const Words sum = sumOf(file.subspan(headerStart, sizeof(PartHeader)), file.subspan(numbersStart));
    if (std::memcmp(&sum, file.data() + sumStart, sizeof sum) != 0)
        return "was altered: its checksum does not fit";
    return {};
}

bool isOurs(const std::string& name) {
    if (name.starts_with(".rebound-") && name.ends_with(temporaryExtension)) return true;
    return name.size() > keyDigits && name.ends_with(extension) && name[keyDigits] == '-' &&
           name.find_first_not_of("0123456789abcdef") == keyDigits;
}

} // namespace

BakePartFolder::BakePartFolder(fs::path path, std::string name, std::function<void(const std::string&)> tell)
    : folder(std::move(path)), identity(std::move(name)), note(std::move(tell)) {}

fs::path BakePartFolder::fileOf(const BakeTask& task, uint32_t part) const {
    return folder / (digitsOf(keyOf(task, identity)) + '-' + std::string(task.name) + '-' +
                     std::to_string(part) + std::string(extension));
}

std::optional<std::vector<uint32_t>> BakePartFolder::read(const BakeTask& task, uint32_t part) {
    const fs::path file = fileOf(task, part);
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return std::nullopt;
    const auto mapping = detail::mapFile(file);
    const std::string fault =
        mapping ? faultOf(mapping->bytes, {keyOf(task, identity), part, 0}) : "cannot be read";
    if (!fault.empty()) {
        if (note) note(file.string() + " " + fault + "; what it held is baked again");
        return std::nullopt;
    }
    const Bytes bytes = mapping->bytes.subspan(numbersStart);
    std::vector<uint32_t> numbers(bytes.size() / 4);
    if (!bytes.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
    ++readSoFar;
    return numbers;
}

Result<> BakePartFolder::write(const BakeTask& task, uint32_t part, std::span<const uint32_t> numbers) const {
    std::error_code failure;
    fs::create_directory(folder, failure); // not what it is to be in, which a bake would not make either
    if (failure)
        return Error{ErrorCode::inputOutput,
                     "cannot make the folder " + folder.string() + ": " + failure.message()};
    const PartHeader header{keyOf(task, identity), part, uint32_t(numbers.size())};
    const Bytes headerBytes = std::as_bytes(std::span(&header, 1)), numberBytes = std::as_bytes(numbers);
    const Words sum = sumOf(headerBytes, numberBytes);
    const std::array<Bytes, 4> pieces{std::as_bytes(std::span(magic)), std::as_bytes(std::span(sum)),
                                      headerBytes, numberBytes};
    auto written = detail::writeFile(fileOf(task, part), pieces);
    if (!written) fs::remove(folder, failure); // where nothing else is in it
    return written;
}

void BakePartFolder::remove() const {
    std::error_code failure;
    std::vector<fs::path> files;
    for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
         entry.increment(failure))
        if (isOurs(entry->path().filename().string())) files.push_back(entry->path());
    for (const fs::path& file : files) fs::remove(file, failure);
    fs::remove(folder, failure); // fails where something else is in it, which stays
}

} // namespace rebound
