// SPDX-License-Identifier: MIT
#include "output_folder.hpp"

#include "lab/files/output_file.hpp"

#include <span>
#include <system_error>
#include <utility>

namespace rebound::cli {

namespace {

namespace fs = std::filesystem;

Error unusable(const fs::path& folder, const std::string& reason) {
    return {ErrorCode::inputOutput, "cannot write to the folder " + folder.string() + ": " + reason};
}

Error unwritable(const fs::path& file, const std::string& reason) {
    return {ErrorCode::inputOutput, "cannot write " + file.string() + ": " + reason};
}

// A folder that did not exist before, or the last system's error.
Result<fs::path> createScratchFolder(const fs::path& parent) {
    std::error_code failure;
    constexpr int attempts = 1000; // names that other runs may hold, or have left in a crash
    for (int i = 0; i < attempts; ++i) {
        const fs::path scratch = parent / (".rebound-" + std::to_string(i) + ".partial");
        if (fs::create_directory(scratch, failure)) return scratch;
        if (failure && failure != std::errc::file_exists) break;
    }
    return unusable(parent,
                    failure ? failure.message() : "too many unfinished runs have left their files there");
}

// Folders that this run created, gone again unless they are kept.
class CreatedFolders {
public:
    CreatedFolders() = default;
    CreatedFolders(const CreatedFolders&) = delete;
    CreatedFolders& operator=(const CreatedFolders&) = delete;
    ~CreatedFolders() {
        std::error_code ignored;
        for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) fs::remove(*folder, ignored);
    }

    Result<> create(const fs::path& folder) {
        std::error_code failure;
        if (fs::is_directory(folder, failure)) return {};
        if (const fs::path parent = folder.parent_path(); !parent.empty() && parent != folder)
            if (auto created = create(parent); !created) return created;
        // A path that ends in a separator or a dot names the folder that was just created.
        if (fs::is_directory(folder, failure)) return {};
        if (!fs::create_directory(folder, failure))
            return unusable(folder, failure ? failure.message() : "it is not a folder");
        folders.push_back(folder);
        return {};
    }

    void keep() { folders.clear(); }

private:
    std::vector<fs::path> folders;
};

// Holds the new files until they are complete, and the old ones until the new are in place.
class Scratch {
public:
    explicit Scratch(fs::path scratchFolder) : folder(std::move(scratchFolder)) {}
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() {
        std::error_code ignored;
        for (auto move = moves.rbegin(); move != moves.rend(); ++move)
            fs::rename(move->to, move->from, ignored);
        fs::remove_all(folder, ignored);
    }

    fs::path newFile(const std::string& name) const { return folder / name; }

    Result<> replace(const fs::path& target, const std::string& name) {
        std::error_code failure;
        if (fs::is_directory(target, failure)) return unwritable(target, "it is a folder");
        if (fs::exists(fs::symlink_status(target, failure)))
            if (auto moved = move(target, folder / ("old-" + name), target); !moved) return moved;
        return move(newFile(name), target, target);
    }

    // From here on the moves are not undone.
    void keep() { moves.clear(); }

private:
    struct Move {
        fs::path from;
        fs::path to;
    };

    Result<> move(const fs::path& from, const fs::path& to, const fs::path& target) {
        std::error_code failure;
        fs::rename(from, to, failure);
        if (failure) return unwritable(target, failure.message());
        moves.push_back({from, to});
        return {};
    }

    fs::path folder;
    std::vector<Move> moves;
};

} // namespace

OutputFile textFile(const std::string& name, std::string text) {
    return {name, [text = std::move(text)](const fs::path& path) {
                return lab::writeFile(path, std::as_bytes(std::span(text)));
            }};
}

Result<> checkOutputFolder(const fs::path& folder) {
    if (folder.empty()) return invalidArgument("--out is empty; a folder was expected");
    CreatedFolders created;
    if (auto exists = created.create(folder); !exists) return exists;
    const auto scratch = createScratchFolder(folder);
    if (!scratch) return scratch.error();
    std::error_code ignored;
    fs::remove(*scratch, ignored);
    return {};
}

Result<> writeOutputFolder(const fs::path& folder, const std::vector<OutputFile>& files) {
    CreatedFolders created;
    if (auto exists = created.create(folder); !exists) return exists;
    const auto scratchFolder = createScratchFolder(folder);
    if (!scratchFolder) return scratchFolder.error();
    Scratch scratch(*scratchFolder);
    for (const OutputFile& file : files)
        if (auto written = file.write(scratch.newFile(file.name)); !written) return written;
    for (const OutputFile& file : files)
        if (auto replaced = scratch.replace(folder / file.name, file.name); !replaced) return replaced;
    scratch.keep();
    created.keep();
    return {};
}

} // namespace rebound::cli
