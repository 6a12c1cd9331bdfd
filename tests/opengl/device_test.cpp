// SPDX-License-Identifier: MIT
// The OpenGL device: memory, lifetimes, timings, labels, and several contexts.
#include "test_plans.hpp"

#include "rebound/techniques/screen_indirect.hpp"

#include <chrono>
#include <optional>
#include <thread>

namespace rebound::test {
namespace {

Plan indirectPlan(Extent2D extent) {
    auto settings = screenIndirectPreset("half-64", extent);
    REQUIRE(settings);
    auto plan = planScreenIndirect(*settings);
    REQUIRE(plan);
    return *plan;
}

} // namespace

TEST_CASE("OpenGL: transients share textures of one size and format where lifetimes allow") {
    inEachContext([](host::OpenGLContext&) {
        const opengl::Device device = createDevice(optionsWithFakes());
        const Plan plan = sharingPlan();
        opengl::Program program = compile(device, plan);
        CHECK(program.memoryUse().transient == 2 * 16 * 8 * 16);
        CHECK(program.memoryUse().transientUnshared == 4 * 16 * 8 * 16);
        const auto texture = [&](const char* name) { return *program.ownTexture(name); };
        CHECK(texture("a") == texture("b"));
        CHECK(texture("c") != texture("d"));
        CHECK((texture("a") == texture("c") || texture("a") == texture("d")));

        Plan apart = plan;
        apart.resources[4].format = Format::rgba16f;
        CHECK(device.memoryUse(apart)->transient == (2 * 16 + 8) * 16 * 8);
        apart = plan;
        apart.resources[4].extent = {16, 9};
        CHECK(device.memoryUse(apart)->transient == (2 * 8 + 9) * 16 * 16);
    });
}

TEST_CASE("OpenGL: memory use is told before compiling, and is what compiling asks for") {
    inEachContext([](host::OpenGLContext&) {
        const opengl::Device device = createDevice(optionsWithFakes());
        for (const Plan& plan :
             {copyPlan({1, 1}), copyPlan({20, 5}), sharingPlan(), indirectPlan({333, 77})}) {
            FakeOpenGL::textureBytes = FakeOpenGL::bufferBytes = 0;
            const MemoryUse use = *device.memoryUse(plan);
            CHECK(FakeOpenGL::textureBytes + FakeOpenGL::bufferBytes == 0);
            opengl::Program program = compile(device, plan);
            CHECK(FakeOpenGL::textureBytes == use.transient);
            CHECK(FakeOpenGL::bufferBytes == use.buffers);
            CHECK(program.memoryUse().total() == use.total());
            CHECK(use.transient <= use.transientUnshared);
        }
        Plan invalid = copyPlan({20, 5});
        invalid.passes[0].bindings[0].resource = 1 << 20;
        CHECK_FALSE(device.memoryUse(invalid));
    });
}

TEST_CASE("OpenGL: compiling anew at other sizes leaks nothing, and shares programs") {
    inEachContext([](host::OpenGLContext&) {
        opengl::DeviceOptions options = optionsWithFakes();
        options.timings = true;
        {
            const opengl::Device device = createDevice(options);
            CHECK(FakeOpenGL::live.empty());
            opengl::Program program = compile(device, indirectPlan({64, 36}));
            const size_t live = FakeOpenGL::live.size();
            CHECK(live > 10);
            for (int width = 65; width < 80; ++width) program = compile(device, indirectPlan({width, 36}));
            CHECK(FakeOpenGL::live.size() == live);

            const auto programs = [] {
                return std::count_if(FakeOpenGL::live.begin(), FakeOpenGL::live.end(),
                                     [](const auto& object) { return object.first == 'p'; });
            };
            const auto alone = programs();
            const opengl::Program second = compile(device, indirectPlan({200, 100}));
            CHECK(programs() == alone);
            Plan refused = indirectPlan({64, 36});
            refused.resources[size_t(refused.find("camera"))].size = 8;
            const size_t both = FakeOpenGL::live.size();
            CHECK_FALSE(device.compile(refused));
            CHECK(FakeOpenGL::live.size() == both);
        }
        CHECK(FakeOpenGL::live.empty());
    });
}

TEST_CASE("OpenGL: programs outlive their device and the host's plan, and move") {
    inEachContext([](host::OpenGLContext&) {
        std::optional<opengl::Program> program;
        {
            const Plan plan = copyPlan({20, 5});
            program = compile(createDevice(), plan);
        }
        const CopyFrame frame({20, 5});
        CHECK(program->record(frame.inputs()));
        CHECK(frame.isRight());
        opengl::Program moved = *std::move(program);
        program.reset();
        const CopyFrame again({20, 5});
        CHECK(moved.record(again.inputs()));
        CHECK(again.isRight());
        CHECK(moved.plan().passes.size() == 2);
    });
}

TEST_CASE("OpenGL: transients are read from within the callback behind each pass") {
    inEachContext([](host::OpenGLContext&) {
        opengl::Program program = compile(createDevice(), copyPlan({20, 5}));
        const CopyFrame frame({20, 5});
        std::vector<int> passes;
        Picture read;
        program.onPass([&](int pass) {
            passes.push_back(pass);
            if (pass == 0) read = readBack(*program.ownTexture("source"), {20, 5}, 4);
        });
        REQUIRE(program.record(frame.inputs()));
        CHECK(passes == std::vector<int>{0, 1});
        CHECK(sameBits(read, numbered({20, 5})));
        program.onPass({});
        REQUIRE(program.record(frame.inputs()));
        CHECK(passes.size() == 2);
        for (const char* other : {"host", "result", "constants", "nothing", ""}) {
            const auto refused = program.ownTexture(other);
            REQUIRE_FALSE(refused);
            CHECK(refused.error().code == ErrorCode::notFound);
        }
        Plan plan = copyPlan({20, 5});
        plan.add({"unused", ResourceKind::transient, {}, 4, {4000, 4000}, {}, 0});
        opengl::Program other = compile(createDevice(), plan);
        CHECK(other.memoryUse().total() == program.memoryUse().total());
        CHECK_FALSE(other.ownTexture("unused"));
    });
}

TEST_CASE("OpenGL: timings of a finished frame where they were asked for, and none otherwise") {
    inEachContext([](host::OpenGLContext& context) {
        for (bool wanted : {false, true}) {
            opengl::DeviceOptions options = optionsWithTestShaders();
            options.timings = wanted;
            const opengl::Device device = createDevice(options);
            if (wanted && !device.hasTimings()) {
                MESSAGE(context.description() << " has no timestamps: its timings stay empty");
                continue;
            }
            CHECK(device.hasTimings() == wanted);
            opengl::Program program = compile(device, copyPlan({500, 400}));
            CHECK(program.timings()->empty());
            const CopyFrame frame({500, 400});
            // More frames than have queries of their own, without a word to the GPU in between.
            for (int run = 0; run < 12; ++run) REQUIRE(program.record(frame.inputs()));
            glFinish();
            REQUIRE(program.timings()->size() == (wanted ? 2u : 0u));
            if (!wanted) continue;
            CHECK((*program.timings())[0].label == "copy");
            CHECK((*program.timings())[1].label == "access");
            const auto start = std::chrono::steady_clock::now();
            REQUIRE(program.record(frame.inputs()));
            glFinish();
            const std::chrono::duration<double, std::milli> elapsed =
                std::chrono::steady_clock::now() - start;
            double sum = 0.0;
            const std::vector<PassTiming> timings = *program.timings();
            for (const PassTiming& t : timings) {
                CHECK(t.milliseconds >= 0.0);
                sum += t.milliseconds;
            }
            CHECK(sum > 0.0);
            CHECK(sum <= elapsed.count());
        }
    });
}

TEST_CASE("OpenGL: timings never wait for the GPU") {
    inEachContext([](host::OpenGLContext& context) {
        opengl::DeviceOptions options = optionsWithFakes();
        options.timings = true;
        const opengl::Device device = createDevice(options);
        if (!device.hasTimings()) {
            MESSAGE(context.description() << " has no timestamps");
            return;
        }
        opengl::Program program = compile(device, copyPlan({20, 5}));
        const CopyFrame frame({20, 5});
        FakeOpenGL::resultsAreLate = true;
        for (int run = 0; run < 12; ++run) {
            REQUIRE(program.record(frame.inputs()));
            CHECK(program.timings()->empty());
        }
        glFinish();
        CHECK(program.timings()->empty());
        CHECK(FakeOpenGL::resultsRead == 0);
        FakeOpenGL::resultsAreLate = false;
        CHECK(program.timings()->size() == 2);
        // Four frames had queries; each has one before its two passes and one behind each.
        CHECK(FakeOpenGL::resultsRead == 4 * 3);
        REQUIRE(program.record(frame.inputs()));
        glFinish();
        CHECK(program.timings()->size() == 2);
        CHECK(FakeOpenGL::resultsRead == 5 * 3);
    });
}

TEST_CASE("OpenGL: devices in two contexts do not know of each other") {
    auto desktop = host::OpenGLContext::create(host::OpenGLApi::desktop);
    auto es = host::OpenGLContext::create(host::OpenGLApi::es);
    if (!desktop || !es) {
        MESSAGE("skipped: the system has only one of OpenGL and OpenGL ES");
        return;
    }
    struct View {
        host::OpenGLContext& context;
        opengl::Device device;
        std::optional<opengl::Program> program;
        std::optional<CopyFrame> frame;
    };
    std::vector<View> views;
    for (host::OpenGLContext* context : {&*desktop, &*es}) {
        REQUIRE(context->makeCurrent());
        views.push_back({*context, createDevice(), {}, {}});
        views.back().program = compile(views.back().device, copyPlan({20, 5}));
        views.back().frame.emplace(Extent2D{20, 5});
    }
    CHECK_FALSE(views[0].device.isEs());
    CHECK(views[1].device.isEs());
    for (int run = 0; run < 4; ++run) {
        View& view = views[size_t(run % 2)];
        REQUIRE(view.context.makeCurrent());
        CHECK(view.program->record(view.frame->inputs()));
        CHECK(view.frame->isRight());
    }
    for (View& view : views) {
        REQUIRE(view.context.makeCurrent());
        checkQuiet(view.context);
        view.program.reset();
        view.frame.reset();
        checkQuiet(view.context);
    }
}

} // namespace rebound::test
