// SPDX-License-Identifier: MIT
#include "../device_main.hpp"

#include "lab/host/opengl_context.hpp"

int main(int count, char** arguments) {
    using rebound::host::OpenGLContext;
    const std::string why =
        rebound::test::whyMissing(OpenGLContext::create(rebound::host::OpenGLApi::desktop));
    return rebound::test::runUnlessMissing(why, count, arguments);
}
