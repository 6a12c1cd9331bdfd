// SPDX-License-Identifier: MIT
// The host's state is the same before and after every call, however unusual it is.
#include "test_plans.hpp"

#include "rebound/techniques/screen_indirect.hpp"

#include <array>
#include <initializer_list>
#include <map>

namespace rebound::test {
namespace {

using State = std::map<std::string, GLint64>;

void addIntegers(State& state) {
    const std::pair<const char*, GLenum> names[] = {{"program", GL_CURRENT_PROGRAM},
                                                    {"pipeline", GL_PROGRAM_PIPELINE_BINDING},
                                                    {"active texture", GL_ACTIVE_TEXTURE},
                                                    {"uniform buffer", GL_UNIFORM_BUFFER_BINDING},
                                                    {"storage buffer", GL_SHADER_STORAGE_BUFFER_BINDING},
                                                    {"atomic buffer", GL_ATOMIC_COUNTER_BUFFER_BINDING},
                                                    {"indirect buffer", GL_DISPATCH_INDIRECT_BUFFER_BINDING},
                                                    {"array buffer", GL_ARRAY_BUFFER_BINDING},
                                                    {"read buffer", GL_COPY_READ_BUFFER_BINDING},
                                                    {"write buffer", GL_COPY_WRITE_BUFFER_BINDING},
                                                    {"pack buffer", GL_PIXEL_PACK_BUFFER_BINDING},
                                                    {"unpack buffer", GL_PIXEL_UNPACK_BUFFER_BINDING},
                                                    {"unpack alignment", GL_UNPACK_ALIGNMENT},
                                                    {"unpack row length", GL_UNPACK_ROW_LENGTH},
                                                    {"draw framebuffer", GL_DRAW_FRAMEBUFFER_BINDING},
                                                    {"read framebuffer", GL_READ_FRAMEBUFFER_BINDING},
                                                    {"renderbuffer", GL_RENDERBUFFER_BINDING},
                                                    {"vertex array", GL_VERTEX_ARRAY_BINDING},
                                                    {"debug groups", GL_DEBUG_GROUP_STACK_DEPTH}};
    for (const auto& [text, name] : names) {
        GLint value = 0;
        glGetIntegerv(name, &value);
        state[text] = value;
    }
}

void addIndexed(State& state, const std::string& text, GLenum name, GLuint count) {
    for (GLuint i = 0; i < count; ++i) {
        GLint64 value = 0;
        glGetInteger64i_v(name, i, &value);
        state[text + " " + std::to_string(i)] = value;
    }
}

// Everything that may be bound, on more units than any kernel uses.
State currentState() {
    State state;
    addIntegers(state);
    GLint active = 0;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (int unit = 0; unit < 20; ++unit) {
        glActiveTexture(GL_TEXTURE0 + GLenum(unit));
        for (GLenum name : std::initializer_list<GLenum>{GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_ARRAY,
                                                         GL_TEXTURE_BINDING_3D, GL_TEXTURE_BINDING_CUBE_MAP,
                                                         GL_SAMPLER_BINDING}) {
            GLint value = 0;
            glGetIntegerv(name, &value);
            state["texture unit " + std::to_string(unit) + " " + std::to_string(name)] = value;
        }
    }
    glActiveTexture(GLenum(active));
    for (GLenum name : std::initializer_list<GLenum>{GL_IMAGE_BINDING_NAME, GL_IMAGE_BINDING_LEVEL,
                                                     GL_IMAGE_BINDING_LAYERED, GL_IMAGE_BINDING_LAYER,
                                                     GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT})
        addIndexed(state, "image unit " + std::to_string(name), name, 8);
    addIndexed(state, "uniform buffer", GL_UNIFORM_BUFFER_BINDING, 16);
    addIndexed(state, "uniform start", GL_UNIFORM_BUFFER_START, 16);
    addIndexed(state, "uniform size", GL_UNIFORM_BUFFER_SIZE, 16);
    addIndexed(state, "storage buffer", GL_SHADER_STORAGE_BUFFER_BINDING, 8);
    addIndexed(state, "storage start", GL_SHADER_STORAGE_BUFFER_START, 8);
    addIndexed(state, "storage size", GL_SHADER_STORAGE_BUFFER_SIZE, 8);
    return state;
}

void checkUnchanged(const State& before) {
    const State after = currentState();
    for (const auto& [what, value] : before) {
        const std::string& text = what;
        CAPTURE(text);
        CHECK(after.at(text) == value);
    }
}

// A host in the middle of something: every binding differs from the default, and most from each other.
class UnusualHost {
public:
    explicit UnusualHost(bool es) {
        glGenTextures(GLsizei(textures.size()), textures.data());
        for (size_t i = 0; i < textures.size(); ++i) {
            const GLenum target = i % 2 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
            glActiveTexture(GL_TEXTURE0 + GLenum(i));
            glBindTexture(target, textures[i]);
            if (i % 2) glTexStorage3D(target, 3, GL_R32F, 16, 16, 4);
            else glTexStorage2D(target, 3, GL_RGBA8, 16, 16);
        }
        glGenSamplers(GLsizei(samplers.size()), samplers.data());
        for (size_t i = 0; i < samplers.size(); ++i) glBindSampler(GLuint(i), samplers[i]);
        for (GLuint i = 0; i < 4; ++i)
            if (i % 2) glBindImageTexture(i, textures[i], GLint(i % 3), GL_TRUE, 0, GL_READ_ONLY, GL_R32F);
            else
                glBindImageTexture(i, textures[1], 2, GL_FALSE, GLint(i), i ? GL_WRITE_ONLY : GL_READ_ONLY,
                                   GL_R32I);
        bindBuffers();
        program = makeProgram(es);
        glUseProgram(program);
        glGenVertexArrays(1, &vertexArray);
        glBindVertexArray(vertexArray);
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
        glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, textures[0], 0);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glPixelStorei(GL_UNPACK_ROW_LENGTH, 37);
        glActiveTexture(GL_TEXTURE0 + 17);
    }
    UnusualHost(const UnusualHost&) = delete;
    UnusualHost& operator=(const UnusualHost&) = delete;
    ~UnusualHost() {
        glUseProgram(0);
        glDeleteProgram(program);
        glDeleteTextures(GLsizei(textures.size()), textures.data());
        glDeleteSamplers(GLsizei(samplers.size()), samplers.data());
        glDeleteBuffers(GLsizei(buffers.size()), buffers.data());
        glDeleteVertexArrays(1, &vertexArray);
        glDeleteFramebuffers(1, &framebuffer);
    }

private:
    void bindBuffers() {
        glGenBuffers(GLsizei(buffers.size()), buffers.data());
        for (GLuint buffer : buffers) {
            glBindBuffer(GL_COPY_WRITE_BUFFER, buffer);
            glBufferData(GL_COPY_WRITE_BUFFER, 4096, nullptr, GL_STATIC_DRAW);
        }
        for (GLuint i = 0; i < 8; ++i) {
            glBindBufferRange(GL_UNIFORM_BUFFER, i, buffers[i], 256 * GLintptr(i), 64 + 16 * GLsizeiptr(i));
            if (i % 2) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffers[7 - i]);
            else glBindBufferRange(GL_SHADER_STORAGE_BUFFER, i, buffers[7 - i], 512, 1024);
        }
        glBindBuffer(GL_UNIFORM_BUFFER, buffers[8]);
        glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffers[9]);
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffers[7]);
        glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, buffers[6]);
    }
    static GLuint makeProgram(bool es) {
        const std::string source = std::string(es ? "#version 310 es\n" : "#version 430\n") +
                                   "layout(local_size_x = 1) in;\nvoid main() {}\n";
        const char* text = source.c_str();
        const GLuint shader = glCreateShader(GL_COMPUTE_SHADER), linked = glCreateProgram();
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        glAttachShader(linked, shader);
        glLinkProgram(linked);
        glDeleteShader(shader);
        return linked;
    }

    std::array<GLuint, 18> textures{};
    std::array<GLuint, 16> samplers{};
    std::array<GLuint, 10> buffers{};
    GLuint program = 0, vertexArray = 0, framebuffer = 0;
};

// A frame of the technique, whose kernels use more units of each kind than others do.
struct IndirectFrame {
    ScreenIndirectSettings settings;
    Plan plan;
    Pictures pictures;
    std::vector<NamedConstants> constants;

    IndirectFrame() {
        settings.resolution = {40, 30};
        settings.writeIndirect = false; // images in slots up to 8
        auto planned = planScreenIndirect(settings);
        REQUIRE(planned);
        plan = *planned;
        for (const char* image : {"depth", "normal", "radiance", "albedo", "lit"})
            pictures.emplace(image,
                             Picture(settings.resolution, std::string(image) == "depth" ? 1 : 3, 1.0f));
        constants.push_back({"camera", std::vector<std::byte>(sizeof(CameraConstants))});
    }
};

} // namespace

TEST_CASE("a host's state is put back after compile and record, whether they succeed or not") {
    inEachContext([](host::OpenGLContext&) {
        opengl::DeviceOptions options = optionsWithTestShaders();
        options.timings = true;
        const opengl::Device device = createDevice(options);
        const IndirectFrame frame;
        const HostTextures host(frame.plan, frame.pictures, Format::rgba16f);
        const UnusualHost unusual(device.isEs());
        const State before = currentState();
        CHECK(before.at("active texture") == GL_TEXTURE0 + 17);
        CHECK(before.at("uniform start 3") == 768);

        opengl::Program program = compile(device, frame.plan);
        checkUnchanged(before);
        for (int run = 0; run < 3; ++run) {
            REQUIRE(program.record(host.inputs(frame.constants)));
            checkUnchanged(before);
        }
        FrameInputs<opengl::Image> wrong = host.inputs(frame.constants);
        wrong.images.back().image.texture = 0;
        CHECK_FALSE(program.record(wrong));
        checkUnchanged(before);
        Plan refused = frame.plan;
        refused.resources[size_t(refused.find("camera"))].size = 8;
        CHECK_FALSE(device.compile(refused));
        checkUnchanged(before);
        program = compile(device, copyPlan({20, 5}));
        checkUnchanged(before);
    });
}

TEST_CASE("the default state is put back") {
    inEachContext([](host::OpenGLContext&) {
        const opengl::Device device = createDevice();
        const IndirectFrame frame;
        const HostTextures host(frame.plan, frame.pictures, Format::rgba16f);
        const State before = currentState();
        opengl::Program program = compile(device, frame.plan);
        REQUIRE(program.record(host.inputs(frame.constants)));
        checkUnchanged(before);
    });
}

TEST_CASE("a host's query of elapsed time runs on, and its debug groups stay open") {
    inEachContext([](host::OpenGLContext&) {
        opengl::DeviceOptions options = optionsWithTestShaders();
        options.timings = true;
        const opengl::Device device = createDevice(options);
        opengl::Program program = compile(device, copyPlan({20, 5}));
        const CopyFrame frame({20, 5});
        GLuint query = 0;
        glGenQueries(1, &query);
        glBeginQuery(GL_TIME_ELAPSED, query);
        REQUIRE(program.record(frame.inputs()));
        GLint running = 0;
        glGetQueryiv(GL_TIME_ELAPSED, GL_CURRENT_QUERY, &running);
        CHECK(GLuint(running) == query);
        glEndQuery(GL_TIME_ELAPSED);
        glDeleteQueries(1, &query);

        // As many as there may be: Rebound's own are left out.
        GLint most = 0, open = 0;
        glGetIntegerv(GL_MAX_DEBUG_GROUP_STACK_DEPTH, &most);
        glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &open);
        for (int i = open; i < most; ++i) glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "host");
        REQUIRE(program.record(frame.inputs()));
        GLint after = 0;
        glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &after);
        CHECK(after == most);
        for (int i = open; i < most; ++i) glPopDebugGroup();
        CHECK(frame.isRight());
    });
}

TEST_CASE("textures' own sampling parameters do not matter: incomplete, mipmapped, comparing") {
    inEachContext([](host::OpenGLContext&) {
        opengl::Program program = compile(createDevice(), copyPlan({20, 5}));
        const CopyFrame frame({20, 5});
        GLuint texture = 0;
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        // Levels are missing, and the filter wants them.
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 20, 5, 0, GL_RGBA, GL_FLOAT,
                     numbered({20, 5}).values.data());
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glBindTexture(GL_TEXTURE_2D, 0);
        FrameInputs<opengl::Image> inputs = frame.inputs();
        inputs.images[0].image.texture = texture;
        REQUIRE(program.record(inputs));
        CHECK(frame.isRight());
        glDeleteTextures(1, &texture);
    });
}

} // namespace rebound::test
