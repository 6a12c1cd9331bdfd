// SPDX-License-Identifier: MIT
// A browser without a window, that loads a page from a file.
#pragma once

#include "../lab/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <sys/wait.h>

#include <cstdlib>
#include <sstream>
#include <string>

namespace rebound::page {

// Empty where there is none.
inline std::string browserName() {
    for (const char* name : {"chromium", "google-chrome", "chromium-browser"})
        if (std::system(("command -v " + std::string(name) + " > /dev/null").c_str()) == 0) return name;
    return {};
}

struct Visit {
    std::string document; // as the page's scripts have left it
    std::string console;  // a line for each message
};

// No network, and a profile of its own. Time within the page runs ahead, so that nothing waits.
inline Visit visit(const std::filesystem::path& page, const std::string& options) {
    const lab::TemporaryFolder profile;
    const std::string command =
        browserName() +
        " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --hide-scrollbars --no-first-run" +
        " --disable-background-networking --host-resolver-rules='MAP * ~NOTFOUND' --enable-logging=stderr" +
        " --virtual-time-budget=10000 --user-data-dir='" + (profile / "profile").string() + "' " + options +
        " 'file://" + page.string() + "' > '" + (profile / "document").string() + "' 2> '" +
        (profile / "messages").string() + "'";
    const int status = std::system(command.c_str());
    INFO(lab::readText(profile / "messages"));
    REQUIRE(WIFEXITED(status));
    REQUIRE(WEXITSTATUS(status) == 0);
    Visit result{lab::readText(profile / "document"), {}};
    std::istringstream messages(lab::readText(profile / "messages"));
    for (std::string line; std::getline(messages, line);)
        if (line.find("CONSOLE") != std::string::npos) result.console += line + "\n";
    return result;
}

} // namespace rebound::page
