// SPDX-License-Identifier: MIT
// Indirect light by OpenGL against the CPU one pixel at a time, which stores 32-bit floats throughout: every
// image of every pass, and the outputs of presets.
#include "opengl_runner.hpp"
#include "test_scene.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::test {
namespace {

// What storing a half float may take off a value, as a share of it: 10 bits follow the leading one, and
// OpenGL leaves rounding to the driver. llvmpipe truncates.
constexpr double halfRounding = 1.0 / 1024;

Plan planOf(const ScreenIndirectSettings& settings) {
    auto plan = planScreenIndirect(settings);
    REQUIRE_MESSAGE(plan, (plan ? "" : plan.error().message));
    return *plan;
}

Frame frameOf(const std::string& preset, const GBufferConventions& conventions, Extent2D extent) {
    auto settings = screenIndirectPreset(preset, extent);
    REQUIRE(settings);
    Frame f = sceneFrame(conventions, extent);
    settings->conventions = conventions;
    settings->ringRadius = 12.0f; // so that pictures as small have several levels of rings
    f.settings = *settings;
    return f;
}

Pictures picturesOf(const Frame& f) {
    return {{"depth", f.depth},
            {"normal", f.normal},
            {"radiance", f.radiance},
            {"albedo", f.albedo},
            {"lit", f.lit}};
}

std::vector<NamedConstants> constantsOf(const Frame& f) {
    auto inputs = screenIndirectInputs<cpu::Image>(f.settings, {f.camera, {}, {}, {}, {}, {}, {}, {}});
    REQUIRE_MESSAGE(inputs, (inputs ? "" : inputs.error().message));
    return inputs->constants;
}

// What OpenGL itself puts into the depth texture, and what the CPU's tests use by default.
std::vector<GBufferConventions> someConventions() {
    GBufferConventions gl;
    gl.depthEncoding = DepthEncoding::device;
    gl.depthRange = DepthRange::minusOneToOne;
    gl.firstRow = FirstRow::bottom;
    gl.normalSpace = NormalSpace::view;
    GBufferConventions orthographic;
    orthographic.projection = Projection::orthographic;
    return {GBufferConventions(), gl, orthographic};
}

// How many times light was rounded to half floats on its way into each image. Surfaces are 32-bit floats, and
// do not depend on light.
std::map<std::string, int> roundings(const Plan& plan) {
    std::map<std::string, int> count;
    for (const Pass& pass : plan.passes) {
        int most = 0;
        for (const PassBinding& b : pass.bindings)
            if (b.access == Access::read)
                most = std::max(most, count[plan.resources[size_t(b.resource)].name]);
        for (const PassBinding& b : pass.bindings)
            if (const Resource& r = plan.resources[size_t(b.resource)]; b.access == Access::write)
                count[r.name] = r.format == Format::rgba32f ? 0 : most + 1;
    }
    return count;
}

// Light is a sum of products without negative terms, so each rounding takes off at most its share of the
// whole.
void checkLight(const Picture& got, const Picture& want, int rounded) {
    const double share = rounded * halfRounding;
    for (int c = 0; c < want.channels; ++c) {
        double error = 0.0, sum = 0.0, excess = 0.0;
        for (size_t i = size_t(c); i < want.values.size(); i += size_t(want.channels)) {
            const double value = std::abs(double(want.values[i]));
            const double apart = std::abs(double(got.values[i]) - double(want.values[i]));
            error += apart;
            sum += value;
            excess = std::max(excess, apart - share * value);
        }
        const double mean = sum * want.channels / double(want.values.size());
        CAPTURE(c);
        CHECK(error <= share * sum);
        // A texel's light may stand away from its surface, by a distance that is rounded as well: where it is
        // seen edge-on, more of it or less may reach a receiver. That moves single pixels by a part of the
        // mean.
        CHECK(excess <= 0.02 * mean);
    }
}

// Geometry is computed in 32-bit floats alike: 1e-5 is a hundred roundings. Where two of four texels are
// alike but for such roundings the reduction may choose the other one, of which there are few.
void checkSurfaces(const Picture& got, const Picture& want) {
    double largest[4] = {};
    for (size_t i = 0; i < want.values.size(); ++i)
        largest[i % 4] = std::max(largest[i % 4], std::abs(double(want.values[i])));
    size_t apart = 0;
    for (size_t i = 0; i < want.values.size(); ++i)
        if (!(std::abs(double(got.values[i]) - double(want.values[i])) <= 1e-5 * largest[i % 4])) ++apart;
    CHECK(double(apart) <= 0.005 * double(want.values.size()));
}

void checkPictures(const Plan& plan, const Pictures& got, const Pictures& want) {
    const auto rounded = roundings(plan);
    REQUIRE(got.size() == want.size());
    for (const auto& [name, image] : want) {
        const std::string& resource = name; // Clang 14 lets no lambda of a check name a structured binding
        const Picture& picture = image;
        CAPTURE(resource);
        REQUIRE(mean(picture) != 0.0);
        if (const int times = rounded.at(resource); times > 0) checkLight(got.at(resource), picture, times);
        else checkSurfaces(got.at(resource), picture);
    }
}

// Reads what each pass has written, by the names of images.
template <class Program, class Read>
void watchPasses(Program& program, Pictures& pictures, Read read) {
    program.onPass([&program, &pictures, read](int index) {
        for (const PassBinding& b : program.plan().passes[size_t(index)].bindings)
            if (const Resource& r = program.plan().resources[size_t(b.resource)];
                b.access == Access::write && r.kind == ResourceKind::transient)
                pictures.emplace(r.name, read(r));
    });
}

Pictures transientsOf(const opengl::Device& device, const Plan& plan, const Frame& f) {
    opengl::Program program = compile(device, plan);
    Pictures pictures;
    watchPasses(program, pictures, [&program](const Resource& r) {
        const auto texture = program.ownTexture(r.name);
        REQUIRE(texture);
        return readBack(*texture, r.extent, r.channels);
    });
    const HostTextures host(plan, picturesOf(f), Format::rgba16f);
    const auto recorded = program.record(host.inputs(constantsOf(f)));
    REQUIRE_MESSAGE(recorded, (recorded ? "" : recorded.error().message));
    return pictures;
}

Pictures transientsOf(const cpu::Device& device, const Plan& plan, const Frame& f) {
    auto program = device.compile(plan);
    REQUIRE(program);
    Pictures pictures, images = picturesOf(f);
    watchPasses(*program, pictures, [&program](const Resource& r) {
        Picture picture(r.extent, r.channels);
        picture.values = floatsOf(*program->read(r.name));
        return picture;
    });
    images["indirect"] = images["composed"] = Picture(f.settings.resolution, 3);
    FrameInputs<cpu::Image> inputs;
    for (auto& [resource, picture] : images) inputs.images.push_back({resource, picture.image()});
    inputs.constants = constantsOf(f);
    REQUIRE(program->record(inputs));
    return pictures;
}

} // namespace

TEST_CASE("indirect light on OpenGL: every image of every pass is the CPU's") {
    inEachContext([](host::OpenGLContext&) {
        const opengl::Device device = createDevice();
        for (const GBufferConventions& conventions : someConventions()) {
            const Frame f = frameOf("half-64", conventions, {93, 61});
            const Plan plan = planOf(f.settings);
            checkPictures(plan, transientsOf(device, plan, f),
                          transientsOf(deviceFor(cpu::Isa::scalar), plan, f));
        }
    });
}

TEST_CASE("indirect light on OpenGL: presets' outputs are the CPU's") {
    inEachContext([](host::OpenGLContext&) {
        const opengl::Device device = createDevice();
        for (const char* preset : {"quarter-64", "half-64", "quarter-256-5"})
            for (Extent2D extent : {Extent2D{93, 61}, Extent2D{160, 90}}) {
                const Frame f = frameOf(preset, someConventions()[1], extent);
                const Plan plan = planOf(f.settings);
                CAPTURE(std::string(preset));
                checkPictures(plan, runPlan(device, plan, picturesOf(f), Format::rgba16f, constantsOf(f)),
                              runPlan(deviceFor(cpu::Isa::scalar), plan, picturesOf(f), constantsOf(f)));
            }
    });
}

TEST_CASE("indirect light on OpenGL: settings' kernels, and pictures smaller than a workgroup") {
    inEachContext([](host::OpenGLContext&) {
        const opengl::Device device = createDevice();
        Frame f = frameOf("quarter-64", someConventions()[0], {41, 23});
        f.settings.writeIndirect = false; // upsample_compose
        f.settings.reduction = Reduction::nearest;
        f.settings.formFactor = FormFactor::pointToPoint;
        f.settings.start = StartResolution::full;
        f.settings.levels = 3;
        f.settings.onlyLevel = 1; // carry
        const Plan plan = planOf(f.settings);
        checkPictures(plan, runPlan(device, plan, picturesOf(f), Format::rgba16f, constantsOf(f)),
                      runPlan(deviceFor(cpu::Isa::scalar), plan, picturesOf(f), constantsOf(f)));

        for (Extent2D extent : {Extent2D{1, 1}, Extent2D{3, 2}, Extent2D{1, 40}}) {
            Frame small = frameOf("quarter-64", someConventions()[0], extent);
            const Plan smallPlan = planOf(small.settings);
            const Pictures got =
                runPlan(device, smallPlan, picturesOf(small), Format::rgba16f, constantsOf(small));
            const Pictures want =
                runPlan(deviceFor(cpu::Isa::scalar), smallPlan, picturesOf(small), constantsOf(small));
            const int times = roundings(smallPlan).at("composed");
            checkLight(got.at("composed"), want.at("composed"), times);
        }
    });
}

TEST_CASE("indirect light on OpenGL: pixels that are no number spoil nothing") {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    inEachContext([&](host::OpenGLContext&) {
        Frame f = frameOf("half-64", someConventions()[0], {64, 40});
        for (int i = 0; i < 40; i += 3) {
            f.depth.at(i, i, 0) = i % 2 ? nan : inf;
            f.normal.at(i + 5, i, i % 3) = i % 2 ? -inf : nan;
            f.radiance.at(i + 10, i, i % 3) = i % 2 ? nan : inf;
        }
        const Plan plan = planOf(f.settings);
        const Pictures got = runPlan(createDevice(), plan, picturesOf(f), Format::rgba16f, constantsOf(f));
        const Pictures want = runPlan(deviceFor(cpu::Isa::scalar), plan, picturesOf(f), constantsOf(f));
        CHECK(allFinite(want.at("indirect")));
        CHECK(allFinite(got.at("indirect")));
        checkPictures(plan, got, want);
    });
}

TEST_CASE("indirect light on OpenGL: the same frame gives the same bits") {
    inEachContext([](host::OpenGLContext&) {
        const opengl::Device device = createDevice();
        const Frame f = frameOf("half-64", someConventions()[0], {93, 61});
        const Plan plan = planOf(f.settings);
        opengl::Program program = compile(device, plan);
        const HostTextures host(plan, picturesOf(f), Format::rgba16f);
        Picture first;
        for (int frame = 0; frame < 5; ++frame) {
            REQUIRE(program.record(host.inputs(constantsOf(f))));
            const Picture picture = host.read("indirect", 3);
            if (frame == 0) first = picture;
            CHECK(sameBits(picture, first));
        }
    });
}

} // namespace rebound::test
