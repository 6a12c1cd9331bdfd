// SPDX-License-Identifier: MIT
#include "gpu_scene.hpp"

#include <cstddef>

namespace rebound::engine {
namespace {

GLint wrapMode(lab::Wrap wrap) {
    switch (wrap) {
    case lab::Wrap::mirror:
        return GL_MIRRORED_REPEAT;
    case lab::Wrap::clamp:
        return GL_CLAMP_TO_EDGE;
    default:
        return GL_REPEAT;
    }
}

// Row 0, glTF's v = 0, becomes OpenGL's row 0, t = 0: coordinates stay as they are.
Texture makeTexture(GLsizei width, GLsizei height, const uint8_t* rgba, lab::Wrap s, lab::Wrap t) {
    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, width, height);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrapMode(s));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrapMode(t));
    glBindTexture(GL_TEXTURE_2D, 0);
    return Texture(name);
}

} // namespace

Result<GpuScene> GpuScene::create(const lab::Scene& scene) {
    GpuScene result;
    result.addMeshes(sceneDataOf(scene));
    result.addTextures(scene);
    result.lights = lightsOf(scene);
    result.lightBuffer = makeBuffer(GL_SHADER_STORAGE_BUFFER, std::as_bytes(std::span(result.lights.lights)));
    if (auto made = checkErrors("while the scene was loaded"); !made) return made.error();
    return result;
}

void GpuScene::addMeshes(SceneData data) {
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    vertexArray = VertexArray(name);
    glBindVertexArray(name);
    vertices = makeBuffer(GL_ARRAY_BUFFER, std::as_bytes(std::span(data.vertices)));
    indices = makeBuffer(GL_ELEMENT_ARRAY_BUFFER, std::as_bytes(std::span(data.indices)));
    const auto attribute = [](GLuint location, GLint size, size_t offset) {
        glEnableVertexAttribArray(location);
        glVertexAttribFormat(location, size, GL_FLOAT, GL_FALSE, GLuint(offset));
        glVertexAttribBinding(location, 0);
    };
    attribute(0, 3, offsetof(Vertex, position));
    attribute(1, 3, offsetof(Vertex, normal));
    attribute(2, 4, offsetof(Vertex, textureCoordinate)); // and the emission's, which follow
    attribute(3, 4, offsetof(Vertex, color));
    glBindVertexBuffer(0, vertices.name(), 0, sizeof(Vertex));
    glBindVertexArray(0);
    parts = std::move(data.parts);
    constants = std::move(data.materials);
}

void GpuScene::addTextures(const lab::Scene& scene) {
    constexpr uint8_t white[] = {255, 255, 255, 255};
    textures.push_back(makeTexture(1, 1, white, lab::Wrap::repeat, lab::Wrap::repeat));
    for (const lab::Texture& t : scene.textures)
        textures.push_back(makeTexture(t.width, t.height, t.rgba.data(), t.wrapS, t.wrapT));
    const auto nameOf = [&](int texture) {
        return textures[size_t(texture + 1)].name();
    }; // lab::none is -1: white
    for (const lab::Material& m : scene.materials)
        materialTextures.push_back({nameOf(m.baseColorTexture), nameOf(m.emissionTexture)});
}

void GpuScene::set(const Moment& moment) {
    lights = moment.lights;
    moved = moment.offset;
    const auto bytes = std::as_bytes(std::span(lights.lights));
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, lightBuffer.name());
    glBufferData(GL_SHADER_STORAGE_BUFFER, GLsizeiptr(bytes.size()), bytes.data(), GL_STREAM_DRAW);
}

void GpuScene::draw() const {
    glBindVertexArray(vertexArray.name());
    for (const SceneData::Part& part : parts) {
        glActiveTexture(GL_TEXTURE1);
        glBindTexture(GL_TEXTURE_2D, materialTextures[part.material].emission);
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, materialTextures[part.material].baseColor);
        glUniform4fv(0, 1, &constants[part.material].baseColor.x);
        glUniform4fv(1, 1, &constants[part.material].emission.x);
        const glm::vec4 place(part.moves ? moved : glm::vec3(0.0f), 0.0f);
        glUniform4fv(2, 1, &place.x);
        const size_t offset = part.firstIndex * sizeof(uint32_t);
        glDrawElementsBaseVertex(GL_TRIANGLES, GLsizei(part.indexCount), GL_UNSIGNED_INT,
                                 reinterpret_cast<const void*>(offset), part.vertexOffset);
    }
    glBindVertexArray(0);
}

} // namespace rebound::engine
