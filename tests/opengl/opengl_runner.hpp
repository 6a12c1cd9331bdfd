// SPDX-License-Identifier: MIT
// Contexts of either API, and plans run on them and on the scalar CPU device.
#pragma once

#include "kernel_runner.hpp"

#include "lab/host/gl_functions.hpp"
#include "lab/host/opengl_context.hpp"
#include "lab/host/opengl_texture.hpp"
#include "rebound/opengl/device.hpp"

#include <map>
#include <string>
#include <vector>

namespace rebound::test {

inline const char* name(host::OpenGLApi api) { return api == host::OpenGLApi::es ? "OpenGL ES" : "OpenGL"; }

inline opengl::DeviceOptions optionsWithTestShaders() {
    opengl::DeviceOptions options;
    options.loader = host::OpenGLContext::functionNamed;
    options.moreShaders = {testShaders()};
    return options;
}

// No error is pending, and debug output has nothing to say.
inline void checkQuiet(host::OpenGLContext& context) {
    CHECK(glGetError() == GL_NO_ERROR);
    for (const std::string& message : context.takeMessages()) FAIL_CHECK("debug output: " << message);
}

// Runs the body in a context of each API that the system has, and checks that it leaves no error and no
// message.
template <class Body>
void inEachContext(Body body) {
    for (host::OpenGLApi api : {host::OpenGLApi::desktop, host::OpenGLApi::es}) {
        auto context = host::OpenGLContext::create(api);
        if (!context) {
            MESSAGE(std::string(name(api)) << " is left out: " << context.error().message);
            continue;
        }
        INFO(context->description());
        checkQuiet(*context);
        body(*context);
        checkQuiet(*context);
    }
}

inline opengl::Device createDevice(const opengl::DeviceOptions& options = optionsWithTestShaders()) {
    auto device = opengl::Device::create(options);
    REQUIRE_MESSAGE(device, (device ? "" : device.error().message));
    return *device;
}

inline opengl::Program compile(const opengl::Device& device, const Plan& plan) {
    auto program = device.compile(plan);
    REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
    return *std::move(program);
}

inline host::OpenGLTexture textureOf(const Picture& picture) {
    lab::Image image(picture.extent, picture.channels);
    image.data = picture.values;
    return {picture.channels == 1 ? Format::r32f : Format::rgba32f, image};
}

inline Picture readBack(unsigned texture, Extent2D extent, int channels) {
    auto image = host::readTexture(texture, extent, channels);
    REQUIRE_MESSAGE(image, (image ? "" : image.error().message));
    Picture picture(extent, channels);
    picture.values = image->data;
    return picture;
}

// What a plan's images hold, by name: of inputs, what the host puts in.
using Pictures = std::map<std::string, Picture>;

// Textures for a plan's inputs and outputs. The latter have one format and hold -1.
struct HostTextures {
    std::map<std::string, host::OpenGLTexture> textures;

    HostTextures(const Plan& plan, const Pictures& pictures, Format outputFormat) {
        for (const Resource& r : plan.resources) {
            if (r.kind == ResourceKind::input) textures.emplace(r.name, textureOf(pictures.at(r.name)));
            if (r.kind == ResourceKind::output)
                textures.emplace(r.name, host::OpenGLTexture(outputFormat, lab::Image(r.extent, 4, -1.0f)));
        }
    }
    FrameInputs<opengl::Image> inputs(std::vector<NamedConstants> constants = {}) const {
        FrameInputs<opengl::Image> inputs;
        for (const auto& [resource, texture] : textures)
            inputs.images.push_back({resource, {texture.name()}});
        inputs.constants = std::move(constants);
        return inputs;
    }
    Picture read(const std::string& resource, int channels) const {
        const host::OpenGLTexture& texture = textures.at(resource);
        return readBack(texture.name(), texture.extent(), channels);
    }
};

// The plan's outputs, by OpenGL.
inline Pictures runPlan(const opengl::Device& device, const Plan& plan, const Pictures& pictures,
                        Format outputFormat, const std::vector<NamedConstants>& constants = {}) {
    opengl::Program program = compile(device, plan);
    const HostTextures host(plan, pictures, outputFormat);
    const auto recorded = program.record(host.inputs(constants));
    REQUIRE_MESSAGE(recorded, (recorded ? "" : recorded.error().message));
    Pictures outputs;
    for (const Resource& r : plan.resources)
        if (r.kind == ResourceKind::output) outputs.emplace(r.name, host.read(r.name, r.channels));
    return outputs;
}

// The same by the CPU, one pixel at a time.
inline Pictures runPlan(const cpu::Device& device, const Plan& plan, const Pictures& pictures,
                        const std::vector<NamedConstants>& constants = {}) {
    auto program = device.compile(plan);
    REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
    Pictures all = pictures, outputs;
    FrameInputs<cpu::Image> inputs;
    inputs.constants = constants;
    for (const Resource& r : plan.resources) {
        if (r.kind == ResourceKind::input) inputs.images.push_back({r.name, all.at(r.name).image()});
        if (r.kind == ResourceKind::output)
            inputs.images.push_back(
                {r.name, outputs.emplace(r.name, Picture(r.extent, r.channels)).first->second.image()});
    }
    const auto recorded = program->record(inputs);
    REQUIRE_MESSAGE(recorded, (recorded ? "" : recorded.error().message));
    return outputs;
}

inline Picture runKernel(const opengl::Device& device, const KernelCall& call) {
    const Plan plan = planOf(call);
    Pictures pictures;
    for (size_t i = 0; i < call.inputs.size(); ++i)
        pictures.emplace(plan.resources[i].name, *call.inputs[i].second);
    return runPlan(device, plan, pictures, Format::rgba32f).at("result");
}

} // namespace rebound::test
