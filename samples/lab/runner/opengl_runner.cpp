// SPDX-License-Identifier: MIT
#include "lab/host/gl_functions.hpp"
#include "lab/host/opengl_buffer.hpp"
#include "lab/host/opengl_context.hpp"
#include "lab/host/opengl_texture.hpp"
#include "lab/runner/inspection.hpp"
#include "rebound/opengl/device.hpp"
#include "rebound/techniques/input_check.hpp"

namespace rebound::runner {
namespace {

using host::OpenGLBuffer;
using host::OpenGLContext;
using host::OpenGLTexture;

class OpenGLPlan : public PreparedPlan {
public:
    OpenGLPlan(const opengl::Device& d, SharedBuffers<opengl::Buffer>& given, opengl::Program compiled,
               Precision hostPrecision)
        : device(d), shared(given), program(std::move(compiled)), precision(hostPrecision) {
        const Plan& plan = program.plan();
        textures.resize(plan.resources.size());
        buffers.resize(plan.resources.size());
        for (size_t i = 0; i < plan.resources.size(); ++i) {
            const Resource& r = plan.resources[i];
            if (r.kind == ResourceKind::outputBuffer) buffers[i] = OpenGLBuffer(r.size);
            if (!isHostImage(r.kind)) continue;
            textures[i] =
                OpenGLTexture(r.kind == ResourceKind::input ? inputFormat(r, precision) : r.format, r.extent);
            frame.images.push_back({r.name, {textures[i].name()}});
        }
    }

    Result<> setInputs(const PlanInputs& inputs) override {
        const Plan& plan = program.plan();
        if (auto valid = checkInputs(plan, inputs); !valid) return valid;
        frame.buffers.clear();
        for (size_t i = 0; i < plan.resources.size(); ++i) {
            const Resource& r = plan.resources[i];
            if (r.kind == ResourceKind::outputBuffer)
                frame.buffers.push_back({r.name, {buffers[i].name(), 0, r.size, {}}});
            if (r.kind == ResourceKind::inputBuffer) {
                auto buffer = shared.obtain(device, *findBytes(plan, inputs, r));
                if (!buffer) return buffer.error();
                frame.buffers.push_back({r.name, *std::move(buffer)});
            }
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
        const double elapsed = millisecondsSince(start);
        auto measured = program.timings();
        if (!measured) return measured.error();
        passTimings = *std::move(measured);
        return elapsed;
    }

    const std::vector<PassTiming>& timings() const override { return passTimings; }
    std::optional<double> recordingTime() const override { return recording; }
    MemoryUse memoryUse() const override { return program.memoryUse(); }

    Result<lab::Image> read(const std::string& output) override {
        const auto index = findOutput(program.plan(), output);
        if (!index) return index.error();
        return contents(*index);
    }

    void reset() override { program.reset(); }

    Result<Record> inspect(const Record* replacement) override {
        return inspectPasses(
            program, frame, replacement, [&](ResourceIndex r) { return contents(r); },
            [&](ResourceIndex r, const lab::Image& image) { return replace(r, image); });
    }

private:
    Result<unsigned> textureOf(ResourceIndex index) const {
        const Resource& r = program.plan().resources[size_t(index)];
        if (!isHostImage(r.kind)) return program.ownTexture(r.name);
        return textures[size_t(index)].name();
    }

    Result<opengl::Buffer> bufferOf(ResourceIndex index) const {
        const Resource& r = program.plan().resources[size_t(index)];
        if (r.kind != ResourceKind::outputBuffer) return program.ownBuffer(r.name);
        return opengl::Buffer{buffers[size_t(index)].name(), 0, r.size, {}};
    }

    Result<lab::Image> contents(ResourceIndex index) const {
        if (const Resource& r = program.plan().resources[size_t(index)]; !isImage(r.kind)) {
            const auto buffer = bufferOf(index);
            if (!buffer) return buffer.error();
            glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
            auto bytes = host::readBuffer(buffer->buffer, buffer->offset, r.size);
            if (!bytes) return bytes.error();
            return rowOf(*bytes);
        }
        const auto texture = textureOf(index);
        if (!texture) return texture.error();
        glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
        const Resource& r = program.plan().resources[size_t(index)];
        return host::readTexture(*texture, r.extent, r.channels, isInteger(r.format));
    }

    Result<> replace(ResourceIndex index, const lab::Image& image) {
        if (!isImage(program.plan().resources[size_t(index)].kind)) {
            const auto buffer = bufferOf(index);
            if (!buffer) return buffer.error();
            host::writeBuffer(buffer->buffer, buffer->offset, bytesOf(image));
            return {};
        }
        const auto texture = textureOf(index);
        if (!texture) return texture.error();
        host::writeTexture(*texture, program.plan().resources[size_t(index)].format, image);
        return {};
    }

    const opengl::Device& device;
    SharedBuffers<opengl::Buffer>& shared;
    opengl::Program program;
    Precision precision;
    std::vector<OpenGLTexture> textures; // by resource; none where it is none of the host's
    std::vector<OpenGLBuffer> buffers;   // likewise; output buffers
    FrameInputs<opengl::Image> frame;
    std::vector<PassTiming> passTimings;
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
        auto prepared = std::make_unique<OpenGLPlan>(device, shared, *std::move(program), options.precision);
        if (auto set = prepared->setInputs(inputs); !set) return set.error();
        return std::unique_ptr<PreparedPlan>(std::move(prepared));
    }

    std::vector<std::string> complaints() override { return context.takeMessages(); }

private:
    OpenGLContext context;
    opengl::Device device;
    SharedBuffers<opengl::Buffer> shared;
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
    options.moreShaders = choice.moreShaders;
    options.moreShaders.push_back(inputCheckShaders());
    auto device = opengl::Device::create(options);
    if (!device) return Error{device.error().code, "OpenGL: " + device.error().message};
    return std::unique_ptr<Backend>(std::make_unique<OpenGLBackend>(*std::move(context), *std::move(device)));
}

} // namespace rebound::runner
