// SPDX-License-Identifier: MIT
// OpenGL whose context is lost at a call of the test's choice.
#pragma once

#include "opengl_runner.hpp"

#include "../../backends/opengl/gl.hpp" // for the functions that the backend asks for

namespace rebound::test {

// Behaves from then on as KHR_robustness says: commands do nothing, and answer with zero or not at all; but
// errors, and the reset status, say what has happened, and a query is available, lest somebody waits. Objects
// are still deleted, so that the real context keeps none.
struct LossyOpenGL {
    static inline int calls = 0;
    static inline int lossAt = -1; // the number of the call at which the context is lost; -1: never
    static inline bool isLost = false;
    static inline GLenum reset = GL_GUILTY_CONTEXT_RESET; // what is told of it, once: then it is over
    static inline std::set<std::string> missing;          // functions that the loader does not find
    static inline std::set<std::string> asked;            // functions that it was asked for

    static void begin() {
        loseAfter(-1);
        isLost = false;
        reset = GL_GUILTY_CONTEXT_RESET;
        missing.clear();
        asked.clear();
    }
    static void loseAfter(int more) {
        calls = 0;
        lossAt = more;
    }
    static bool loses() {
        isLost = isLost || calls == lossAt;
        ++calls;
        return isLost;
    }
    static void* functionNamed(const char* name);
};

#define REBOUND_LOSSY_FUNCTIONS(X)                                                                           \
    REBOUND_GL_FUNCTIONS(X)                                                                                  \
    X(PFNGLOBJECTLABELPROC, ObjectLabel)                                                                     \
    X(PFNGLQUERYCOUNTERPROC, QueryCounter)                                                                   \
    X(PFNGLQUERYCOUNTERPROC, QueryCounterEXT)                                                                \
    X(PFNGLGETQUERYOBJECTUI64VPROC, GetQueryObjectui64v)                                                     \
    X(PFNGLGETQUERYOBJECTUI64VPROC, GetQueryObjectui64vEXT)                                                  \
    X(PFNGLGETGRAPHICSRESETSTATUSPROC, GetGraphicsResetStatus)                                               \
    X(PFNGLGETGRAPHICSRESETSTATUSPROC, GetGraphicsResetStatusKHR)

enum class LossyName {
#define REBOUND_LOSSY_NAME(type, name) name,
    REBOUND_LOSSY_FUNCTIONS(REBOUND_LOSSY_NAME)
#undef REBOUND_LOSSY_NAME
};

template <LossyName name, class Function>
struct LossyFunction;

template <LossyName name, class Value, class... Arguments>
struct LossyFunction<name, Value(APIENTRY*)(Arguments...)> {
    static inline Value(APIENTRY* real)(Arguments...) = nullptr;

    static Value APIENTRY call(Arguments... arguments) {
        if (!LossyOpenGL::loses()) return real(arguments...);
        if constexpr (name == LossyName::GetError) return GL_CONTEXT_LOST;
        else if constexpr (name == LossyName::GetGraphicsResetStatus ||
                           name == LossyName::GetGraphicsResetStatusKHR)
            return std::exchange(LossyOpenGL::reset, GLenum(GL_NO_ERROR));
        else if constexpr (name == LossyName::GetQueryObjectuiv) return setAvailable(arguments...);
        else if constexpr (name == LossyName::DeleteTextures || name == LossyName::DeleteBuffers ||
                           name == LossyName::DeleteSamplers || name == LossyName::DeleteQueries ||
                           name == LossyName::DeleteProgram || name == LossyName::DeleteShader)
            return real(arguments...);
        else return Value();
    }
    static void setAvailable(GLuint, GLenum, GLuint* available) { *available = GL_TRUE; }
};

inline void* LossyOpenGL::functionNamed(const char* name) {
    asked.insert(name);
    void* const real = host::OpenGLContext::functionNamed(name);
    if (!real || missing.contains(name)) return nullptr;
    const std::string_view wanted(name);
#define REBOUND_LOSSY_ENTRY(type, function)                                                                  \
    if (wanted == "gl" #function) {                                                                          \
        LossyFunction<LossyName::function, type>::real = reinterpret_cast<type>(real);                       \
        return reinterpret_cast<void*>(LossyFunction<LossyName::function, type>::call);                      \
    }
    REBOUND_LOSSY_FUNCTIONS(REBOUND_LOSSY_ENTRY)
#undef REBOUND_LOSSY_ENTRY
    return real;
}

} // namespace rebound::test
