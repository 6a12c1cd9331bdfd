// SPDX-License-Identifier: MIT
// Links Rebound's OpenGL backend and nothing of OpenGL. There is no context, and the device says so.
#include <rebound/opengl/device.hpp>

#include <cstdio>

int main() {
    rebound::opengl::DeviceOptions options;
    options.loader = [](const char*) -> void* { return nullptr; };
    const auto device = rebound::opengl::Device::create(options);
    if (device || device.error().message.find("glGetString") == std::string::npos) {
        std::fprintf(stderr, "consumer_opengl: a device without OpenGL was expected to be refused\n");
        return 1;
    }
    return 0;
}
