// SPDX-License-Identifier: MIT
// What a frame consists of: barriers, dispatches, groups. A driver that runs one command after the other
// needs no barrier, so that only a look at the commands tells whether they are there.
#include "sums_technique.hpp"
#include "test_plans.hpp"

#include "lab/host/opengl_buffer.hpp"

namespace rebound::test {
namespace {

using Command = FakeOpenGL::Command;

constexpr GLbitfield fetch = GL_TEXTURE_FETCH_BARRIER_BIT, store = GL_SHADER_IMAGE_ACCESS_BARRIER_BIT;
constexpr GLbitfield host = fetch | store | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT;

std::vector<Command> commandsOf(opengl::Program& program, const FrameInputs<opengl::Image>& inputs) {
    FakeOpenGL::commands.clear();
    const auto recorded = program.record(inputs);
    REQUIRE_MESSAGE(recorded, (recorded ? "" : recorded.error().message));
    return FakeOpenGL::commands;
}

} // namespace

TEST_CASE("OpenGL: a barrier stands before a pass that reads what an earlier one wrote, and after the last") {
    inEachContext([](host::OpenGLContext&) {
        opengl::Program program = compile(createDevice(optionsWithFakes()), copyPlan({20, 5}));
        const CopyFrame frame({20, 5});
        const Command dispatch{0, {3, 1, 1}};
        // The frame before may still read what the first pass writes.
        const std::vector<Command> expected = {{store, {}}, dispatch, {fetch, {}}, dispatch, {host, {}}};
        for (int run = 0; run < 2; ++run) CHECK(commandsOf(program, frame.inputs()) == expected);
        program.onPass([](int) {});
        CHECK(commandsOf(program, frame.inputs()) ==
              std::vector<Command>{
                  {store, {}}, dispatch, {host, {}}, {fetch, {}}, dispatch, {host, {}}, {host, {}}});
    });
}

TEST_CASE("OpenGL: buffers that kernels write have barriers of their own, and items groups of 64") {
    inEachContext([](host::OpenGLContext&) {
        constexpr Extent2D extent{37, 11};
        const Plan plan = planSums(extent);
        opengl::Program program = compile(createDevice(optionsWithFakes()), plan);
        const HostTextures textures(plan, {{"picture", Picture(extent, 1)}}, Format::rgba32f);
        const host::OpenGLBuffer weights(weightCount * 4), report(37 * 11 * 4);
        FrameInputs<opengl::Image> inputs = textures.inputs();
        inputs.buffers = {{"weights", {weights.name(), 0, weightCount * 4, {}}},
                          {"report", {report.name(), 0, 37 * 11 * 4, {}}}};
        constexpr GLbitfield storage = GL_SHADER_STORAGE_BARRIER_BIT;
        const Command pixels{0, {5, 2, 1}}, items{0, {7, 1, 1}};
        // Twice a buffer is read that the pass before has written, and twice an image; the first barrier waits for the
        // frame before.
        const std::vector<Command> expected = {{store | storage, {}},
                                               pixels,
                                               {storage, {}},
                                               items,
                                               {storage, {}},
                                               items,
                                               {fetch, {}},
                                               pixels,
                                               {fetch, {}},
                                               pixels,
                                               {host | storage | GL_BUFFER_UPDATE_BARRIER_BIT, {}}};
        for (int run = 0; run < 2; ++run) CHECK(commandsOf(program, inputs) == expected);
    });
}

TEST_CASE("OpenGL: a barrier stands before a pass that overwrites a texture in use, and nowhere else") {
    inEachContext([](host::OpenGLContext&) {
        const Plan plan = sharingPlan();
        opengl::Program program = compile(createDevice(optionsWithFakes()), plan);
        const HostTextures images(plan, {{"host", numbered({16, 8})}}, Format::rgba32f);
        const Command dispatch{0, {2, 1, 1}};
        const std::vector<Command> expected = {
            {store, {}}, dispatch, // to a
            {fetch, {}}, dispatch, // read a
            {store, {}}, dispatch, // to b, which is a's texture
            {fetch, {}}, dispatch, // read b
            {store, {}}, dispatch, // to c or d, which is that texture as well
            dispatch,              // to the other of the two
            {fetch, {}}, dispatch, // read c, and d may be read from here on too
            {store, {}}, dispatch, // read d into the image that the pass before wrote
            {host, {}},
        };
        CHECK(commandsOf(program, images.inputs()) == expected);
    });
}

TEST_CASE("OpenGL: objects have labels, passes are groups") {
    inEachContext([](host::OpenGLContext&) {
        opengl::Program program = compile(createDevice(), copyPlan({20, 5}));
        char label[100] = {};
        glGetObjectLabel(GL_TEXTURE, *program.ownTexture("source"), sizeof label, nullptr, label);
        CHECK(std::string(label) == "test: source");

        static std::vector<std::string> groups;
        groups.clear();
        glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "probe");
        glPopDebugGroup();
        const auto collect = [](GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text,
                                const void*) {
            if (type == GL_DEBUG_TYPE_PUSH_GROUP) groups.emplace_back(text);
        };
        void* user = nullptr;
        void* callback = nullptr;
        glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &callback);
        glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &user);
        glDebugMessageCallback(collect, nullptr);
        const CopyFrame frame({20, 5});
        REQUIRE(program.record(frame.inputs()));
        glDebugMessageCallback(reinterpret_cast<GLDEBUGPROC>(callback), user);
        CHECK(groups == std::vector<std::string>{"test", "copy", "access"});
    });
}

} // namespace rebound::test
