// SPDX-License-Identifier: MIT
// Path tracing as work: the same bits however it is divided, errors that are as large as it says, and bad
// input.
#include "path_tracer_test_light.hpp"

#include "lab/light/reference_cache.hpp"
#include "lab/scenes/scene_files.hpp"
#include "temporary_folder.hpp"

#include <cstring>
#include <fstream>
#include <limits>

using namespace rebound;
using namespace rebound::lab;

namespace {

const Scene& cornell() {
    static const Scene scene = makeCornellBox();
    return scene;
}

PathTracer tracerOf(const PathTracerOptions& options) {
    auto tracer = PathTracer::create(cornell(), cornell().cameras[0], options);
    REQUIRE_MESSAGE(tracer, (tracer ? "" : tracer.error().message));
    return *std::move(tracer);
}

void finish(PathTracer& tracer) {
    while (!tracer.isDone()) tracer.addPass();
}

void checkSame(const PathTracedLight& a, const PathTracedLight& b) {
    CHECK(a.samples == b.samples);
    CHECK(a.relativeError == b.relativeError);
    CHECK(a.direct.data == b.direct.data);
    CHECK(a.firstBounce.data == b.firstBounce.data);
    CHECK(a.indirect.data == b.indirect.data);
    CHECK(a.glossy.data == b.glossy.data);
    CHECK(a.standardError.data == b.standardError.data);
}

double luminanceRms(const Image& a, const Image& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.data.size(); i += 3) {
        const auto at = [&](const Image& image) {
            return 0.2126 * double(image.data[i]) + 0.7152 * double(image.data[i + 1]) +
                   0.0722 * double(image.data[i + 2]);
        };
        sum += std::pow(at(a) - at(b), 2.0);
    }
    return std::sqrt(sum / (double(a.data.size()) / 3));
}

std::string failureOf(const PathTracerOptions& options) {
    const auto light = tracePaths(cornell(), cornell().cameras[0], options);
    REQUIRE(!light);
    CHECK(light.error().code == ErrorCode::invalidArgument);
    return light.error().message;
}

} // namespace

TEST_CASE("threads change nothing") {
    PathTracerOptions options{.extent = {24, 16}, .glossy = GlossyModel::ggx, .samples = 32, .threads = 1};
    const auto one = traced(cornell(), cornell().cameras[0], options);
    options.threads = 3;
    checkSame(one, traced(cornell(), cornell().cameras[0], options));
    options.seed = 1;
    CHECK(traced(cornell(), cornell().cameras[0], options).indirect.data != one.indirect.data);
}

TEST_CASE("an interrupted run that is taken up ends with the same bits") {
    const PathTracerOptions options{.extent = {24, 16}, .glossy = GlossyModel::phong, .samples = 200};
    PathTracer whole = tracerOf(options);
    finish(whole);
    PathTracer first = tracerOf(options);
    first.addPass();
    first.addPass();
    PathTracer second = tracerOf(options);
    REQUIRE(second.restore(first.save()));
    CHECK(second.samples() == first.samples());
    finish(second);
    checkSame(second.light(), whole.light());
    CHECK(whole.samples() == 200);
}

TEST_CASE("what was saved by another run, or damaged, is refused and changes nothing") {
    const PathTracerOptions options{.extent = {8, 8}, .samples = 16};
    PathTracer tracer = tracerOf(options);
    tracer.addPass();
    const std::vector<std::byte> saved = tracer.save();
    PathTracerOptions others[] = {options, options, options, options};
    others[0].bounces = 3;
    others[1].extent = {8, 9};
    others[2].seed = 5;
    others[3].glossy = GlossyModel::ggx;
    for (const PathTracerOptions& other : others) {
        PathTracer refusing = tracerOf(other);
        const auto restored = refusing.restore(saved);
        REQUIRE(!restored);
        CHECK(restored.error().message == "the stored paths are of another scene, camera or setting");
        CHECK(refusing.samples() == 0);
    }
    for (const size_t position : {size_t(3), size_t(40), saved.size() / 2, saved.size() - 1}) {
        std::vector<std::byte> damaged = saved;
        damaged[position] ^= std::byte{0x10};
        PathTracer refusing = tracerOf(options);
        CHECK(!refusing.restore(damaged));
        CHECK(refusing.samples() == 0);
    }
    PathTracer refusing = tracerOf(options);
    CHECK(!refusing.restore(std::span(saved).first(saved.size() - 8)));
    CHECK(!refusing.restore({}));
}

TEST_CASE("the standard error is as large as the spread of independent runs") {
    PathTracerOptions options{.extent = {48, 36}, .bounces = 3, .samples = 64};
    const auto first = traced(cornell(), cornell().cameras[0], options);
    options.seed = 1;
    const auto second = traced(cornell(), cornell().cameras[0], options);
    const double expected = std::hypot(luminanceRms(first.indirect, second.indirect) / std::sqrt(2.0), 0.0);
    double stated = 0.0;
    for (const float error : first.standardError.data) stated += double(error) * double(error);
    stated = std::sqrt(stated / double(first.standardError.data.size()));
    // 1728 pixels with 7 degrees of freedom each tell a variance to 2 %; a few bright pixels dominate it.
    CHECK(stated == doctest::Approx(expected).epsilon(0.15));
}

TEST_CASE("an error that is asked for ends the work, and samples do before it is reached") {
    PathTracerOptions options{.extent = {32, 24}, .bounces = 1, .samples = 1 << 14, .error = 0.05};
    const auto light = traced(cornell(), cornell().cameras[0], options);
    CHECK(light.relativeError <= 0.05);
    CHECK(light.relativeError > 0.02); // no more work than a pass or two too much
    CHECK(light.samples < 4096);
    options.samples = 8;
    CHECK(traced(cornell(), cornell().cameras[0], options).relativeError > 0.05);
}

TEST_CASE("progress never runs ahead of its end") {
    double last = 0.0;
    PathTracerOptions options{.extent = {8, 8}, .samples = 100, .threads = 1};
    options.progress = [&](double share) {
        CHECK(share >= last);
        CHECK(share <= 1.0);
        last = share;
    };
    traced(cornell(), cornell().cameras[0], options);
    CHECK(last == 1.0);
}

TEST_CASE("the halves of a reference are independent estimates, and their mean is the whole") {
    const PathTracerOptions options{.extent = {48, 36}, .bounces = 2, .samples = 128};
    const PathTracedLight light = traced(cornell(), cornell().cameras[0], options);
    double squares = 0.0, sum = 0.0, visible = 0.0;
    for (size_t pixel = 0; pixel < light.standardError.data.size(); ++pixel) {
        double deviation = 0.0, mean = 0.0;
        for (size_t c = 0; c < 3; ++c) {
            constexpr double weights[] = {0.2126, 0.7152, 0.0722};
            const double a = double(light.indirectHalves[0].data[pixel * 3 + c]),
                         b = double(light.indirectHalves[1].data[pixel * 3 + c]);
            CHECK((a + b) / 2.0 == doctest::Approx(double(light.indirect.data[pixel * 3 + c])).epsilon(1e-6));
            deviation += weights[c] * (a - b) / 2.0;
            mean += weights[c] * (a + b) / 2.0;
        }
        squares += deviation * deviation;
        sum += mean;
        visible += mean > 0.0 ? 1.0 : 0.0;
    }
    // Half the difference of both is an estimate of the mean's standard error, of one degree of freedom a pixel; so is the
    // spread of eight replicates. 1700 pixels leave each within some per cent.
    CHECK(std::sqrt(squares / visible) / (sum / visible) ==
          doctest::Approx(light.relativeError).epsilon(0.1));
    for (size_t i = 0; i < light.firstBounce.data.size(); ++i)
        CHECK(light.firstBounceHalves[0].data[i] + light.firstBounceHalves[1].data[i] ==
              doctest::Approx(2.0 * double(light.firstBounce.data[i])).epsilon(1e-6));
}

TEST_CASE("options out of range are named") {
    CHECK(failureOf({.extent = {0, 8}}) == "path tracer option extent.width is 0; expected 1 to 16384");
    CHECK(failureOf({.bounces = -1}) == "path tracer option bounces is -1; expected 0 to 64");
    CHECK(failureOf({.samples = 0}) == "path tracer option samples is 0; expected 1 to 1048576");
    CHECK(failureOf({.threads = 5000}) == "path tracer option threads is 5000; expected 0 to 1024");
    CHECK(failureOf({.error = -0.5}).starts_with("path tracer option error is -0.5"));
    CHECK(failureOf({.error = std::numeric_limits<double>::quiet_NaN()})
              .starts_with("path tracer option error is nan"));
}

TEST_CASE("a reference is traced once and kept") {
    const TemporaryFolder folder;
    PathTracerOptions options{.extent = {16, 12}, .bounces = 1, .samples = 16};
    int passes = 0;
    options.progress = [&](double) { ++passes; };
    const auto cached = [&] {
        auto light = cachedReference(cornell(), cornell().cameras[0], options, folder.path() / "cache");
        REQUIRE_MESSAGE(light, (light ? "" : light.error().message));
        return *std::move(light);
    };
    const auto first = cached();
    CHECK(passes > 0);
    checkSame(first, traced(cornell(), cornell().cameras[0], options));
    passes = 0;
    checkSame(first, cached());
    CHECK(passes == 0);
    options.samples = 8; // it has more than that already
    CHECK(cached().samples == 16);
    CHECK(passes == 0);
    options.samples = 24;
    CHECK(cached().samples == 24);
    CHECK(passes > 0);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "cache"))
        std::ofstream(entry.path(), std::ios::binary | std::ios::in).seekp(300).put('x');
    options.samples = 16;
    const auto again = cached();
    CHECK(again.samples == 16);
    CHECK(again.indirect.data == first.indirect.data);
}
