// SPDX-License-Identifier: MIT
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "host/opengl_context.hpp"

#include <cstdio>

// Without a context nothing can be tested: 77 tells CTest to count the test as skipped.
int main(int argc, char** argv) {
    const auto context = rebound::host::OpenGLContext::create(rebound::host::OpenGLApi::desktop);
    if (!context) {
        std::printf("skipped: %s\n", context.error().message.c_str());
        return 77;
    }
    rebound::host::OpenGLContext::makeNoneCurrent();
    return doctest::Context(argc, argv).run();
}
