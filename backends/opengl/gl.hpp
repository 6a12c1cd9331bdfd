// SPDX-License-Identifier: MIT
// OpenGL's functions as the host's loader finds them, and what the context can do.
#pragma once

#include "rebound/detail/loss.hpp"
#include "rebound/opengl/device.hpp"

#include <GL/glcorearb.h>

#include <memory>
#include <string>
#include <string_view>

namespace rebound::opengl {

// Functions that OpenGL 4.3 and OpenGL ES 3.1 have alike.
#define REBOUND_GL_FUNCTIONS(X)                                                                              \
    X(PFNGLGETSTRINGPROC, GetString)                                                                         \
    X(PFNGLGETSTRINGIPROC, GetStringi)                                                                       \
    X(PFNGLGETERRORPROC, GetError)                                                                           \
    X(PFNGLGETINTEGERVPROC, GetIntegerv)                                                                     \
    X(PFNGLGETINTEGER64VPROC, GetInteger64v)                                                                 \
    X(PFNGLGETINTEGERI_VPROC, GetIntegeri_v)                                                                 \
    X(PFNGLGETINTEGER64I_VPROC, GetInteger64i_v)                                                             \
    X(PFNGLGENTEXTURESPROC, GenTextures)                                                                     \
    X(PFNGLDELETETEXTURESPROC, DeleteTextures)                                                               \
    X(PFNGLISTEXTUREPROC, IsTexture)                                                                         \
    X(PFNGLBINDTEXTUREPROC, BindTexture)                                                                     \
    X(PFNGLACTIVETEXTUREPROC, ActiveTexture)                                                                 \
    X(PFNGLTEXSUBIMAGE2DPROC, TexSubImage2D)                                                                 \
    X(PFNGLPIXELSTOREIPROC, PixelStorei)                                                                     \
    X(PFNGLTEXSTORAGE2DPROC, TexStorage2D)                                                                   \
    X(PFNGLGETTEXPARAMETERIVPROC, GetTexParameteriv)                                                         \
    X(PFNGLGETTEXLEVELPARAMETERIVPROC, GetTexLevelParameteriv)                                               \
    X(PFNGLBINDIMAGETEXTUREPROC, BindImageTexture)                                                           \
    X(PFNGLGENSAMPLERSPROC, GenSamplers)                                                                     \
    X(PFNGLDELETESAMPLERSPROC, DeleteSamplers)                                                               \
    X(PFNGLSAMPLERPARAMETERIPROC, SamplerParameteri)                                                         \
    X(PFNGLBINDSAMPLERPROC, BindSampler)                                                                     \
    X(PFNGLGENBUFFERSPROC, GenBuffers)                                                                       \
    X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                                                 \
    X(PFNGLBINDBUFFERPROC, BindBuffer)                                                                       \
    X(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                                                               \
    X(PFNGLBINDBUFFERRANGEPROC, BindBufferRange)                                                             \
    X(PFNGLISBUFFERPROC, IsBuffer)                                                                           \
    X(PFNGLGETBUFFERPARAMETERI64VPROC, GetBufferParameteri64v)                                               \
    X(PFNGLBUFFERSUBDATAPROC, BufferSubData)                                                                 \
    X(PFNGLBUFFERDATAPROC, BufferData)                                                                       \
    X(PFNGLCREATESHADERPROC, CreateShader)                                                                   \
    X(PFNGLSHADERSOURCEPROC, ShaderSource)                                                                   \
    X(PFNGLCOMPILESHADERPROC, CompileShader)                                                                 \
    X(PFNGLGETSHADERIVPROC, GetShaderiv)                                                                     \
    X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                                                           \
    X(PFNGLDELETESHADERPROC, DeleteShader)                                                                   \
    X(PFNGLCREATEPROGRAMPROC, CreateProgram)                                                                 \
    X(PFNGLATTACHSHADERPROC, AttachShader)                                                                   \
    X(PFNGLLINKPROGRAMPROC, LinkProgram)                                                                     \
    X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                                                   \
    X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                                                         \
    X(PFNGLISPROGRAMPROC, IsProgram)                                                                         \
    X(PFNGLUSEPROGRAMPROC, UseProgram)                                                                       \
    X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                                                                 \
    X(PFNGLDISPATCHCOMPUTEPROC, DispatchCompute)                                                             \
    X(PFNGLMEMORYBARRIERPROC, MemoryBarrier)                                                                 \
    X(PFNGLGENQUERIESPROC, GenQueries)                                                                       \
    X(PFNGLDELETEQUERIESPROC, DeleteQueries)                                                                 \
    X(PFNGLGETQUERYOBJECTUIVPROC, GetQueryObjectuiv)

struct Limits {
    int textureSize = 0;            // of a side [texels]
    int textures = 0;               // that a kernel reads
    int images = 0;                 // that a kernel writes
    int uniformBlocks = 0;          // that a kernel reads
    int storageBlocks = 0;          // that a kernel reads
    int64_t uniformBlock = 0;       // [bytes]
    int64_t storageBlock = 0;       // [bytes]
    size_t alignment = 256;         // of uniform and storage blocks in a buffer [bytes]
    int64_t storageAlignment = 256; // of storage blocks alone, which hosts may hand in [bytes]
    int debugGroups = 0;            // that may be open at once
    int labelLength = 0;            // of objects and groups [characters]
};

struct Gl {
#define REBOUND_GL_MEMBER(type, name) type name = nullptr;
    REBOUND_GL_FUNCTIONS(REBOUND_GL_MEMBER)
#undef REBOUND_GL_MEMBER
    // Null where the context lacks them: KHR_debug, timestamps, and KHR_robustness or its like.
    PFNGLPUSHDEBUGGROUPPROC PushDebugGroup = nullptr;
    PFNGLPOPDEBUGGROUPPROC PopDebugGroup = nullptr;
    PFNGLOBJECTLABELPROC ObjectLabel = nullptr;
    PFNGLQUERYCOUNTERPROC QueryCounter = nullptr;
    PFNGLGETQUERYOBJECTUI64VPROC GetQueryObjectui64v = nullptr;
    PFNGLGETGRAPHICSRESETSTATUSPROC GetGraphicsResetStatus = nullptr;

    bool es = false;
    int version = 0; // 43 stands for 4.3
    Limits limits;
    mutable detail::Loss loss; // of the context

    // Fails where no context is current, it is too old or lost, or a function is missing.
    static Result<std::shared_ptr<const Gl>> load(const Loader&);

    int integer(GLenum name) const {
        GLint value = 0;
        GetIntegerv(name, &value);
        return value;
    }
    // Fails where the context is lost, from the first call on that finds out. Reads the reset status, which
    // some drivers tell only once.
    Result<> checkPresent(const char* doing) const;
    // The error of a lost context, as a reset status or GL_CONTEXT_LOST says it is.
    Error lost(const char* doing, GLenum how) const;
    void label(GLenum kind, GLuint object, std::string_view text) const;
};

// The name of an error that glGetError gives, or of a reset status.
std::string errorName(GLenum);

} // namespace rebound::opengl
