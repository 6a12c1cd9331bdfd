// SPDX-License-Identifier: MIT
#include "browser.hpp"

#include <cstdio>

// Without a browser nothing can be tested: 77 tells CTest to count the test as skipped.
int main(int count, char** arguments) {
    if (rebound::page::browserName().empty()) {
        std::printf(
            "skipped: neither chromium nor google-chrome is in PATH (Debian's package is chromium)\n");
        return 77;
    }
    return doctest::Context(count, arguments).run();
}
