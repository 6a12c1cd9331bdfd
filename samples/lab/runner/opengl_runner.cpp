// SPDX-License-Identifier: MIT
#include "lab/host/gl_functions.hpp"
#include "lab/host/opengl_context.hpp"
#include "lab/host/opengl_texture.hpp"
#include "lab/runner/inspection.hpp"
#include "rebound/opengl/device.hpp"
#include "rebound/techniques/input_check.hpp"

namespace rebound::runner {
namespace {

using host::OpenGLContext;
using host::OpenGLTexture;

class OpenGLPlan : public PreparedPlan {
public:
    OpenGLPlan(opengl::Program compiled, Precision hostPrecision)
        : program(std::move(compiled)), precision(hostPrecision) {
        const Plan& plan = program.plan();
        textures.resize(plan.resources.size());
        for (size_t i = 0; i < plan.resources.size(); ++i) {
            const Resource& r = plan.resources[i];
            if (r.kind != ResourceKind::input && r.kind != ResourceKind::output) continue;
            textures[i] =
                OpenGLTexture(r.kind == ResourceKind::input ? inputFormat(r, precision) : r.format, r.extent);
            frame.images.push_back({r.name, {textures[i].name()}});
        }
    }

    Result<> setInputs(const PlanInputs& inputs) override {
        const Plan& plan = program.plan();
        if (auto valid = checkInputs(plan, inputs); !valid) return valid;
        for (size_t i = 0; i < plan.resources.size(); ++i) {
            const Resource& r = plan.resources[i];
            if (r.kind != ResourceKind::input) continue;
            const Format format = inputFormat(r, precision);
            lab::Image image = **findPicture(plan, inputs, r);
            roundTo(format, image); // as every backend has them, whatever the driver would make of them
            host::writeTexture(textures[i].name(), format, image);
        }
        frame.constants = inputs.constants;
        return {};
    }

    Result<double> run() override {
        const auto start = std::chrono::steady_clock::now();
        if (auto recorded = program.record(frame); !recorded) return recorded.error();
        recording = millisecondsSince(start);
        glFinish();
        return millisecondsSince(start);
    }

    const std::vector<PassTiming>& timings() const override { return program.timings(); }
    std::optional<double> recordingTime() const override { return recording; }
    MemoryUse memoryUse() const override { return program.memoryUse(); }

    Result<lab::Image> read(const std::string& output) override {
        const auto index = findOutput(program.plan(), output);
        if (!index) return index.error();
        return contents(*index);
    }

    Result<Record> inspect(const Record* replacement) override {
        return inspectPasses(
            program, frame, replacement, [&](ResourceIndex r) { return contents(r); },
            [&](ResourceIndex r, const lab::Image& image) { return replace(r, image); });
    }

private:
    Result<unsigned> textureOf(ResourceIndex index) const {
        const Resource& r = program.plan().resources[size_t(index)];
        if (r.kind == ResourceKind::transient) return program.transientTexture(r.name);
        return textures[size_t(index)].name();
    }

    Result<lab::Image> contents(ResourceIndex index) const {
        const auto texture = textureOf(index);
        if (!texture) return texture.error();
        glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
        const Resource& r = program.plan().resources[size_t(index)];
        return host::readTexture(*texture, r.extent, r.channels);
    }

    Result<> replace(ResourceIndex index, const lab::Image& image) {
        const auto texture = textureOf(index);
        if (!texture) return texture.error();
        host::writeTexture(*texture, program.plan().resources[size_t(index)].format, image);
        return {};
    }

    opengl::Program program;
    Precision precision;
    std::vector<OpenGLTexture> textures; // by resource; none where it is none of the host's
    FrameInputs<opengl::Image> frame;
    double recording = 0; // [ms]
};

class OpenGLBackend : public Backend {
public:
    OpenGLBackend(OpenGLContext c, opengl::Device d) : context(std::move(c)), device(std::move(d)) {}

    BackendInfo info() const override { return {"opengl", context.description(), "", 0}; }
    Result<MemoryUse> memoryUse(const Plan& plan) const override { return device.memoryUse(plan); }

    Result<std::unique_ptr<PreparedPlan>> prepare(const Plan& plan, const PlanInputs& inputs,
                                                  const PrepareOptions& options) override {
        auto program = device.compile(plan);
        if (!program) return program.error();
        auto prepared = std::make_unique<OpenGLPlan>(*std::move(program), options.precision);
        if (auto set = prepared->setInputs(inputs); !set) return set.error();
        return std::unique_ptr<PreparedPlan>(std::move(prepared));
    }

    std::vector<std::string> complaints() override { return context.takeMessages(); }

private:
    OpenGLContext context;
    opengl::Device device;
};

} // namespace

Result<std::unique_ptr<Backend>> createOpenGLBackend(const BackendChoice& choice) {
    auto context = OpenGLContext::create(host::OpenGLApi::desktop);
    // GPUs of phones, and drivers that stop short of OpenGL 4.3, may have ES 3.1.
    if (!context) context = OpenGLContext::create(host::OpenGLApi::es);
    if (!context) return Error{context.error().code, "OpenGL: " + context.error().message};
    if (auto found = host::requireDevice(context->description(), choice.device); !found)
        return Error{found.error().code, "OpenGL: " + found.error().message};
    opengl::DeviceOptions options;
    options.loader = OpenGLContext::functionNamed;
    options.timings = true;
    options.moreShaders = {inputCheckShaders()};
    auto device = opengl::Device::create(options);
    if (!device) return Error{device.error().code, "OpenGL: " + device.error().message};
    return std::unique_ptr<Backend>(std::make_unique<OpenGLBackend>(*std::move(context), *std::move(device)));
}

} // namespace rebound::runner
