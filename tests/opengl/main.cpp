// SPDX-License-Identifier: MIT
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "host/opengl_context.hpp"

#include <cstdio>

int main(int count, char** arguments) {
    using rebound::host::OpenGLApi;
    using rebound::host::OpenGLContext;
    const auto desktop = OpenGLContext::create(OpenGLApi::desktop);
    const auto es = OpenGLContext::create(OpenGLApi::es);
    if (!desktop && !es) {
        std::printf("skipped: EGL gives no OpenGL context: %s\n", desktop.error().message.c_str());
        return 77;
    }
    return doctest::Context(count, arguments).run();
}
