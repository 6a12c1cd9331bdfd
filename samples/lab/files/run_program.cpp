// SPDX-License-Identifier: MIT
#include "lab/files/run_program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace rebound::lab {

namespace {

namespace fs = std::filesystem;

Error failed(const std::string& why) { return {ErrorCode::unsupported, why}; }

// Two ends, closed at the end.
class Pipe {
public:
    Pipe() { isOpen = pipe2(ends.data(), O_CLOEXEC) == 0; }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        closeWriting();
        if (isOpen) close(ends[0]);
    }

    explicit operator bool() const { return isOpen; }
    int writing() const { return ends[1]; }
    void closeWriting() {
        if (isOpen && ends[1] >= 0) close(ends[1]);
        ends[1] = -1;
    }
    std::string readAll() const {
        std::string text;
        std::array<char, 4096> buffer{};
        for (;;) {
            const ssize_t count = read(ends[0], buffer.data(), buffer.size());
            if (count > 0) text.append(buffer.data(), size_t(count));
            else if (count == 0 || errno != EINTR) return text;
        }
    }

private:
    std::array<int, 2> ends{-1, -1};
    bool isOpen = false;
};

std::string lastLine(const std::string& text, const std::string& marks) {
    std::istringstream lines(text);
    std::string last;
    for (std::string line; std::getline(lines, line);)
        if (line.find_first_not_of(marks) != std::string::npos)
            last = line.substr(line.find_first_not_of(" \t"));
    return last;
}

} // namespace

std::optional<fs::path> findProgram(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path program = fs::path(folder) / name;
        if (!folder.empty() && access(program.c_str(), X_OK) == 0) return program;
    }
    return std::nullopt;
}

Result<> runProgram(const fs::path& program, const std::vector<std::string>& given,
                    const std::string& marks) {
    Pipe complaints;
    if (!complaints) return failed(std::strerror(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, complaints.writing(), STDERR_FILENO);
    std::vector<std::string> words = {program.string()};
    words.insert(words.end(), given.begin(), given.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t process = 0;
    const int failure = posix_spawn(&process, program.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) return failed(std::strerror(failure));
    complaints.closeWriting();
    const std::string said = complaints.readAll();
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    const std::string last = lastLine(said, marks);
    return failed(last.empty() ? "it ended without a word" : last);
}

} // namespace rebound::lab
