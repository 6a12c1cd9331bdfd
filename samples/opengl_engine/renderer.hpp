// SPDX-License-Identifier: MIT
// A deferred renderer: shadow map, G-buffer, direct light, Rebound's indirect light.
#pragma once

#include "baked_light.hpp"
#include "camera.hpp"
#include "gpu_scene.hpp"
#include "indirect_light.hpp"

#include "lab/engine/command_line.hpp"
#include "lab/host/opengl_texture.hpp"

#include <memory>

namespace rebound::engine {

// Its twin is in shaders/frame.glsl, where the fields are explained.
struct FrameConstants {
    glm::mat4 viewProjection, inverseViewProjection, shadowMatrix;
    glm::vec4 eye, shadow;
    glm::ivec4 counts;
};

// Textures of the size of the picture. Row 0 is the bottom one, as OpenGL rasterises.
struct Targets {
    explicit Targets(Extent2D);
    Extent2D extent;
    Texture depth;
    host::OpenGLTexture normal, albedo, emission;
    host::OpenGLTexture lit;                // emission + albedo * E / pi
    host::OpenGLTexture radiance;           // what of it surfaces send to be gathered
    host::OpenGLTexture indirect, composed; // written by Rebound
    Framebuffer framebuffer;
};

// Every call, and its end, needs the context current in which it was created.
class Renderer {
public:
    static Result<std::unique_ptr<Renderer>> create(const opengl::Loader&, const lab::Scene&,
                                                    std::string preset);
    // With indirect light from the scene's bake instead of the screen's.
    static Result<std::unique_ptr<Renderer>> create(const opengl::Loader&, const lab::Scene&, const Bake&);

    // Before the first frame, and whenever the size, or the kind of the camera, changes. After a failure nothing has
    // changed.
    Result<> resize(Extent2D, const lab::CameraView&);

    // Issues a frame's commands.
    Result<> render(const lab::CameraView&);

    // What moves is there from the next frame on.
    void set(const Moment& moment) { scene.set(moment); }

    const Targets& targets() const { return *current; }
    const IndirectLight& indirectLight() const { return indirect; }
    const BakedLight* bakedLight() const { return baked ? &*baked : nullptr; }
    // Of whichever light there is.
    Result<std::vector<PassTiming>> timings() const { return baked ? baked->timings() : indirect.timings(); }
    MemoryUse memoryUse() const { return baked ? baked->memoryUse() : indirect.memoryUse(); }

    // For pictures and tests: waits. Rows as the texture has them: the bottom one first.
    Result<lab::Image> read(const host::OpenGLTexture& texture, int channels) const {
        return host::readTexture(texture.name(), texture.extent(), channels);
    }
    lab::Image readDepth() const; // as stored, 0 to 1
    lab::Image readShadowMap() const;

private:
    Renderer(std::string p, GpuScene s, IndirectLight light)
        : preset(std::move(p)), scene(std::move(s)), indirect(std::move(light)) {}
    Result<> createOnce();
    void writeFrame(const lab::CameraView&, const Camera&);
    void drawShadowMap() const;
    void drawGBuffer() const;
    void light() const;
    ScreenIndirectFrame<opengl::Image> indirectFrame(const Camera&) const;
    IlluminanceCompositionFrame<opengl::Image> bakedFrame(const Camera&) const;

    std::string preset;
    GpuScene scene;
    Program shadowProgram, gbufferProgram, lightProgram;
    Buffer frameBuffer;
    Texture shadowMap;
    Framebuffer shadowFramebuffer;
    IndirectLight indirect;
    std::optional<BakedLight> baked;
    std::unique_ptr<Targets> current;
};

// As the options say: with the screen's light, or with that of a bake, which is read.
Result<std::unique_ptr<Renderer>> createRenderer(const opengl::Loader&, const lab::Scene&, const Options&);

// Rows in the opposite order: as files and the lab have them.
lab::Image upsideDown(const lab::Image&);

} // namespace rebound::engine
