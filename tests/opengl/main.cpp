// SPDX-License-Identifier: MIT
#include "../device_main.hpp"

#include "lab/host/opengl_context.hpp"

int main(int count, char** arguments) {
    using rebound::host::OpenGLApi;
    using rebound::host::OpenGLContext;
    std::string why = rebound::test::whyMissing(OpenGLContext::create(OpenGLApi::desktop));
    if (!why.empty() && OpenGLContext::create(OpenGLApi::es)) why.clear(); // one of the two is enough
    return rebound::test::runUnlessMissing(why, count, arguments);
}
