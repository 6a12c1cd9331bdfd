// SPDX-License-Identifier: MIT
#include "renderer.hpp"

#include "gbuffer_frag.h"
#include "gbuffer_vert.h"
#include "light_comp.h"
#include "shadow_frag.h"
#include "shadow_vert.h"

#include <algorithm>

namespace rebound::engine {
namespace {

// The lights' shadow matrix gives depth 0 to 1; OpenGL clips and stores -1 to 1.
glm::mat4 toOpenGLDepth(const glm::mat4& matrix) {
    glm::mat4 range(1.0f);
    range[2][2] = 2.0f;
    range[3][2] = -1.0f;
    return range * matrix;
}

void bindTextures(std::initializer_list<GLuint> textures) {
    GLenum unit = GL_TEXTURE0;
    for (GLuint texture : textures) {
        glActiveTexture(unit++);
        glBindTexture(GL_TEXTURE_2D, texture);
    }
    glActiveTexture(GL_TEXTURE0);
}

Result<> makeInto(Program& program, const char* name, std::initializer_list<Stage> stages) {
    auto made = makeProgram(name, stages);
    if (!made) return made.error();
    program = *std::move(made);
    return {};
}

} // namespace

// [rebound images]
// Outputs have the format that the plan asks for; inputs may have any that samples as floats.
Targets::Targets(Extent2D size)
    : extent(size), depth(makeDepthTexture(size.width, size.height)), normal(Format::rgba16f, size),
      albedo(Format::rgba16f, size), emission(Format::rgba16f, size), lit(Format::rgba16f, size),
      radiance(Format::rgba16f, size), indirect(Format::rgba16f, size), composed(Format::rgba16f, size),
      framebuffer(makeFramebuffer(depth.name(), {normal.name(), albedo.name(), emission.name()})) {}
// [/rebound images]

Result<std::unique_ptr<Renderer>> Renderer::create(const opengl::Loader& loader, const lab::Scene& labScene,
                                                   std::string preset) {
    auto indirect = IndirectLight::create(loader, true);
    if (!indirect) return indirect.error();
    auto scene = GpuScene::create(labScene);
    if (!scene) return scene.error();
    std::unique_ptr<Renderer> renderer(
        new Renderer(std::move(preset), *std::move(scene), *std::move(indirect)));
    if (auto made = renderer->createOnce(); !made) return made.error();
    return renderer;
}

Result<std::unique_ptr<Renderer>> Renderer::create(const opengl::Loader& loader, const lab::Scene& labScene,
                                                   const Bake& bake) {
    auto renderer = create(loader, labScene, std::string("quarter-64"));
    if (!renderer) return renderer.error();
    auto light = BakedLight::create(loader, bake, !labScene.emissiveMaterialsLight, true);
    if (!light) return light.error();
    (*renderer)->baked = *std::move(light);
    return renderer;
}

Result<> Renderer::createOnce() {
    if (auto made = makeInto(shadowProgram, "shadow",
                             {{GL_VERTEX_SHADER, shadow_vert}, {GL_FRAGMENT_SHADER, shadow_frag}});
        !made)
        return made;
    if (auto made = makeInto(gbufferProgram, "gbuffer",
                             {{GL_VERTEX_SHADER, gbuffer_vert}, {GL_FRAGMENT_SHADER, gbuffer_frag}});
        !made)
        return made;
    if (auto made = makeInto(lightProgram, "light", {{GL_COMPUTE_SHADER, light_comp}}); !made) return made;
    const FrameConstants none{};
    frameBuffer = makeBuffer(GL_UNIFORM_BUFFER, std::as_bytes(std::span(&none, 1)));
    shadowMap = makeDepthTexture(shadowMapSize, shadowMapSize);
    shadowFramebuffer = makeFramebuffer(shadowMap.name(), {});
    return checkErrors("while the renderer was made");
}

Result<> Renderer::resize(Extent2D size, const lab::CameraView& view) {
    auto next = std::make_unique<Targets>(size);
    if (auto made = checkErrors("while the targets were made"); !made) return made;
    if (baked) {
        if (auto compiled = baked->compile(conventionsOf(view), size); !compiled) return compiled;
        current = std::move(next);
        return {};
    }
    // [rebound resize]
    if (auto compiled = indirect.compile(preset, conventionsOf(view), size); !compiled) return compiled;
    // [/rebound resize]
    current = std::move(next);
    return {};
}

void Renderer::writeFrame(const lab::CameraView& view, const Camera& camera) {
    const glm::dmat4 viewProjection = glm::dmat4(camera.projection) * glm::dmat4(camera.view);
    FrameConstants k;
    k.viewProjection = glm::mat4(viewProjection);
    k.inverseViewProjection = glm::mat4(glm::inverse(viewProjection));
    k.shadowMatrix = toOpenGLDepth(scene.lights.shadowMatrix);
    k.eye = view.orthographic ? glm::vec4(view.position - view.target, 0.0f) : glm::vec4(view.position, 1.0f);
    k.shadow = {scene.lights.shadowTexel, scene.lights.shadowPerspective ? 1.0f : 0.0f,
                scene.lights.emissionIsDirectLight ? 1.0f : 0.0f, 0.0f};
    k.counts = {scene.lights.count, scene.lights.shadowed, current->extent.width, current->extent.height};
    // New storage each frame: the driver keeps the old one until the GPU is done with it.
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, frameBuffer.name());
    glBufferData(GL_UNIFORM_BUFFER, sizeof k, &k, GL_STREAM_DRAW);
}

void Renderer::drawShadowMap() const {
    glBindFramebuffer(GL_FRAMEBUFFER, shadowFramebuffer.name());
    glViewport(0, 0, shadowMapSize, shadowMapSize);
    glClear(GL_DEPTH_BUFFER_BIT);
    glUseProgram(shadowProgram.name());
    scene.draw();
}

void Renderer::drawGBuffer() const {
    glBindFramebuffer(GL_FRAMEBUFFER, current->framebuffer.name());
    glViewport(0, 0, current->extent.width, current->extent.height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUseProgram(gbufferProgram.name());
    scene.draw();
}

void Renderer::light() const {
    glUseProgram(lightProgram.name());
    bindTextures({current->depth.name(), current->normal.name(), current->albedo.name(),
                  current->emission.name(), shadowMap.name()});
    glBindImageTexture(0, current->lit.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA16F);
    glBindImageTexture(1, current->radiance.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA16F);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, scene.lightBuffer.name());
    const auto groups = [](int side) { return GLuint(side + 7) / 8; };
    glDispatchCompute(groups(current->extent.width), groups(current->extent.height), 1);
}

// [rebound frame]
// Emissive surfaces are lights here, so what surfaces send to be gathered is not all that is seen: radiance and lit are
// two textures.
ScreenIndirectFrame<opengl::Image> Renderer::indirectFrame(const Camera& camera) const {
    ScreenIndirectFrame<opengl::Image> f;
    f.camera = camera; // the matrices that the G-buffer was drawn with
    f.depth = {current->depth.name()};
    f.normal = {current->normal.name()};
    f.albedo = {current->albedo.name()};
    f.radiance = {current->radiance.name()};
    f.lit = {current->lit.name()};
    f.indirect = {current->indirect.name()};
    f.composed = {current->composed.name()};
    return f;
}
// [/rebound frame]

// [rebound frame baked]
IlluminanceCompositionFrame<opengl::Image> Renderer::bakedFrame(const Camera& camera) const {
    IlluminanceCompositionFrame<opengl::Image> f;
    f.camera = camera;
    f.depth = {current->depth.name()};
    f.normal = {current->normal.name()};
    f.albedo = {current->albedo.name()};
    f.lit = {current->lit.name()};
    f.indirect = {current->indirect.name()};
    f.composed = {current->composed.name()};
    return f;
}
// [/rebound frame baked]

Result<> Renderer::render(const lab::CameraView& view) {
    const Camera camera = cameraOf(view, current->extent);
    writeFrame(view, camera);
    glEnable(GL_DEPTH_TEST); // GL_LESS, cleared to 1: OpenGL's defaults
    drawShadowMap();
    drawGBuffer();
    glDisable(GL_DEPTH_TEST);
    light();
    if (baked) {
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
        return baked->record(bakedFrame(camera), surfelSourcesOf(scene.lights), {shadowMap.name()});
    }
    // [rebound barriers]
    // Before: the light pass has written with image stores what Rebound is about to fetch. What was rendered, the
    // G-buffer, needs no barrier. After: Rebound has put those for whatever may come.
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    if (auto recorded = indirect.record(indirectFrame(camera)); !recorded) return recorded;
    // [/rebound barriers]
    return {};
}

namespace {

lab::Image depthOf(const Texture& texture, Extent2D extent) {
    lab::Image image(extent, 1);
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glGetTexImage(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, GL_FLOAT, image.data.data());
    glBindTexture(GL_TEXTURE_2D, 0);
    return image;
}

} // namespace

lab::Image Renderer::readDepth() const { return depthOf(current->depth, current->extent); }
lab::Image Renderer::readShadowMap() const { return depthOf(shadowMap, {shadowMapSize, shadowMapSize}); }

Result<std::unique_ptr<Renderer>> createRenderer(const opengl::Loader& loader, const lab::Scene& scene,
                                                 const Options& o) {
    if (o.bake.empty()) return Renderer::create(loader, scene, o.preset);
    const auto bake = bakeOf(o);
    if (!bake) return bake.error();
    return Renderer::create(loader, scene, *bake);
}

lab::Image upsideDown(const lab::Image& image) {
    lab::Image result(image.extent(), image.channels);
    for (int y = 0; y < image.height; ++y)
        std::copy_n(image.at(0, image.height - 1 - y), size_t(image.width) * size_t(image.channels),
                    result.at(0, y));
    return result;
}

} // namespace rebound::engine
