// SPDX-License-Identifier: MIT
// A folder of a test's own, gone when the test ends.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

namespace rebound::lab {

class TemporaryFolder {
public:
    TemporaryFolder() {
        std::random_device random;
        do folder = std::filesystem::temp_directory_path() / ("rebound-test-" + std::to_string(random()));
        while (!std::filesystem::create_directory(folder));
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return folder / name; }
    const std::filesystem::path& path() const { return folder; }

    // Files in it, hidden ones too.
    size_t count() const {
        return size_t(std::distance(std::filesystem::directory_iterator(folder),
                                    std::filesystem::directory_iterator()));
    }

private:
    std::filesystem::path folder;
};

inline std::string readText(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline void writeText(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

} // namespace rebound::lab
