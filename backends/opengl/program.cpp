// SPDX-License-Identifier: MIT
#include "image_check.hpp"
#include "program_state.hpp"

#include <algorithm>
#include <cstring>

namespace rebound::opengl {
namespace {

// A group of commands for captures and debuggers; left out where the host has opened as many as there may be.
class DebugGroup {
public:
    DebugGroup(const Gl& functions, std::string_view label) : gl(functions) {
        isOpen = gl.PushDebugGroup && gl.integer(GL_DEBUG_GROUP_STACK_DEPTH) < gl.limits.debugGroups;
        if (isOpen)
            gl.PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0,
                              std::min(GLsizei(label.size()), gl.limits.labelLength), label.data());
    }
    ~DebugGroup() {
        if (isOpen) gl.PopDebugGroup();
    }
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;

private:
    const Gl& gl;
    bool isOpen = false;
};

using Inputs = detail::ResolvedInputs<Image>;

// New storage in each frame: the driver keeps the old one for as long as the GPU reads it, and nobody waits.
void uploadConstants(const Program::State& state, const Inputs& inputs) {
    const size_t size = state.memory.bufferSizes[size_t(BufferGroup::frameConstants)];
    if (size == 0) return;
    std::vector<std::byte> bytes(size);
    const std::array<int32_t, 4> frameState = state.frames.state();
    for (size_t i = 0; i < inputs.constants.size(); ++i) {
        const Resource& r = state.plan.resources[i];
        const void* from = r.kind == ResourceKind::frameState ? frameState.data() : inputs.constants[i];
        if (from) std::memcpy(bytes.data() + state.memory.bufferOffsets[i], from, r.size);
    }
    state.gl->BindBuffer(GL_UNIFORM_BUFFER, state.buffers[size_t(BufferGroup::frameConstants)].name());
    state.gl->BufferData(GL_UNIFORM_BUFFER, GLsizeiptr(bytes.size()), bytes.data(), GL_STREAM_DRAW);
}

struct TransferFormat {
    GLenum layout, type;
};
TransferFormat transferFormat(Format f) {
    switch (f) {
    case Format::r32f:
        return {GL_RED, GL_FLOAT};
    case Format::rgba16f:
        return {GL_RGBA, GL_HALF_FLOAT};
    case Format::rgba32f:
        return {GL_RGBA, GL_FLOAT};
    case Format::r32ui:
        return {GL_RED_INTEGER, GL_UNSIGNED_INT};
    case Format::rgba32ui:
        return {GL_RGBA_INTEGER, GL_UNSIGNED_INT};
    }
    return {GL_RED, GL_FLOAT};
}

// The host's way to unpack texels, set aside: tightly packed rows of the client's memory.
class PlainUnpacking {
public:
    explicit PlainUnpacking(const Gl& functions) : gl(functions) {
        for (size_t i = 0; i < names.size(); ++i) {
            before[i] = gl.integer(names[i]);
            gl.PixelStorei(names[i], names[i] == GL_UNPACK_ALIGNMENT ? 4 : 0);
        }
        buffer = GLuint(gl.integer(GL_PIXEL_UNPACK_BUFFER_BINDING));
        gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    }
    ~PlainUnpacking() {
        for (size_t i = 0; i < names.size(); ++i) gl.PixelStorei(names[i], before[i]);
        gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
    }
    PlainUnpacking(const PlainUnpacking&) = delete;
    PlainUnpacking& operator=(const PlainUnpacking&) = delete;

private:
    static constexpr std::array<GLenum, 4> names{GL_UNPACK_ALIGNMENT, GL_UNPACK_ROW_LENGTH,
                                                 GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS};
    const Gl& gl;
    std::array<GLint, 4> before{};
    GLuint buffer = 0;
};

// History and persistent buffers, before a first frame.
void clearPersistent(const Program::State& state) {
    if (state.memory.use.persistent == 0) return;
    const Gl& gl = *state.gl;
    const PlainUnpacking plain(gl);
    gl.ActiveTexture(GL_TEXTURE0);
    for (size_t i = 0; i < state.textures.size(); ++i) {
        const TextureUse& use = state.memory.textures[i];
        if (use.isShareable) continue;
        const std::vector<std::byte> row(bytesPerTexel(use.format) * size_t(use.extent.width));
        const auto [layout, type] = transferFormat(use.format);
        gl.BindTexture(GL_TEXTURE_2D, state.textures[i].name());
        for (int y = 0; y < use.extent.height; ++y)
            gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, y, use.extent.width, 1, layout, type, row.data());
    }
    const size_t size = state.memory.bufferSizes[size_t(BufferGroup::persistent)];
    if (size == 0) return;
    gl.BindBuffer(GL_UNIFORM_BUFFER, state.buffers[size_t(BufferGroup::persistent)].name());
    const std::vector<std::byte> zeros(std::min(size, size_t(1) << 20));
    for (size_t at = 0; at < size; at += zeros.size())
        gl.BufferSubData(GL_UNIFORM_BUFFER, GLintptr(at), GLsizeiptr(std::min(zeros.size(), size - at)),
                         zeros.data());
}

// readsPrevious: of history, the texture that the frame before has written.
GLuint ownTextureOf(const Program::State& state, ResourceIndex resource, bool readsPrevious) {
    int texture = state.memory.textureOf[size_t(resource)];
    if (state.plan.resources[size_t(resource)].kind == ResourceKind::history)
        texture += readsPrevious ? 1 - state.historyWritten : state.historyWritten;
    return state.textures[size_t(texture)].name();
}

GLuint textureOf(const Program::State& state, const CompiledPass::Slot& slot, const Inputs& inputs) {
    if (const Image* image = inputs.images[size_t(slot.resource)]) return image->texture;
    return ownTextureOf(state, slot.resource, slot.access == Access::readPrevious);
}

void bindBuffer(const Program::State& state, GLenum target, const CompiledPass::Slot& slot,
                const Inputs& inputs) {
    const Resource& r = state.plan.resources[size_t(slot.resource)];
    const Buffer* given = inputs.buffers[size_t(slot.resource)];
    const GLuint buffer = given ? given->buffer : state.buffers[size_t(bufferGroupOf(r.kind))].name();
    const size_t offset = given ? given->offset : state.memory.bufferOffsets[size_t(slot.resource)];
    state.gl->BindBufferRange(target, slot.unit, buffer, GLintptr(offset), GLsizeiptr(r.size));
}

void bindSlot(const Program::State& state, const CompiledPass::Slot& slot, const Inputs& inputs) {
    const Gl& gl = *state.gl;
    switch (slot.kind) {
    case BindingKind::none:
        break;
    case BindingKind::texture:
    case BindingKind::input:
    case BindingKind::uintTexture:
    case BindingKind::uintInput:
        gl.ActiveTexture(GL_TEXTURE0 + slot.unit);
        gl.BindTexture(GL_TEXTURE_2D, textureOf(state, slot, inputs));
        gl.BindSampler(slot.unit, state.sampler.name());
        break;
    case BindingKind::image:
    case BindingKind::output:
        gl.BindImageTexture(slot.unit, textureOf(state, slot, inputs), 0, GL_FALSE, 0, GL_WRITE_ONLY,
                            internalFormat(slot.format));
        break;
    case BindingKind::buffer:
    case BindingKind::values:
    case BindingKind::outputValues:
        bindBuffer(state, GL_SHADER_STORAGE_BUFFER, slot, inputs);
        break;
    case BindingKind::constants:
        bindBuffer(state, GL_UNIFORM_BUFFER, slot, inputs);
        break;
    }
}

void runPass(const Program::State& state, size_t index, const Inputs& inputs) {
    const Gl& gl = *state.gl;
    const CompiledPass& pass = state.passes[index];
    const DebugGroup group(gl, state.plan.passes[index].label);
    if (pass.barrierBefore != 0) gl.MemoryBarrier(pass.barrierBefore);
    gl.UseProgram(pass.program->program.name());
    for (const CompiledPass::Slot& slot : pass.slots) bindSlot(state, slot, inputs);
    gl.DispatchCompute(pass.groups[0], pass.groups[1], 1);
}

Result<> recordFrame(Program::State& state, const FrameInputs<Image>& inputs) {
    const Gl& gl = *state.gl;
    auto resolved = detail::resolveInputs(state.plan, inputs);
    if (!resolved) return resolved.error();
    if (!state.passes.empty() && !gl.IsProgram(state.passes[0].program->program.name()))
        return invalidArgument(
            "the current OpenGL context is none, is lost, or does not know this program; the one that it was "
            "compiled in was expected");
    const StateGuard guard(gl, state.units);
    gl.ActiveTexture(GL_TEXTURE0);
    if (auto valid = checkImages(gl, state.plan, resolved->images, state.outputFormats); !valid)
        return valid.error();
    if (auto valid = checkBuffers(gl, state.plan, resolved->buffers); !valid) return valid.error();

    const DebugGroup group(gl, state.plan.technique);
    uploadConstants(state, *resolved);
    state.historyWritten = state.frames.written();
    if (state.frames.atStart()) clearPersistent(state);
    state.frames.advance();
    if (state.timer) state.timer->beginFrame();
    for (size_t i = 0; i < state.passes.size(); ++i) {
        runPass(state, i, *resolved);
        if (state.timer) state.timer->endPass();
        if (state.passCallback) {
            gl.MemoryBarrier(state.barrierBehind);
            state.passCallback(int(i));
        }
    }
    if (state.timer) state.timer->endFrame();
    gl.MemoryBarrier(state.barrierBehind);
    return {};
}

} // namespace

Program::Program(std::unique_ptr<State> s) : state(std::move(s)) {}
Program::~Program() = default;
Program::Program(Program&&) noexcept = default;
Program& Program::operator=(Program&&) noexcept = default;

const Plan& Program::plan() const { return state->plan; }
MemoryUse Program::memoryUse() const { return state->memory.use; }
void Program::onPass(std::function<void(int)> callback) { state->passCallback = std::move(callback); }

Result<std::vector<PassTiming>> Program::timings() const {
    return state->timer ? state->timer->timings() : std::vector<PassTiming>{};
}

void Program::reset() { state->frames.reset(); }

Result<> Program::record(const FrameInputs<Image>& inputs) {
    constexpr const char* recording = "recording a frame";
    if (auto present = state->gl->checkPresent(recording); !present) return present;
    auto recorded = recordFrame(*state, inputs);
    // A context that was lost meanwhile knows no program and no texture, and the timer may have found out.
    if (auto present = recorded ? state->gl->loss.check() : state->gl->checkPresent(recording); !present)
        return present;
    return recorded;
}

Result<unsigned> Program::ownTexture(std::string_view name) const {
    const int index = state->plan.find(name);
    if (index < 0 || state->memory.textureOf[size_t(index)] < 0)
        return Error{ErrorCode::notFound,
                     "the plan has no image of the device's own in use named " + std::string(name)};
    return unsigned(ownTextureOf(*state, index, false));
}

Result<Buffer> Program::ownBuffer(std::string_view name) const {
    const int index = state->plan.find(name);
    const ResourceKind kind = index < 0 ? ResourceKind::input : state->plan.resources[size_t(index)].kind;
    if (kind != ResourceKind::transientBuffer && kind != ResourceKind::persistentBuffer)
        return Error{ErrorCode::notFound,
                     "the plan has no buffer of the device's own named " + std::string(name)};
    return Buffer{state->buffers[size_t(bufferGroupOf(kind))].name(),
                  state->memory.bufferOffsets[size_t(index)],
                  state->plan.resources[size_t(index)].size,
                  {}};
}

static_assert(ProgramDevice<Device, Program, Image>);

} // namespace rebound::opengl
