// SPDX-License-Identifier: MIT
// A context that is lost, at any call: whoever finds out says so, all later calls do too, and everything can
// be destroyed.
#include "lossy_opengl.hpp"
#include "test_plans.hpp"

namespace rebound::test {
namespace {

constexpr Extent2D extent{20, 5};
const std::string ending = ": the OpenGL context is lost, and what was made in it can only be destroyed";

opengl::DeviceOptions lossyOptions() {
    LossyOpenGL::begin();
    opengl::DeviceOptions options = optionsWithTestShaders();
    options.loader = LossyOpenGL::functionNamed;
    options.timings = true;
    return options;
}

// One of these was being done.
template <class T>
void checkLost(const Result<T>& result, std::initializer_list<const char*> doing) {
    REQUIRE_FALSE(result);
    const std::string& message = result.error().message;
    INFO(message);
    CHECK(result.error().code == ErrorCode::deviceLost);
    CHECK(std::any_of(doing.begin(), doing.end(), [&](const char* what) {
        return message.starts_with(std::string(what) + " failed with GL_");
    }));
    CHECK(message.ends_with(ending));
}

// Every call says what the first one said, and none reaches OpenGL.
void checkStaysLost(const opengl::Device& device, opengl::Program* program, const Error& first) {
    const int calls = LossyOpenGL::calls;
    const auto check = [&](const auto& result) {
        REQUIRE_FALSE(result);
        CHECK(result.error().code == first.code);
        CHECK(result.error().message == first.message);
    };
    check(device.compile(copyPlan(extent)));
    check(device.compile(Plan{"invalid", {}, {{"pass", "no/such", {}, {}, {}}}}));
    if (program) {
        check(program->record({}));
        CHECK(program->timings());
    }
    CHECK(LossyOpenGL::calls == calls);
}

} // namespace

TEST_CASE("OpenGL: a context that is lost while a device is made, at any call") {
    inEachContext([](host::OpenGLContext&) {
        int lost = 0;
        for (bool made = false; !made; lost += made ? 0 : 1) {
            const opengl::DeviceOptions options = lossyOptions();
            LossyOpenGL::loseAfter(lost);
            const auto device = opengl::Device::create(options);
            made = bool(device);
            CAPTURE(lost);
            if (!made) checkLost(device, {"creating a device"});
        }
        CHECK(lost > 10); // the version, limits, and the reset status
    });
}

TEST_CASE("OpenGL: a context that is lost while a plan is compiled, at any call") {
    inEachContext([](host::OpenGLContext&) {
        int lost = 0;
        for (bool made = false; !made; lost += made ? 0 : 1) {
            const opengl::Device device = createDevice(lossyOptions());
            LossyOpenGL::loseAfter(lost);
            const auto program = device.compile(copyPlan(extent));
            made = bool(program);
            CAPTURE(lost);
            if (made) continue;
            checkLost(program, {"compiling a plan"});
            checkStaysLost(device, nullptr, program.error());
        }
        CHECK(lost > 50); // shaders, textures, buffers, queries, and the state that is put back
    });
}

TEST_CASE("OpenGL: a context that is lost while a frame is recorded, at any call") {
    inEachContext([](host::OpenGLContext&) {
        const CopyFrame frame(extent);
        int lost = 0;
        for (bool survived = false; !survived; lost += survived ? 0 : 1) {
            const opengl::Device device = createDevice(lossyOptions());
            opengl::Program program = compile(device, copyPlan(extent));
            REQUIRE(program.record(frame.inputs()));
            glFinish();
            const std::vector<PassTiming> before = *program.timings();
            CHECK(before.size() == (device.hasTimings() ? 2 : 0));
            LossyOpenGL::loseAfter(lost);
            auto recorded = program.record(frame.inputs());
            survived = !LossyOpenGL::isLost;
            CAPTURE(lost);
            if (survived) continue;
            // Commands that went nowhere are noticed at the next look: at times, or at the next frame.
            REQUIRE(program.timings()->size() == before.size());
            for (size_t i = 0; i < before.size(); ++i)
                CHECK((*program.timings())[i].milliseconds == before[i].milliseconds);
            if (recorded) recorded = program.record(frame.inputs());
            checkLost(recorded, {"recording a frame", "reading timestamps"});
            checkStaysLost(device, &program, recorded.error());
            glUseProgram(0); // the real context: state was not put back
        }
        CHECK(lost > 50); // textures are looked at, state is kept and put back
    });
}

TEST_CASE("OpenGL: a lost context runs nothing, and others do not know of it") {
    inEachContext([](host::OpenGLContext&) {
        const CopyFrame frame(extent);
        for (const auto& [status, word] : {std::pair<GLenum, std::string>{GL_GUILTY_CONTEXT_RESET, "GUILTY"},
                                           {GL_INNOCENT_CONTEXT_RESET, "INNOCENT"},
                                           {GL_UNKNOWN_CONTEXT_RESET, "UNKNOWN"}}) {
            const opengl::Device device = createDevice(lossyOptions());
            opengl::Program first = compile(device, copyPlan(extent)),
                            second = compile(device, copyPlan(extent));
            LossyOpenGL::reset = status;
            LossyOpenGL::loseAfter(0);
            const auto refused = first.record(frame.inputs());
            REQUIRE_FALSE(refused);
            CHECK(refused.error().message ==
                  "recording a frame failed with GL_" + word + "_CONTEXT_RESET" + ending);
            CHECK(LossyOpenGL::calls == 1); // the reset status was all that was asked
            checkStaysLost(device, &second, refused.error());
            CHECK(frame.isUntouched());
        }
        opengl::Program other = compile(createDevice(), copyPlan(extent));
        CHECK(other.record(frame.inputs()));
        CHECK(frame.isRight());
    });
}

TEST_CASE("OpenGL: a lost context whose reset somebody else has read about, or that tells of none") {
    inEachContext([](host::OpenGLContext&) {
        const CopyFrame frame(extent);
        for (bool tells : {false, true}) {
            const opengl::DeviceOptions options = lossyOptions();
            if (!tells) LossyOpenGL::missing = {"glGetGraphicsResetStatus"};
            const opengl::Device device = createDevice(options);
            opengl::Program program = compile(device, copyPlan(extent));
            LossyOpenGL::reset = GL_NO_ERROR;
            LossyOpenGL::loseAfter(0);
            // glGetError is the host's where frames are recorded.
            const auto recorded = program.record(frame.inputs());
            REQUIRE_FALSE(recorded);
            CHECK(recorded.error().message.find("is lost, or does not know this program") !=
                  std::string::npos);
            const auto compiled = device.compile(copyPlan(extent));
            REQUIRE_FALSE(compiled);
            CHECK(compiled.error().message == "compiling a plan failed with GL_CONTEXT_LOST" + ending);
            checkStaysLost(device, &program, compiled.error());
        }
    });
}

TEST_CASE("OpenGL: the reset status is found by the name that the context has for it") {
    inEachContext([](host::OpenGLContext& context) {
        GLint count = 0;
        glGetIntegerv(GL_NUM_EXTENSIONS, &count);
        std::set<std::string> extensions;
        for (GLint i = 0; i < count; ++i)
            extensions.insert(reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, GLuint(i))));
        const bool es = createDevice().isEs();
        const std::string name = "glGetGraphicsResetStatus";
        const auto asks = [&](const std::string& version) {
            opengl::DeviceOptions options = optionsWithFakes();
            FakeOpenGL::version = version.empty() ? nullptr : version.c_str();
            std::set<std::string> asked;
            options.loader = [&](const char* function) {
                if (std::string_view(function).starts_with(name)) asked.insert(function);
                return FakeOpenGL::functionNamed(function);
            };
            createDevice(options);
            FakeOpenGL::version = nullptr;
            return asked;
        };
        CHECK(asks(es ? "OpenGL ES 3.2" : "4.5") == std::set{name});
        if (!extensions.contains("GL_KHR_robustness")) {
            MESSAGE(context.description() << " has no GL_KHR_robustness: its older name is not asked for");
            return;
        }
        CHECK(asks(es ? "OpenGL ES 3.1" : "4.3") == std::set{name + (es ? "KHR" : "")});
    });
}

} // namespace rebound::test
