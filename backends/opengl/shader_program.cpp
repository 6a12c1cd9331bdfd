// SPDX-License-Identifier: MIT
#include "shader_program.hpp"

#include <algorithm>
#include <charconv>

namespace rebound::opengl {
namespace {

// A driver's log in one line.
std::string oneLine(std::string_view log) {
    std::string line;
    for (char c : log)
        if (const bool blank = c == '\0' || c == '\n' || c == '\r' || c == '\t' || c == ' '; !blank)
            line += c;
        else if (!line.empty() && line.back() != ' ') line += ' ';
    while (!line.empty() && line.back() == ' ') line.pop_back();
    return line.empty() ? "(no reason given)" : line;
}

Error refused(const Shader& shader, const char* what, const std::string& log) {
    return {ErrorCode::unsupported, "the driver does not " + std::string(what) + " " +
                                        std::string(shader.name) + ": " + oneLine(log)};
}

Result<> attachShader(const Gl& gl, GLuint program, const Shader& shader, const std::string& source) {
    const GLuint object = gl.CreateShader(GL_COMPUTE_SHADER);
    const char* text = source.c_str();
    gl.ShaderSource(object, 1, &text, nullptr);
    gl.CompileShader(object);
    GLint compiled = 0, length = 0;
    gl.GetShaderiv(object, GL_COMPILE_STATUS, &compiled);
    gl.GetShaderiv(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(compiled ? 0 : size_t(std::max(length, 0)), '\0');
    if (!log.empty()) gl.GetShaderInfoLog(object, GLsizei(log.size()), nullptr, log.data());
    if (compiled) gl.AttachShader(program, object);
    gl.DeleteShader(object); // once its program has gone as well
    if (!compiled) return refused(shader, "compile", log);
    return {};
}

Result<> link(const Gl& gl, GLuint program, const Shader& shader) {
    gl.LinkProgram(program);
    GLint linked = 0, length = 0;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked) return {};
    gl.GetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(size_t(std::max(length, 0)), '\0');
    if (!log.empty()) gl.GetProgramInfoLog(program, GLsizei(log.size()), nullptr, log.data());
    return refused(shader, "link", log);
}

} // namespace

Units unitsOf(const KernelInfo& info) {
    Units units;
    for (int slot = 0; slot < slotCount; ++slot) switch (info.kinds[slot]) {
        case BindingKind::none:
            break;
        case BindingKind::texture:
        case BindingKind::input:
        case BindingKind::uintTexture:
        case BindingKind::uintInput:
            units.bySlot[slot] = units.counts.textures++;
            break;
        case BindingKind::image:
        case BindingKind::output:
            units.bySlot[slot] = units.counts.images++;
            break;
        case BindingKind::buffer:
        case BindingKind::values:
        case BindingKind::outputValues:
            units.bySlot[slot] = units.counts.storageBlocks++;
            break;
        case BindingKind::constants:
            units.bySlot[slot] = units.counts.uniformBlocks++;
            break;
        }
    return units;
}

std::string sourceOf(const Shader& shader, const std::vector<int>& features, bool es) {
    std::string source = es ? "#version 310 es\n" : "#version 430\n";
    for (size_t i = 0; i < size_t(featureCapacity); ++i)
        source += "#define REBOUND_FEATURE_" + std::to_string(i) + " " +
                  std::to_string(i < features.size() ? features[i] : 0) + "\n";
    // ES has no way to change an image's unit after linking, so it is done in the text.
    const Units units = unitsOf(shader.info);
    constexpr std::string_view declaration = "layout(binding = ";
    std::string_view rest = shader.glsl;
    for (size_t at; (at = rest.find(declaration)) != rest.npos;) {
        const size_t number = at + declaration.size();
        int slot = -1;
        const auto [end, error] = std::from_chars(rest.data() + number, rest.data() + rest.size(), slot);
        source += rest.substr(0, number);
        rest.remove_prefix(error == std::errc() ? size_t(end - rest.data()) : number);
        if (error == std::errc())
            source += std::to_string(slot >= 0 && slot < slotCount ? units.bySlot[slot] : slot);
    }
    source += rest;
    return source;
}

Result<std::shared_ptr<const ShaderProgram>>
buildProgram(const std::shared_ptr<const Gl>& gl, const Shader& shader, const std::vector<int>& features) {
    auto built = std::make_shared<ShaderProgram>();
    built->program = Object(gl, ObjectKind::program);
    built->units = unitsOf(shader.info);
    const GLuint name = built->program.name();
    if (auto attached = attachShader(*gl, name, shader, sourceOf(shader, features, gl->es)); !attached)
        return attached.error();
    if (auto linked = link(*gl, name, shader); !linked) return linked.error();
    gl->label(GL_PROGRAM, name, shader.name);
    return std::shared_ptr<const ShaderProgram>(std::move(built));
}

} // namespace rebound::opengl
