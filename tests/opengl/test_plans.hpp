// SPDX-License-Identifier: MIT
// Small plans, and loaders that count, lie and leave out.
#pragma once

#include "opengl_runner.hpp"

#include <array>
#include <set>
#include <string_view>

namespace rebound::test {

// host -> copy -> source -> access -> result; its frame constants are "grid".
inline Plan copyPlan(Extent2D extent) {
    const Format format = Format::rgba32f;
    const AccessConstants k{{extent.width, extent.height, 0, 0}, {2, 1, 0, 0}};
    Plan plan{"test", {}, {}};
    plan.add({"host", ResourceKind::input, format, 4, extent, {}, 0});
    plan.add({"source", ResourceKind::transient, format, 4, extent, {}, 0});
    plan.add({"result", ResourceKind::output, format, 4, extent, {}, 0});
    plan.add({"grid", ResourceKind::frameConstants, {}, 1, {}, {}, sizeof(GridConstants)});
    plan.add(bufferResource("constants", std::vector{k}));
    plan.passes.push_back({"copy", "copy", {}, {{0, 0}, {1, 1, Access::write}, {2, 3}}, extent});
    plan.passes.push_back(
        {"access", "access", {accessOffset}, {{0, 1}, {1, 0}, {2, 2, Access::write}, {3, 4}}, extent});
    return plan;
}

// a and b have disjoint lifetimes, but not c and d; e has another size, f another format.
inline Plan sharingPlan() {
    const Extent2D extent{16, 8};
    Plan plan{"test", {}, {}};
    plan.add({"host", ResourceKind::input, {}, 4, extent, {}, 0});
    plan.add(bufferResource("constants", std::vector<AccessConstants>{{{16, 8, 0, 0}, {}}}));
    plan.add({"result", ResourceKind::output, {}, 4, extent, {}, 0});
    for (const char* name : {"a", "b", "c", "d"})
        plan.add({name, ResourceKind::transient, Format::rgba32f, 4, extent, {}, 0});
    const auto copyTo = [&](int image) {
        plan.passes.push_back({"copy to " + plan.resources[size_t(image)].name,
                               "copy",
                               {},
                               {{0, 0}, {1, image, Access::write}, {2, 1}},
                               extent});
    };
    const auto readFrom = [&](int image) {
        plan.passes.push_back({"read " + plan.resources[size_t(image)].name,
                               "access",
                               {accessFetch},
                               {{0, image}, {1, 0}, {2, 2, Access::write}, {3, 1}},
                               extent});
    };
    copyTo(3);
    readFrom(3);
    copyTo(4);
    readFrom(4);
    copyTo(5);
    copyTo(6);
    readFrom(5);
    readFrom(6);
    return plan;
}

struct CopyFrame {
    host::OpenGLTexture host, result;
    GridConstants constants;

    explicit CopyFrame(Extent2D extent)
        : host(textureOf(numbered(extent))),
          result(Format::rgba32f, lab::Image(extent, 4, -1.0f)), constants{
                                                                     {extent.width, extent.height, 0, 0}} {}
    FrameInputs<opengl::Image> inputs() const {
        return {{{"host", {host.name()}}, {"result", {result.name()}}}, {{"grid", bytesOf(constants)}}};
    }
    Picture read() const { return readBack(result.name(), result.extent(), 4); }
    // Every texel is the host's two to the right and one below.
    bool isRight() const {
        const Picture want = numbered(host.extent()), got = read();
        for (int y = 0; y < got.extent.height; ++y)
            for (int x = 0; x < got.extent.width; ++x)
                for (int c = 0; c < 4; ++c)
                    if (got.at(x, y, c) != want.reach(x + 2, y + 1, c)) return false;
        return true;
    }
    bool isUntouched() const { return read().values == Picture(result.extent(), 4, -1.0f).values; }
};

// Functions that stand in for OpenGL's where a loader is made to hand them out.
struct FakeOpenGL {
    // Objects that were made through the loader and not yet deleted, and the bytes that were asked for.
    static inline std::set<std::pair<char, GLuint>> live;
    static inline size_t textureBytes = 0, bufferBytes = 0;
    static inline std::map<GLenum, GLint> integers; // what glGetIntegerv says instead
    static inline const char* version = nullptr;    // what glGetString says of the version
    static inline bool memoryIsShort = false;       // glTexStorage2D fails
    static inline bool resultsAreLate = false;      // queries are not available yet
    static inline int resultsRead = 0;              // of queries, whether available or not
    static inline GLenum error = GL_NO_ERROR;
    static inline std::set<std::string> missing; // functions that the loader does not find
    // In order: glMemoryBarrier's bits, and dispatches.
    struct Command {
        GLbitfield barrier = 0;
        std::array<GLuint, 3> groups{};
        friend bool operator==(const Command&, const Command&) = default;
    };
    static inline std::vector<Command> commands;

    static void reset() {
        live.clear();
        textureBytes = bufferBytes = 0;
        integers.clear();
        version = nullptr;
        memoryIsShort = resultsAreLate = false;
        resultsRead = 0;
        error = GL_NO_ERROR;
        missing.clear();
        commands.clear();
    }

    template <char kind, auto generate>
    static void APIENTRY make(GLsizei count, GLuint* names) {
        generate(count, names);
        for (GLsizei i = 0; i < count; ++i) live.insert({kind, names[i]});
    }
    template <char kind, auto remove>
    static void APIENTRY unmake(GLsizei count, const GLuint* names) {
        for (GLsizei i = 0; i < count; ++i) live.erase({kind, names[i]});
        remove(count, names);
    }
    static GLuint APIENTRY createProgram() {
        const GLuint name = glCreateProgram();
        live.insert({'p', name});
        return name;
    }
    static void APIENTRY deleteProgram(GLuint name) {
        live.erase({'p', name});
        glDeleteProgram(name);
    }
    static GLuint APIENTRY createShader(GLenum type) {
        const GLuint name = glCreateShader(type);
        live.insert({'h', name});
        return name;
    }
    static void APIENTRY deleteShader(GLuint name) {
        live.erase({'h', name});
        glDeleteShader(name);
    }
    static void APIENTRY texStorage2D(GLenum target, GLsizei levels, GLenum format, GLsizei width,
                                      GLsizei height) {
        if (memoryIsShort) {
            error = GL_OUT_OF_MEMORY;
            return;
        }
        const size_t texel = format == GL_R32F ? 4 : format == GL_RGBA16F ? 8 : 16;
        textureBytes += texel * size_t(width) * size_t(height);
        glTexStorage2D(target, levels, format, width, height);
    }
    static void APIENTRY bufferData(GLenum target, GLsizeiptr size, const void* data, GLenum usage) {
        bufferBytes += size_t(size);
        glBufferData(target, size, data, usage);
    }
    static void APIENTRY getQueryObjectuiv(GLuint query, GLenum name, GLuint* value) {
        glGetQueryObjectuiv(query, name, value);
        if (resultsAreLate) *value = 0;
    }
    static inline PFNGLGETQUERYOBJECTUI64VPROC realResult = nullptr;
    static void APIENTRY getQueryObjectui64v(GLuint query, GLenum name, GLuint64* value) {
        ++resultsRead;
        realResult(query, name, value);
    }
    static void APIENTRY memoryBarrier(GLbitfield bits) {
        commands.push_back({bits, {}});
        glMemoryBarrier(bits);
    }
    static void APIENTRY dispatchCompute(GLuint x, GLuint y, GLuint z) {
        commands.push_back({0, {x, y, z}});
        glDispatchCompute(x, y, z);
    }
    static GLenum APIENTRY getError() {
        const GLenum real = glGetError();
        return std::exchange(error, GLenum(GL_NO_ERROR)) | real;
    }
    static void APIENTRY getIntegerv(GLenum name, GLint* value) {
        if (const auto said = integers.find(name); said != integers.end()) *value = said->second;
        else glGetIntegerv(name, value);
    }
    static const GLubyte* APIENTRY getString(GLenum name) {
        return version && name == GL_VERSION ? reinterpret_cast<const GLubyte*>(version) : glGetString(name);
    }

    static void* functionNamed(const char* name) {
        const auto pointer = [](auto function) { return reinterpret_cast<void*>(function); };
        static const std::map<std::string_view, void*> fakes = {
            {"glGenTextures", pointer(make<'t', glGenTextures>)},
            {"glDeleteTextures", pointer(unmake<'t', glDeleteTextures>)},
            {"glGenBuffers", pointer(make<'b', glGenBuffers>)},
            {"glDeleteBuffers", pointer(unmake<'b', glDeleteBuffers>)},
            {"glGenSamplers", pointer(make<'s', glGenSamplers>)},
            {"glDeleteSamplers", pointer(unmake<'s', glDeleteSamplers>)},
            {"glGenQueries", pointer(make<'q', glGenQueries>)},
            {"glDeleteQueries", pointer(unmake<'q', glDeleteQueries>)},
            {"glCreateProgram", pointer(createProgram)},
            {"glDeleteProgram", pointer(deleteProgram)},
            {"glCreateShader", pointer(createShader)},
            {"glDeleteShader", pointer(deleteShader)},
            {"glTexStorage2D", pointer(texStorage2D)},
            {"glBufferData", pointer(bufferData)},
            {"glGetQueryObjectuiv", pointer(getQueryObjectuiv)},
            {"glGetQueryObjectui64v", pointer(getQueryObjectui64v)},
            {"glGetQueryObjectui64vEXT", pointer(getQueryObjectui64v)},
            {"glMemoryBarrier", pointer(memoryBarrier)},
            {"glDispatchCompute", pointer(dispatchCompute)},
            {"glGetError", pointer(getError)},
            {"glGetIntegerv", pointer(getIntegerv)},
            {"glGetString", pointer(getString)},
        };
        if (missing.contains(name)) return nullptr;
        if (std::string_view(name).starts_with("glGetQueryObjectui64v"))
            realResult =
                reinterpret_cast<PFNGLGETQUERYOBJECTUI64VPROC>(host::OpenGLContext::functionNamed(name));
        const auto fake = fakes.find(name);
        return fake != fakes.end() ? fake->second : host::OpenGLContext::functionNamed(name);
    }
};

inline opengl::DeviceOptions optionsWithFakes() {
    FakeOpenGL::reset();
    opengl::DeviceOptions options = optionsWithTestShaders();
    options.loader = FakeOpenGL::functionNamed;
    return options;
}

} // namespace rebound::test
