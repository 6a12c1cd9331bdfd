// SPDX-License-Identifier: MIT
// The OpenGL backend: runs plans as compute shaders in the host's context, OpenGL 4.3 or OpenGL ES 3.1 and
// later.
#pragma once

#include "rebound/device.hpp"
#include "rebound/shaders.hpp"

#include <functional>
#include <memory>
#include <span>

namespace rebound::opengl {

// A buffer object of the host. An output buffer is nothing else of the frame as well.
struct Buffer {
    unsigned buffer = 0; // the host's name for it
    size_t offset = 0;   // of its first byte; a multiple of GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT [bytes]
    size_t size = 0;     // from there on; at least the plan's resource's [bytes]
    std::shared_ptr<void> shared; // of Device::createBuffer(): keeps the buffer object
};

// An image of the host: a GL_TEXTURE_2D, of which level 0 is used. Its size and format are asked of OpenGL.
// Inputs may have any format that samples as floats, depth formats included, or as unsigned integers where the plan says so;
// outputs have the one that the kernel declares (rgba16f for those of the techniques), and on ES immutable storage. No output may be
// another image of the frame as well.
struct Image {
    using Buffer = opengl::Buffer;

    unsigned texture = 0; // the host's name for it
};

// Finds a function of OpenGL by its name, as eglGetProcAddress and its like do; null where there is none.
using Loader = std::function<void*(const char*)>;

struct DeviceOptions {
    Loader loader;        // only called by create()
    bool timings = false; // whether record() measures its passes, where the context has timestamps
    // Shaders beside the techniques' own, of an engine that writes some; looked up first.
    std::vector<std::span<const Shader* const>> moreShaders;
};

class Program;

// Every call, and the end of every program, needs the host's context to be current, or one that shares its
// objects. Where that context tells of a GPU's reset, the first call that finds out fails with deviceLost, and
// all later ones do at once, with the same words, and issue nothing. Programs can still be destroyed.
class Device {
public:
    // Fails where no context is current, it is lost, it is older than OpenGL 4.3 or OpenGL ES 3.1, or the
    // loader lacks a function.
    static Result<Device> create(const DeviceOptions&);

    // Fails where the plan is not valid, names a kernel, slot, feature or format that does not exist, exceeds
    // a limit of the context, memory is short, the driver refuses a shader, or an error of a call before it
    // is pending; device and context stay as they were.
    Result<Program> compile(const Plan&) const;

    // What compile() would ask OpenGL for; drivers may pad it. Fails where the plan is not valid.
    Result<MemoryUse> memoryUse(const Plan&) const;

    // An input buffer that any number of programs are handed in each frame, with one upload of the data. It lives as long
    // as a copy of the handle, the last of which goes while the context is current. Fails as compile() does.
    Result<Buffer> createBuffer(std::span<const std::byte>) const;

    bool isEs() const;       // whether the context is one of OpenGL ES
    bool hasTimings() const; // whether timings were asked for, and the context has timestamps

    struct Shared;

private:
    std::shared_ptr<const Shared> shared;
};

// A compiled plan. Its end deletes its objects.
class Program {
public:
    // Issues the commands of one frame; does not wait for them. Whatever it binds is bound as before when it
    // returns. Fails, and runs nothing, where an image or constant of the plan is missing, unknown, or an
    // image is null, deleted, or of a size or format other than expected.
    Result<> record(const FrameInputs<Image>&);

    // The next frame is a first one: history and persistent buffers hold zeros, and FrameState says so.
    void reset();

    // Of the latest frame that the GPU has finished, a pass each in the plan's order; empty before that, and
    // where Device::hasTimings() is false; what they were before, once the context is lost. Never waits.
    Result<std::vector<PassTiming>> timings() const;

    const Plan& plan() const;
    MemoryUse memoryUse() const;

    // The texture of an image of the device's own, of history the one that the frame writes: for tests and for looking at
    // what a pass left. Transients with disjoint lifetimes share it: read it from within onPass().
    Result<unsigned> ownTexture(std::string_view name) const;
    // The same of a transient or persistent buffer.
    Result<Buffer> ownBuffer(std::string_view name) const;

    // Called after the commands of each pass of record() are issued, with the pass's index; empty: never.
    // What the pass wrote may be read then. The callback leaves bindings as it found them.
    void onPass(std::function<void(int)> callback);

    struct State;
    explicit Program(std::unique_ptr<State>);
    ~Program();
    Program(Program&&) noexcept;
    Program& operator=(Program&&) noexcept;

private:
    std::unique_ptr<State> state;
};

} // namespace rebound::opengl
