// SPDX-License-Identifier: MIT
// An OpenGL context without a window, for tests and for pictures that go to files.
#pragma once

#include "rebound/result.hpp"

#include <memory>
#include <string>
#include <vector>

namespace rebound::host {

enum class OpenGLApi {
    desktop, // OpenGL 4.3 core or later
    es,      // OpenGL ES 3.1 or later
};

// Fails where a context's description does not hold that part: the system chooses the device, not the program.
Result<> requireDevice(const std::string& description, const std::string& part);

// One context, current on one thread at a time. It has debug output, which is collected. Which GPU it is on
// is the system's choice; LIBGL_ALWAYS_SOFTWARE=1 makes Mesa render on the CPU.
class OpenGLContext {
public:
    // Creates the context and makes it current. Fails where EGL has no display without a window, or no such
    // context.
    static Result<OpenGLContext> create(OpenGLApi);

    Result<> makeCurrent() const;
    static void makeNoneCurrent();

    // As rebound::opengl::Loader takes it.
    static void* functionNamed(const char* name);

    // "4.5 (Core Profile) Mesa 22.3.6, llvmpipe (LLVM 15.0.6, 256 bits)".
    std::string description() const;

    // What debug output has said since the last call, but for notifications: each one is a mistake of
    // somebody's.
    std::vector<std::string> takeMessages();

    OpenGLContext(OpenGLContext&&) noexcept;
    OpenGLContext& operator=(OpenGLContext&&) noexcept;
    ~OpenGLContext();

private:
    struct State;
    explicit OpenGLContext(std::unique_ptr<State>);
    std::unique_ptr<State> state;
};

} // namespace rebound::host
