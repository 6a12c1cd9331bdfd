// SPDX-License-Identifier: MIT
#include "image_check.hpp"
#include "program_state.hpp"

#include "rebound/detail/shader_check.hpp"

#include <algorithm>
#include <cstring>

namespace rebound::opengl {

namespace {

constexpr const char* compiling = "compiling a plan";
constexpr const char* creatingBuffer = "creating a buffer";

Error exceeds(const std::string& what, int64_t value, const char* unit, int64_t limit) {
    return {ErrorCode::unsupported,
            what + std::to_string(value) + " " + unit + "; this context allows " + std::to_string(limit)};
}

Result<> checkResources(const Plan& plan, const Limits& limits) {
    for (const Resource& r : plan.resources) {
        const int side = std::max(r.extent.width, r.extent.height);
        if (isImage(r.kind) && side > limits.textureSize)
            return exceeds("plan.resources: " + r.name + " has a side of ", side, "texels",
                           limits.textureSize);
    }
    return {};
}

Result<> checkCounts(const Shader& shader, const Limits& limits) {
    const UnitCounts counts = unitsOf(shader.info).counts;
    const std::string what = "the kernel " + std::string(shader.name) + " uses ";
    if (counts.textures > limits.textures) return exceeds(what, counts.textures, "textures", limits.textures);
    if (counts.images > limits.images) return exceeds(what, counts.images, "images to write", limits.images);
    if (counts.uniformBlocks > limits.uniformBlocks)
        return exceeds(what, counts.uniformBlocks, "uniform blocks", limits.uniformBlocks);
    if (counts.storageBlocks > limits.storageBlocks)
        return exceeds(what, counts.storageBlocks, "storage blocks", limits.storageBlocks);
    return {};
}

Result<> checkBlocks(const Plan& plan, const Pass& pass, const Shader& shader, const Limits& limits) {
    for (const PassBinding& b : pass.bindings) {
        const Resource& r = plan.resources[size_t(b.resource)];
        const BindingKind kind = shader.info.kinds[b.slot];
        const int64_t limit = kind == BindingKind::constants ? limits.uniformBlock : limits.storageBlock;
        if (!isImage(r.kind) && int64_t(r.size) > limit)
            return exceeds("plan.resources: " + r.name + " has ", int64_t(r.size), "bytes", limit);
    }
    return {};
}

// Images that are written have the format that the kernel declares: a transient is given the plan's, an
// output is checked in each frame.
Result<> checkFormats(const Plan& plan, const Pass& pass, const Shader& shader,
                      std::vector<std::optional<Format>>& outputs) {
    for (const PassBinding& b : pass.bindings) {
        const Resource& r = plan.resources[size_t(b.resource)];
        if (b.access != Access::write || !isImage(r.kind)) continue;
        const Format declared = shader.info.formats[b.slot];
        std::optional<Format>& output = outputs[size_t(b.resource)];
        if (!output) output = r.kind == ResourceKind::output ? declared : r.format;
        if (declared != *output)
            return invalidArgument("plan.passes: " + pass.label + " writes " + r.name + ", which is " +
                                   name(*output) + ", to slot " + std::to_string(b.slot) + " of " +
                                   std::string(shader.name) + ", which is " + name(declared));
    }
    return {};
}

// All that can be said without asking OpenGL.
Result<> checkPlan(const Device::Shared& device, const Plan& plan, Program::State& state) {
    if (auto valid = validate(plan); !valid) return valid.error();
    const Limits& limits = device.gl->limits;
    if (auto valid = checkResources(plan, limits); !valid) return valid.error();
    std::vector<std::optional<Format>> formats(plan.resources.size());
    for (const Pass& pass : plan.passes) {
        const Shader* shader = detail::findShader(device.shaders, pass.kernel);
        if (!shader) return detail::unknownKernel(pass);
        if (auto valid = detail::checkKernelUse(plan, pass, shader->name, shader->info); !valid)
            return valid.error();
        if (auto valid = checkCounts(*shader, limits); !valid) return valid.error();
        if (auto valid = checkBlocks(plan, pass, *shader, limits); !valid) return valid.error();
        if (auto valid = checkFormats(plan, pass, *shader, formats); !valid) return valid.error();
    }
    for (size_t i = 0; i < formats.size(); ++i)
        state.outputFormats.push_back(formats[i].value_or(plan.resources[i].format));
    return {};
}

Result<> checkContext(const Gl& gl, const char* doing, const char* call) {
    const bool isCurrent = gl.GetString(GL_VERSION) != nullptr;
    // Reading an error clears it: so it is handed on, for the host to know.
    const GLenum error = gl.GetError();
    if (error == GL_CONTEXT_LOST) return gl.lost(doing, error);
    if (!isCurrent)
        return invalidArgument(
            "no OpenGL context is current; the one that the device was created in was expected");
    if (error != GL_NO_ERROR)
        return invalidArgument(errorName(error) + " was pending before " + call + "; no error was expected");
    return {};
}

Result<CompiledPass> compilePass(const Device::Shared& device, const Pass& pass, GLbitfield barrier) {
    const Shader* shader = detail::findShader(device.shaders, pass.kernel);
    std::weak_ptr<const ShaderProgram>& known = device.built[{shader, pass.features}];
    CompiledPass compiled;
    compiled.program = known.lock();
    if (!compiled.program) {
        auto built = buildProgram(device.gl, *shader, pass.features);
        if (!built) return built.error();
        known = compiled.program = *built;
    }
    for (const PassBinding& b : pass.bindings)
        compiled.slots.push_back({shader->info.kinds[b.slot], GLuint(compiled.program->units.bySlot[b.slot]),
                                  b.resource, shader->info.formats[b.slot], b.access});
    compiled.barrierBefore = barrier;
    const GroupCounts groups = groupCounts(pass);
    compiled.groups[0] = groups.x;
    compiled.groups[1] = groups.y;
    return compiled;
}

void createTextures(Program::State& state) {
    const Gl& gl = *state.gl;
    gl.ActiveTexture(GL_TEXTURE0);
    for (const TextureUse& use : state.memory.textures) {
        const Object& texture = state.textures.emplace_back(state.gl, ObjectKind::texture);
        gl.BindTexture(GL_TEXTURE_2D, texture.name());
        gl.TexStorage2D(GL_TEXTURE_2D, 1, internalFormat(use.format), use.extent.width, use.extent.height);
        gl.label(GL_TEXTURE, texture.name(), state.plan.technique + ": " + use.label);
    }
    state.sampler = Object(state.gl, ObjectKind::sampler);
    gl.SamplerParameteri(state.sampler.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.SamplerParameteri(state.sampler.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.SamplerParameteri(state.sampler.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.SamplerParameteri(state.sampler.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void createBuffers(Program::State& state) {
    constexpr std::array<std::pair<const char*, GLenum>, 4> kinds{
        std::pair{"constants and tables", GL_STATIC_DRAW},
        {"frame constants", GL_STREAM_DRAW},
        {"transient buffers", GL_DYNAMIC_COPY},
        {"persistent buffers", GL_DYNAMIC_COPY}};
    const Gl& gl = *state.gl;
    for (size_t group = 0; group < kinds.size(); ++group) {
        const size_t size = state.memory.bufferSizes[group];
        if (size == 0) continue;
        std::vector<std::byte> bytes;
        if (group == size_t(BufferGroup::tables)) {
            bytes.resize(size);
            for (size_t i = 0; i < state.plan.resources.size(); ++i)
                if (const Resource& r = state.plan.resources[i]; r.kind == ResourceKind::buffer)
                    std::memcpy(bytes.data() + state.memory.bufferOffsets[i], r.data->data(), r.size);
        }
        state.buffers[group] = Object(state.gl, ObjectKind::buffer);
        gl.BindBuffer(GL_UNIFORM_BUFFER, state.buffers[group].name());
        gl.BufferData(GL_UNIFORM_BUFFER, GLsizeiptr(size), bytes.empty() ? nullptr : bytes.data(),
                      kinds[group].second);
        gl.label(GL_BUFFER, state.buffers[group].name(), state.plan.technique + ": " + kinds[group].first);
    }
}

Result<> checkAllocations(const Gl& gl, const std::string& what, size_t bytes) {
    const GLenum error = gl.GetError();
    if (error == GL_NO_ERROR) return {};
    if (error == GL_CONTEXT_LOST) return gl.lost(compiling, error);
    if (error == GL_OUT_OF_MEMORY)
        return Error{ErrorCode::outOfMemory,
                     what + " needs " + std::to_string(bytes) + " bytes, which OpenGL could not allocate"};
    return Error{ErrorCode::unsupported, "OpenGL refuses what " + what + " needs: " + errorName(error)};
}

Result<Program> compilePlan(const std::shared_ptr<const Device::Shared>& shared, const Plan& plan) {
    auto state = std::make_unique<Program::State>();
    state->device = shared;
    state->gl = shared->gl;
    const Gl& gl = *shared->gl;
    if (auto valid = checkPlan(*shared, plan, *state); !valid) return valid.error();
    if (auto valid = checkContext(gl, compiling, "compile()"); !valid) return valid.error();
    state->plan = plan;
    state->memory = planMemory(plan, gl.limits.alignment);
    const StateGuard guard(gl, {1, 0, 0, 0});
    const std::vector<GLbitfield> barriers = barriersBefore(plan, state->memory);
    state->barrierBehind = barrierForHost(plan);
    state->units.textures = 1; // that images are checked on
    for (size_t i = 0; i < plan.passes.size(); ++i) {
        auto compiled = compilePass(*shared, plan.passes[i], barriers[i]);
        if (!compiled) return compiled.error();
        UnitCounts& most = state->units;
        const UnitCounts& counts = compiled->program->units.counts;
        most.textures = std::max(most.textures, counts.textures);
        most.images = std::max(most.images, counts.images);
        most.uniformBlocks = std::max(most.uniformBlocks, counts.uniformBlocks);
        most.storageBlocks = std::max(most.storageBlocks, counts.storageBlocks);
        state->passes.push_back(std::move(*compiled));
    }
    createTextures(*state);
    createBuffers(*state);
    if (shared->timings) state->timer.emplace(state->gl, plan);
    if (auto allocated = checkAllocations(gl, "the plan", state->memory.use.total()); !allocated)
        return allocated.error();
    return Program(std::move(state));
}

} // namespace

Result<Device> Device::create(const DeviceOptions& options) {
    auto gl = Gl::load(options.loader);
    if (!gl) return gl.error();
    auto shared = std::make_shared<Shared>();
    shared->gl = *gl;
    shared->timings = options.timings && (*gl)->QueryCounter;
    shared->shaders = options.moreShaders;
    shared->shaders.push_back(techniqueShaders());
    Device device;
    device.shared = std::move(shared);
    return device;
}

bool Device::isEs() const { return shared->gl->es; }
bool Device::hasTimings() const { return shared->timings; }

Result<MemoryUse> Device::memoryUse(const Plan& plan) const {
    if (auto valid = validate(plan); !valid) return valid.error();
    return planMemory(plan, shared->gl->limits.alignment).use;
}

Result<Buffer> Device::createBuffer(std::span<const std::byte> data) const {
    const Gl& gl = *shared->gl;
    if (auto present = gl.checkPresent(creatingBuffer); !present) return present.error();
    if (data.empty()) return invalidArgument("data is empty; at least one byte was expected");
    if (int64_t(data.size()) > gl.limits.storageBlock)
        return exceeds("data has ", int64_t(data.size()), "bytes", gl.limits.storageBlock);
    if (auto valid = checkContext(gl, creatingBuffer, "createBuffer()"); !valid) return valid.error();
    const StateGuard guard(gl, {0, 0, 0, 0});
    auto object = std::make_shared<Object>(shared->gl, ObjectKind::buffer);
    gl.BindBuffer(GL_UNIFORM_BUFFER, object->name());
    gl.BufferData(GL_UNIFORM_BUFFER, GLsizeiptr(data.size()), data.data(), GL_STATIC_DRAW);
    if (auto allocated = checkAllocations(gl, "the buffer", data.size()); !allocated)
        return allocated.error();
    return Buffer{object->name(), 0, data.size(), object};
}

Result<Program> Device::compile(const Plan& plan) const {
    if (auto present = shared->gl->checkPresent(compiling); !present) return present.error();
    auto program = compilePlan(shared, plan);
    // A context that was lost meanwhile refuses shaders, or says nothing at all.
    if (auto present = shared->gl->checkPresent(compiling); !present) return present.error();
    return program;
}

} // namespace rebound::opengl
