// SPDX-License-Identifier: MIT
// What an OpenGL device refuses: contexts, plans and frames.
#include "test_plans.hpp"

#include <functional>

namespace rebound::test {
namespace {

template <class T>
void checkRefused(const Result<T>& result, ErrorCode code, const std::string& part) {
    CAPTURE(part);
    REQUIRE_FALSE(result);
    CHECK(result.error().code == code);
    INFO(result.error().message);
    CHECK(result.error().message.find(part) != std::string::npos);
    CHECK(result.error().message.find('\n') == std::string::npos);
}

void checkRefusedPlan(const opengl::Device& device, const std::string& part, ErrorCode code,
                      const std::function<void(Plan&)>& spoil) {
    Plan plan = copyPlan({20, 5});
    spoil(plan);
    checkRefused(device.compile(plan), code, part);
    CHECK(glGetError() == GL_NO_ERROR);
}

using Inputs = FrameInputs<opengl::Image>;

void checkRefusedFrame(const opengl::Device& device, const std::string& part,
                       const std::function<void(Inputs&)>& spoil) {
    opengl::Program program = compile(device, copyPlan({20, 5}));
    const CopyFrame frame({20, 5});
    Inputs inputs = frame.inputs();
    spoil(inputs);
    checkRefused(program.record(inputs), ErrorCode::invalidArgument, part);
    CHECK(glGetError() == GL_NO_ERROR);
    CHECK(frame.isUntouched());
}

// A texture made in a way that none of the host's helpers has.
struct OddTexture {
    GLuint name = 0;
    explicit OddTexture(const std::function<void()>& allocate, GLenum target = GL_TEXTURE_2D) {
        glGenTextures(1, &name);
        glBindTexture(target, name);
        allocate();
        glBindTexture(target, 0);
    }
    OddTexture(const OddTexture&) = delete;
    OddTexture& operator=(const OddTexture&) = delete;
    ~OddTexture() { glDeleteTextures(1, &name); }
};

std::function<void()> storage(GLenum format, GLsizei levels = 1) {
    return [format, levels] { glTexStorage2D(GL_TEXTURE_2D, levels, format, 20, 5); };
}

} // namespace

TEST_CASE("OpenGL devices are refused without a loader or a context") {
    checkRefused(opengl::Device::create({}), ErrorCode::invalidArgument, "options.loader is empty");
    inEachContext([](host::OpenGLContext& context) {
        host::OpenGLContext::makeNoneCurrent();
        checkRefused(opengl::Device::create(optionsWithTestShaders()), ErrorCode::invalidArgument,
                     "no OpenGL context is current");
        REQUIRE(context.makeCurrent());
    });
}

TEST_CASE("OpenGL devices are refused in contexts that are too old, and for functions that are missing") {
    inEachContext([](host::OpenGLContext&) {
        opengl::DeviceOptions options = optionsWithFakes();
        for (const auto& [version, said] :
             std::map<std::string, std::string>{{"4.2.0 Someone", "OpenGL 4.2;"},
                                                {"2.1", "OpenGL 2.1;"},
                                                {"OpenGL ES 3.0 Someone", "OpenGL ES 3.0;"},
                                                {"OpenGL ES-CM 1.1", "OpenGL 4.3 or OpenGL ES 3.1"},
                                                {"", "OpenGL 4.3 or OpenGL ES 3.1"}}) {
            FakeOpenGL::version = version.c_str();
            checkRefused(opengl::Device::create(options), ErrorCode::unsupported, said);
        }
        FakeOpenGL::version = nullptr;
        for (const char* function :
             {"glGetString", "glDispatchCompute", "glBindImageTexture", "glGetError"}) {
            FakeOpenGL::missing = {function};
            checkRefused(opengl::Device::create(options), ErrorCode::unsupported,
                         std::string("gives no ") + function);
        }
        // What only some contexts have may be missing.
        FakeOpenGL::missing = {"glPushDebugGroup", "glPushDebugGroupKHR", "glObjectLabel",
                               "glObjectLabelKHR", "glPopDebugGroup",     "glPopDebugGroupKHR",
                               "glQueryCounter",   "glQueryCounterEXT",   "glGetGraphicsResetStatus"};
        options.timings = true;
        const opengl::Device device = createDevice(options);
        CHECK_FALSE(device.hasTimings());
        opengl::Program program = compile(device, copyPlan({20, 5}));
        const CopyFrame frame({20, 5});
        REQUIRE(program.record(frame.inputs()));
        CHECK(frame.isRight());
        CHECK(program.timings()->empty());
    });
}

TEST_CASE("plans that an OpenGL device refuses") {
    using enum ErrorCode;
    inEachContext([](host::OpenGLContext&) {
        const opengl::Device device = createDevice();
        checkRefusedPlan(device, "runs no/such", notFound, [](Plan& p) { p.passes[0].kernel = "no/such"; });
        checkRefusedPlan(device, "slot 9", invalidArgument,
                         [](Plan& p) { p.passes[0].bindings[0].slot = 9; });
        checkRefusedPlan(device, "slot 99", invalidArgument,
                         [](Plan& p) { p.passes[0].bindings[0].slot = 99; });
        checkRefusedPlan(device, "leaves slot 1 of access unbound", invalidArgument,
                         [](Plan& p) { p.passes[1].bindings.erase(p.passes[1].bindings.begin() + 1); });
        checkRefusedPlan(device, "feature 0 of access to " + std::to_string(accessCount), invalidArgument,
                         [](Plan& p) { p.passes[1].features = {accessCount}; });
        checkRefusedPlan(device, "which does not take it", invalidArgument,
                         [](Plan& p) { p.passes[1].bindings[0].resource = 0; });
        checkRefusedPlan(device, "size is not that of the pass's grid", invalidArgument, [](Plan& p) {
            p.passes[0].grid = {19, 5};
        });
        checkRefusedPlan(device, "used twice", invalidArgument, [](Plan& p) { p.passes[1].label = "copy"; });
        checkRefusedPlan(device, "which is rgba16f, to slot 1 of copy, which is rgba32f", invalidArgument,
                         [](Plan& p) { p.resources[1].format = Format::rgba16f; });
        // Sizes are the driver's to say.
        checkRefusedPlan(device, "has 15 bytes, to slot 2 of copy, which takes 16", invalidArgument,
                         [](Plan& p) { p.resources[3].size = 15; });
        checkRefusedPlan(device, "which takes 32", invalidArgument, [](Plan& p) {
            p.resources[4] = bufferResource("constants", std::vector{GridConstants{}});
        });
    });
}

TEST_CASE("plans that exceed a context's limits") {
    using enum ErrorCode;
    inEachContext([](host::OpenGLContext&) {
        const opengl::DeviceOptions options = optionsWithFakes();
        for (const auto& [limit, said] : std::map<GLenum, std::pair<int, std::string>>{
                 {GL_MAX_TEXTURE_SIZE, {16, "host has a side of 20 texels; this context allows 16"}},
                 {GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS, {1, "access uses 2 textures; this context allows 1"}},
                 {GL_MAX_IMAGE_UNITS, {0, "copy uses 1 images to write; this context allows 0"}},
                 {GL_MAX_COMPUTE_IMAGE_UNIFORMS, {0, "copy uses 1 images to write; this context allows 0"}},
                 {GL_MAX_COMPUTE_UNIFORM_BLOCKS, {0, "copy uses 1 uniform blocks; this context allows 0"}}}) {
            FakeOpenGL::integers = {{limit, said.first}};
            checkRefused(createDevice(options).compile(copyPlan({20, 5})), unsupported, said.second);
        }
        FakeOpenGL::integers = {{GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, 0}};
        Picture start({3, 1}, 1);
        const LanguageConstants k{{3, 1, 1, 0}, {}};
        checkRefused(
            createDevice(options).compile(planOf(
                {"language", {}, {{0, &start}}, {{2, bytesOf(k)}, {3, bytesOf(TableEntry{})}}, 1, {3, 1}})),
            unsupported, "language uses 1 storage blocks; this context allows 0");
        FakeOpenGL::integers.clear();
        Plan plan = copyPlan({20, 5});
        plan.resources[4] = bufferResource("constants", std::vector<std::byte>(1 << 28));
        checkRefused(createDevice(options).compile(plan), unsupported, "constants has 268435456 bytes");
    });
}

TEST_CASE("shaders that the driver refuses: its words, in one line") {
    Shader broken = *testShaders()[0];
    for (const Shader* s : testShaders())
        if (s->name == "copy") broken = *s;
    const std::string wrong = "void main() { this is no GLSL; }\n";
    broken.glsl = wrong;
    inEachContext([&](host::OpenGLContext& context) {
        const Shader* const table[] = {&broken};
        opengl::DeviceOptions options = optionsWithFakes();
        options.moreShaders.insert(options.moreShaders.begin(), table);
        const auto refused = createDevice(options).compile(copyPlan({20, 5}));
        checkRefused(refused, ErrorCode::unsupported, "the driver does not compile copy: ");
        CHECK(refused.error().message.size() > std::string("the driver does not compile copy: ").size() + 5);
        CHECK(FakeOpenGL::live.empty());
        // A driver may say the same in its debug output.
        context.takeMessages();
    });
}

TEST_CASE("memory that is short, and errors that the host has left") {
    inEachContext([](host::OpenGLContext& context) {
        const opengl::Device device = createDevice(optionsWithFakes());
        FakeOpenGL::memoryIsShort = true;
        checkRefused(device.compile(copyPlan({20, 5})), ErrorCode::outOfMemory,
                     "the plan needs " + std::to_string(device.memoryUse(copyPlan({20, 5}))->total()) +
                         " bytes");
        CHECK(FakeOpenGL::live.empty());
        FakeOpenGL::memoryIsShort = false;

        const CopyFrame frame({20, 5});
        glEnable(GL_TEXTURE_2D + 12345);
        checkRefused(device.compile(copyPlan({20, 5})), ErrorCode::invalidArgument,
                     "GL_INVALID_ENUM was pending before compile()");
        CHECK(glGetError() == GL_NO_ERROR);
        opengl::Program program = compile(device, copyPlan({20, 5}));
        // A frame neither minds nor clears it.
        glEnable(GL_TEXTURE_2D + 12345);
        CHECK(program.record(frame.inputs()));
        CHECK(glGetError() == GL_INVALID_ENUM);
        CHECK(frame.isRight());
        CHECK(context.takeMessages().size() >= 2); // the two that were asked for
    });
}

TEST_CASE("frames that an OpenGL device refuses, writing nothing") {
    inEachContext([](host::OpenGLContext&) {
        const opengl::Device device = createDevice();
        checkRefusedFrame(device, "host is missing", [](Inputs& i) { i.images.erase(i.images.begin()); });
        checkRefusedFrame(device, "result is missing", [](Inputs& i) { i.images.pop_back(); });
        checkRefusedFrame(device, "grid is missing", [](Inputs& i) { i.constants.clear(); });
        checkRefusedFrame(device, "15 bytes; 16 were expected",
                          [](Inputs& i) { i.constants[0].data.pop_back(); });
        checkRefusedFrame(device, "host is given twice", [](Inputs& i) { i.images.push_back(i.images[0]); });
        checkRefusedFrame(device, "named other", [](Inputs& i) { i.images.push_back({"other", {1}}); });
        checkRefusedFrame(device, "host is texture 0", [](Inputs& i) { i.images[0].image.texture = 0; });
        checkRefusedFrame(device, "host, texture 4000000, does not exist",
                          [](Inputs& i) { i.images[0].image.texture = 4000000; });
        checkRefusedFrame(device, "are both texture",
                          [](Inputs& i) { i.images[0].image = i.images[1].image; });
        for (size_t which : {size_t(0), size_t(1)}) {
            const host::OpenGLTexture small(Format::rgba32f, Extent2D{20, 4});
            checkRefusedFrame(device, "is 20x4; 20x5 was expected",
                              [&](Inputs& i) { i.images[which].image.texture = small.name(); });
            const OddTexture empty([] {});
            checkRefusedFrame(device, "is 0x0; 20x5 was expected",
                              [&](Inputs& i) { i.images[which].image.texture = empty.name; });
        }
        GLuint deleted = 0;
        {
            const host::OpenGLTexture texture(Format::rgba32f, Extent2D{20, 5});
            deleted = texture.name();
        }
        checkRefusedFrame(device, "has been deleted",
                          [&](Inputs& i) { i.images[1].image.texture = deleted; });
    });
}

TEST_CASE("textures of formats that a frame cannot use") {
    inEachContext([](host::OpenGLContext&) {
        const opengl::Device device = createDevice();
        const bool es = device.isEs();
        const auto refuseInput = [&](const std::string& part, const OddTexture& texture) {
            checkRefusedFrame(device, part, [&](Inputs& i) { i.images[0].image.texture = texture.name; });
        };
        const auto refuseOutput = [&](const std::string& part, const OddTexture& texture) {
            checkRefusedFrame(device, part, [&](Inputs& i) { i.images[1].image.texture = texture.name; });
        };
        refuseInput("host has 2 channels; 4 to 4 were expected", OddTexture(storage(GL_RG16F)));
        refuseInput("host has 3 channels", OddTexture(storage(GL_R11F_G11F_B10F)));
        refuseInput("host has 1 channels", OddTexture(storage(GL_DEPTH_COMPONENT32F)));
        refuseInput("internal format 0x8D70, holds integers", OddTexture(storage(GL_RGBA32UI)));
        refuseInput("internal format 0x8D8E, holds integers", OddTexture(storage(GL_RGBA8I)));
        refuseInput("holds integers", OddTexture([] {
                        storage(GL_DEPTH24_STENCIL8)();
                        glTexParameteri(GL_TEXTURE_2D, GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
                    }));
        refuseInput("host has the base level 1; 0 was expected", OddTexture([] {
                        storage(GL_RGBA32F, 3)();
                        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 1);
                    }));
        refuseOutput("internal format 0x881A; rgba32f (0x8814) was expected",
                     OddTexture(storage(GL_RGBA16F)));
        refuseOutput("internal format 0x8058; rgba32f", OddTexture(storage(GL_RGBA8)));
        if (es)
            refuseOutput("result is mutable; OpenGL ES writes to textures made by glTexStorage2D",
                         OddTexture([] {
                             glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 20, 5, 0, GL_RGBA, GL_FLOAT, nullptr);
                         }));
    });
}

TEST_CASE("textures of other targets are refused, and the driver's complaint is taken back") {
    inEachContext([](host::OpenGLContext& context) {
        const opengl::Device device = createDevice();
        const OddTexture array([] { glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_RGBA32F, 20, 5, 2); },
                               GL_TEXTURE_2D_ARRAY);
        const OddTexture cube([] { glTexStorage2D(GL_TEXTURE_CUBE_MAP, 1, GL_RGBA32F, 20, 20); },
                              GL_TEXTURE_CUBE_MAP);
        for (const OddTexture* texture : {&array, &cube})
            for (size_t which : {size_t(0), size_t(1)})
                checkRefusedFrame(device, "is no GL_TEXTURE_2D",
                                  [&](Inputs& i) { i.images[which].image.texture = texture->name; });
        context.takeMessages(); // that the texture cannot be bound there
    });
}

TEST_CASE("frames are refused where the context is not the program's") {
    inEachContext([](host::OpenGLContext& context) {
        opengl::Program program = compile(createDevice(), copyPlan({20, 5}));
        const CopyFrame frame({20, 5});
        host::OpenGLContext::makeNoneCurrent();
        checkRefused(program.record(frame.inputs()), ErrorCode::invalidArgument,
                     "the current OpenGL context is none");
        auto other = host::OpenGLContext::create(host::OpenGLApi::desktop);
        if (other)
            checkRefused(program.record(frame.inputs()), ErrorCode::invalidArgument,
                         "does not know this program");
        REQUIRE(context.makeCurrent());
        CHECK(program.record(frame.inputs()));
        CHECK(frame.isRight());
    });
}

} // namespace rebound::test
