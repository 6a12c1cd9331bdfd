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
    if (state.memory.frameConstants == 0) return;
    std::vector<std::byte> bytes(state.memory.frameConstants);
    for (size_t i = 0; i < inputs.constants.size(); ++i)
        if (inputs.constants[i])
            std::memcpy(bytes.data() + state.memory.bufferOffsets[i], inputs.constants[i],
                        state.plan.resources[i].size);
    state.gl->BindBuffer(GL_UNIFORM_BUFFER, state.frameConstants.name());
    state.gl->BufferData(GL_UNIFORM_BUFFER, GLsizeiptr(bytes.size()), bytes.data(), GL_STREAM_DRAW);
}

GLuint textureOf(const Program::State& state, ResourceIndex resource, const Inputs& inputs) {
    if (const Image* image = inputs.images[size_t(resource)]) return image->texture;
    return state.textures[size_t(state.memory.textureOf[size_t(resource)])].name();
}

void bindBuffer(const Program::State& state, GLenum target, const CompiledPass::Slot& slot) {
    const Resource& r = state.plan.resources[size_t(slot.resource)];
    const Object& buffer = r.kind == ResourceKind::buffer ? state.buffers : state.frameConstants;
    state.gl->BindBufferRange(target, slot.unit, buffer.name(),
                              GLintptr(state.memory.bufferOffsets[size_t(slot.resource)]),
                              GLsizeiptr(r.size));
}

void bindSlot(const Program::State& state, const CompiledPass::Slot& slot, const Inputs& inputs) {
    const Gl& gl = *state.gl;
    switch (slot.kind) {
    case BindingKind::none:
        break;
    case BindingKind::texture:
    case BindingKind::input:
        gl.ActiveTexture(GL_TEXTURE0 + slot.unit);
        gl.BindTexture(GL_TEXTURE_2D, textureOf(state, slot.resource, inputs));
        gl.BindSampler(slot.unit, state.sampler.name());
        break;
    case BindingKind::image:
    case BindingKind::output:
        gl.BindImageTexture(slot.unit, textureOf(state, slot.resource, inputs), 0, GL_FALSE, 0, GL_WRITE_ONLY,
                            internalFormat(slot.format));
        break;
    case BindingKind::buffer:
        bindBuffer(state, GL_SHADER_STORAGE_BUFFER, slot);
        break;
    case BindingKind::constants:
        bindBuffer(state, GL_UNIFORM_BUFFER, slot);
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

    const DebugGroup group(gl, state.plan.technique);
    uploadConstants(state, *resolved);
    if (state.timer) state.timer->beginFrame();
    for (size_t i = 0; i < state.passes.size(); ++i) {
        runPass(state, i, *resolved);
        if (state.timer) state.timer->endPass();
        if (state.passCallback) {
            gl.MemoryBarrier(barrierForHost);
            state.passCallback(int(i));
        }
    }
    if (state.timer) state.timer->endFrame();
    gl.MemoryBarrier(barrierForHost);
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

const std::vector<PassTiming>& Program::timings() const {
    static const std::vector<PassTiming> none;
    return state->timer ? state->timer->timings() : none;
}

Result<> Program::record(const FrameInputs<Image>& inputs) {
    constexpr const char* recording = "recording a frame";
    if (auto present = state->gl->checkPresent(recording); !present) return present;
    auto recorded = recordFrame(*state, inputs);
    // A context that was lost meanwhile knows no program and no texture, and the timer may have found out.
    if (auto present = recorded ? state->gl->loss.check() : state->gl->checkPresent(recording); !present)
        return present;
    return recorded;
}

Result<unsigned> Program::transientTexture(std::string_view name) const {
    const int index = state->plan.find(name);
    if (index < 0 || state->plan.resources[size_t(index)].kind != ResourceKind::transient)
        return Error{ErrorCode::notFound, "the plan has no transient named " + std::string(name)};
    const int texture = state->memory.textureOf[size_t(index)];
    if (texture < 0)
        return Error{ErrorCode::notFound, "no pass of the plan uses the transient " + std::string(name)};
    return unsigned(state->textures[size_t(texture)].name());
}

} // namespace rebound::opengl
