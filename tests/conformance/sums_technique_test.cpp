// SPDX-License-Identifier: MIT
// A made-up technique over several frames, alone, for two cameras and behind another technique, on every backend of this
// machine: bit by bit what a plain loop gives.
#include "each_backend.hpp"
#include "sums_technique.hpp"

#include "lab/conformance/conformance.hpp"
#include "lab/conformance/gbuffer.hpp"

#include <bit>

using namespace rebound;
using namespace rebound::test;

namespace {

constexpr Extent2D extent{37, 11}; // neither side is a multiple of lanes or groups
constexpr size_t pixels = 37 * 11;

const std::vector<float> weights{1, 2, 3, 5, 8, 13, 21, 34, 0.5f, 0.25f, -1, -2, -4, -8, 100, 1000};

// Of a frame of a camera; every one differs.
std::vector<float> pictureOf(int frame, int camera) {
    std::vector<float> picture(pixels);
    for (size_t i = 0; i < pixels; ++i)
        picture[i] = float((i * 7 + size_t(frame) * 31 + size_t(camera) * 101) % 256);
    return picture;
}

runner::PlanInputs inputsOf(const std::vector<float>& picture, const SharedBytes& weightBytes) {
    runner::PlanInputs inputs;
    lab::Image image(extent, 1);
    image.data = picture;
    inputs.images = {{"picture", image}, {"shown", {}}};
    inputs.buffers = {{"weights", weightBytes}, {"report", {}}};
    return inputs;
}

// Four frames.
conformance::NamedCase sequence() {
    return {"sums", []() -> Result<conformance::Case> {
                const SharedBytes shared = sharedBytes(weights);
                conformance::Case c{
                    planSums(extent), inputsOf(pictureOf(0, 0), shared), runner::Precision::single, {}, {}};
                for (const Resource& r : c.plan.resources)
                    c.tolerances.push_back(conformance::toleranceOf(r.format));
                for (int frame = 1; frame < 4; ++frame)
                    c.later.push_back(inputsOf(pictureOf(frame, 0), shared));
                return c;
            }};
}

// Spoils an integer and an element of a buffer in the third frame.
class LateFault : public runner::PreparedPlan {
public:
    explicit LateFault(std::unique_ptr<runner::PreparedPlan> p) : plan(std::move(p)) {}
    Result<> setInputs(const runner::PlanInputs& inputs) override { return plan->setInputs(inputs); }
    Result<double> run() override { return plan->run(); }
    void reset() override { plan->reset(); }
    const std::vector<PassTiming>& timings() const override { return plan->timings(); }
    MemoryUse memoryUse() const override { return plan->memoryUse(); }
    Result<lab::Image> read(const std::string& output) override { return plan->read(output); }
    Result<runner::Record> inspect(const runner::Record* replacement) override {
        auto record = plan->inspect(replacement);
        if (!record || frame++ != 2) return record;
        record->at(0).at(0).image.data[5] = std::bit_cast<float>(uint32_t(7)); // keys, as bits
        record->at(1).at(0).image.data[6] += 1.0f;                             // sums
        return record;
    }

private:
    std::unique_ptr<runner::PreparedPlan> plan;
    int frame = 0;
};

class LateFaultBackend : public runner::Backend {
public:
    explicit LateFaultBackend(std::unique_ptr<runner::Backend> b) : backend(std::move(b)) {}
    runner::BackendInfo info() const override { return backend->info(); }
    Result<MemoryUse> memoryUse(const Plan& plan) const override { return backend->memoryUse(plan); }
    Result<std::unique_ptr<runner::PreparedPlan>> prepare(const Plan& plan, const runner::PlanInputs& inputs,
                                                          const runner::PrepareOptions& options) override {
        auto prepared = backend->prepare(plan, inputs, options);
        if (!prepared) return prepared.error();
        return std::unique_ptr<runner::PreparedPlan>(std::make_unique<LateFault>(*std::move(prepared)));
    }

private:
    std::unique_ptr<runner::Backend> backend;
};

} // namespace

TEST_CASE("conformance compares every pass of every frame, history, buffers and integers included") {
    std::vector<conformance::Contender> contenders;
    for (const runner::BackendChoice& choice : choices())
        if (auto backend = runner::createBackend(choice))
            contenders.push_back({runner::toText((*backend)->info()), *std::move(backend)});
    const auto report = conformance::run({sequence()}, contenders, {}, choices().front());
    REQUIRE_MESSAGE(report, (report ? "" : report.error().message));
    CHECK(report->agrees());
    REQUIRE(report->frames.size() == contenders.size());
    for (const conformance::FrameRow& row : report->frames)
        CHECK(row.maximum == 0.0); // all arithmetic is exact
    // By contender, five kernels; keys and list, after, before and report, mean, shown; four frames.
    size_t images = 0;
    for (const conformance::Report::Row& row : report->rows) images += row.images;
    CHECK(images == contenders.size() * 7 * 4);
}

TEST_CASE("a fault in a later frame is found, and named by its frame") {
    std::vector<conformance::Contender> contenders;
    contenders.push_back(
        {"faulty", std::make_unique<LateFaultBackend>(*runner::createBackend(choices().front()))});
    const auto report = conformance::run({sequence()}, contenders, {}, choices().front());
    REQUIRE(report);
    CHECK_FALSE(report->agrees());
    REQUIRE(report->disagreements.size() == 2);
    CHECK(report->disagreements[0].caseName == "sums, frame 2");
    CHECK(report->disagreements[0].resource == "keys");
    CHECK(report->disagreements[0].difference.beyond == 1);
    CHECK(report->disagreements[1].caseName == "sums, frame 2");
    CHECK(report->disagreements[1].resource == "after");
    CHECK(report->disagreements[1].difference.worstX == 6);
}

TEST_CASE("every frame of the made-up technique is what a plain loop gives, also after a reset") {
    const SharedBytes shared = sharedBytes(weights);
    onEachBackend([&](runner::Backend& backend) {
        auto plan = prepare(backend, planSums(extent), inputsOf(pictureOf(0, 0), shared));
        for (int start : {0, 3}) {
            SumsModel model(pixels);
            for (int frame = start; frame < start + 5; ++frame) {
                CAPTURE(frame);
                const auto expected = model.run(pictureOf(frame, 0), weights);
                run(*plan, inputsOf(pictureOf(frame, 0), shared));
                CHECK(read(*plan, "shown") == expected);
                CHECK(read(*plan, "report") == model.report());
            }
            plan->reset();
        }
    });
}

TEST_CASE("what a program keeps from frame to frame is counted before it is allocated") {
    const SharedBytes shared = sharedBytes(weights);
    const size_t least = 2 * pixels * 16 + pixels * 4; // two images of history and a persistent buffer
    onEachBackend([&](runner::Backend& backend) {
        const auto use = backend.memoryUse(planSums(extent));
        REQUIRE(use);
        CHECK(use->persistent >= least);
        CHECK(use->persistent < 4 * least); // padding of rows and pages, on images this small
        CHECK(use->total() == use->transient + use->buffers + use->persistent);
        auto plan = prepare(backend, planSums(extent), inputsOf(pictureOf(0, 0), shared));
        CHECK(plan->memoryUse().persistent == use->persistent);
        CHECK(plan->memoryUse().transient == use->transient);
        const auto without = backend.memoryUse(Plan{});
        REQUIRE(without);
        CHECK(without->persistent == 0);
    });
}

TEST_CASE("two cameras in one plan keep histories of their own and share a buffer") {
    const Plan one = planSums(extent);
    const AppendOptions left{"left ", "left ", {}}, right{"right ", "right ", {{"weights", "left weights"}}};
    Plan both;
    REQUIRE(append(both, one, left));
    REQUIRE(append(both, one, right));
    const SharedBytes shared = sharedBytes(weights);
    const auto frameOf = [&](int frame) {
        runner::PlanInputs inputs;
        REQUIRE(append(inputs, inputsOf(pictureOf(frame, 0), shared), left));
        REQUIRE(append(inputs, inputsOf(pictureOf(frame, 1), shared), right));
        return inputs;
    };
    onEachBackend([&](runner::Backend& backend) {
        auto plan = prepare(backend, both, frameOf(0));
        SumsModel ofLeft(pixels), ofRight(pixels);
        for (int frame = 0; frame < 4; ++frame) {
            CAPTURE(frame);
            run(*plan, frameOf(frame));
            CHECK(read(*plan, "left shown") == ofLeft.run(pictureOf(frame, 0), weights));
            CHECK(read(*plan, "right shown") == ofRight.run(pictureOf(frame, 1), weights));
            CHECK(read(*plan, "right report") == ofRight.report());
        }
    });
}

TEST_CASE("a plan's output is an appended plan's input, kept inside or handed out") {
    const SharedBytes shared = sharedBytes(weights);
    const AppendOptions options{"second ", "second ", {{"picture", "shown"}, {"weights", "weights"}}};
    for (bool isInside : {false, true}) {
        CAPTURE(isInside);
        Plan chain = planSums(extent);
        REQUIRE(append(chain, planSums(extent), options));
        if (isInside) REQUIRE(keepInside(chain, "shown"));
        onEachBackend([&](runner::Backend& backend) {
            const auto frameOf = [&](int frame) {
                runner::PlanInputs inputs = inputsOf(pictureOf(frame, 0), shared);
                REQUIRE(append(inputs, inputsOf({}, shared), options));
                if (isInside) std::erase_if(inputs.images, [](const auto& i) { return i.name == "shown"; });
                return inputs;
            };
            auto plan = prepare(backend, chain, frameOf(0));
            SumsModel first(pixels), second(pixels);
            for (int frame = 0; frame < 3; ++frame) {
                CAPTURE(frame);
                run(*plan, frameOf(frame));
                const auto shown = first.run(pictureOf(frame, 0), weights);
                std::vector<float> means;
                for (size_t i = 0; i < pixels; ++i) means.push_back(shown[4 * i]);
                CHECK(read(*plan, "second shown") == second.run(means, weights));
                if (!isInside) CHECK(read(*plan, "shown") == shown);
            }
        });
    }
}

TEST_CASE("a technique gives the same bits alone and with another behind it") {
    conformance::Random random(3);
    ScreenIndirectSettings settings;
    settings.resolution = extent;
    settings.levels = 3;
    settings.samplesPerLevel = 16;
    const auto made = caseOf(conformance::makeGBuffer(settings, {}, random), runner::Precision::single);
    REQUIRE(made);
    const AppendOptions options{"sums ", "", {{"picture", "depth"}}};
    Plan both = made->plan;
    REQUIRE(append(both, planSums(extent), options));
    runner::PlanInputs inputs = made->inputs;
    REQUIRE(append(inputs, inputsOf({}, sharedBytes(weights)), options));
    onEachBackend([&](runner::Backend& backend) {
        auto alone = prepare(backend, made->plan, made->inputs), joined = prepare(backend, both, inputs);
        REQUIRE(alone->run());
        const auto expected = read(*alone, "composed");
        for (int frame = 0; frame < 2; ++frame) {
            run(*joined, inputs);
            CHECK(read(*joined, "composed") == expected);
        }
    });
}
