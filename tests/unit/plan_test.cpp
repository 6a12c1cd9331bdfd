// SPDX-License-Identifier: MIT
// Plans as values: what makes one valid, and how its transients share memory.
#include "rebound/plan.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <random>

namespace rebound {
namespace {

std::string numbered(std::string name, int i) { return name.append(std::to_string(i)); }

// input -> first -> a -> second -> output
Plan smallPlan() {
    Plan plan{"small", {}, {}};
    const auto input = plan.add({"input", ResourceKind::input, Format::r32f, 1, {8, 4}, {}, 0});
    const auto a = plan.add({"a", ResourceKind::transient, Format::rgba16f, 3, {8, 4}, {}, 0});
    const auto output = plan.add({"output", ResourceKind::output, Format::rgba32f, 4, {8, 4}, {}, 0});
    const auto numbers = plan.add(bufferResource("numbers", std::vector<float>{1, 2, 3}));
    const auto camera = plan.add({"camera", ResourceKind::frameConstants, {}, 1, {}, {}, 96});
    plan.passes.push_back({"first", "one", {2, 0}, {{0, input}, {1, a, Access::write}, {2, camera}}, {8, 4}});
    plan.passes.push_back({"second", "two", {}, {{0, a}, {1, output, Access::write}, {2, numbers}}, {8, 4}});
    return plan;
}

void checkRefused(const std::string& part, const std::function<void(Plan&)>& spoil) {
    Plan plan = smallPlan();
    spoil(plan);
    const auto valid = validate(plan);
    CAPTURE(part);
    REQUIRE_FALSE(valid);
    CHECK(valid.error().code == ErrorCode::invalidArgument);
    CHECK(valid.error().message.find(part) != std::string::npos);
    CHECK_FALSE(memoryUse(plan));
}

// A plan whose passes write and read transients at random.
Plan randomPlan(std::mt19937& random) {
    auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    Plan plan{"random", {}, {}};
    const int transients = pick(1, 14), passes = pick(1, 20);
    for (int i = 0; i < transients; ++i)
        plan.add({numbered("t", i),
                  ResourceKind::transient,
                  Format(pick(0, 2)),
                  4,
                  {pick(1, 200), pick(1, 200)},
                  {},
                  0});
    std::vector<bool> written(size_t(transients), false);
    for (int p = 0; p < passes; ++p) {
        Pass pass{numbered("p", p), "k", {}, {}, {1, 1}};
        const int target = pick(0, transients - 1);
        pass.bindings.push_back({0, target, Access::write});
        for (int slot = 1; slot <= pick(0, 3); ++slot)
            if (const int r = pick(0, transients - 1); r != target && written[size_t(r)])
                pass.bindings.push_back({slot, r});
        written[size_t(target)] = true;
        plan.passes.push_back(pass);
    }
    return plan;
}

// Whether some pass lies between, or at, the first and the last use of both: from the passes alone.
bool aliveTogether(const Plan& plan, int a, int b) {
    auto uses = [&](const Pass& pass, int r) {
        return std::ranges::any_of(pass.bindings, [r](const PassBinding& x) { return x.resource == r; });
    };
    for (size_t p = 0; p < plan.passes.size(); ++p) {
        auto alive = [&](int r) {
            bool before = false, after = false;
            for (size_t q = 0; q < plan.passes.size(); ++q)
                if (uses(plan.passes[q], r)) {
                    before = before || q <= p;
                    after = after || q >= p;
                }
            return before && after;
        };
        if (alive(a) && alive(b)) return true;
    }
    return false;
}

} // namespace

TEST_CASE("a plan is found valid, and its resources by their names") {
    const Plan plan = smallPlan();
    CHECK(validate(plan));
    CHECK(validate(Plan{}));
    CHECK(plan.find("input") == 0);
    CHECK(plan.find("camera") == 4);
    CHECK(plan.find("Camera") == -1);
    CHECK(plan.find("") == -1);
}

TEST_CASE("a plan's resources: what is refused") {
    checkRefused("without a name", [](Plan& p) { p.resources[1].name.clear(); });
    checkRefused("two resources named input", [](Plan& p) { p.resources[1].name = "input"; });
    for (Extent2D e :
         {Extent2D{0, 4}, Extent2D{8, 0}, Extent2D{-1, 4}, Extent2D{16385, 4}, Extent2D{8, 16385}})
        for (size_t r : {0u, 1u, 2u})
            checkRefused("1x1 to 16384x16384", [&](Plan& p) { p.resources[r].extent = e; });
    for (int channels : {0, 5, -1})
        checkRefused("channels", [&](Plan& p) { p.resources[0].channels = channels; });
    checkRefused("numbers is empty", [](Plan& p) { p.resources[3].size = 0; });
    checkRefused("camera is empty", [](Plan& p) { p.resources[4].size = 0; });
    checkRefused("says 13 bytes and holds 12", [](Plan& p) { p.resources[3].size = 13; });
}

TEST_CASE("a plan's passes: what is refused") {
    checkRefused("used twice", [](Plan& p) { p.passes[1].label = "first"; });
    checkRefused("is empty or", [](Plan& p) { p.passes[1].label.clear(); });
    checkRefused("first runs for 0x4", [](Plan& p) { p.passes[0].grid.width = 0; });
    checkRefused("more than 4 features", [](Plan& p) { p.passes[0].features = {0, 0, 0, 0, 0}; });
    checkRefused("slot 16", [](Plan& p) { p.passes[0].bindings[0].slot = 16; });
    checkRefused("slot -1", [](Plan& p) { p.passes[0].bindings[0].slot = -1; });
    checkRefused("slot 1", [](Plan& p) { p.passes[0].bindings[0].slot = 1; });
    checkRefused("resource 5, which does not exist", [](Plan& p) { p.passes[0].bindings[0].resource = 5; });
    checkRefused("resource -1, which does not exist", [](Plan& p) { p.passes[0].bindings[0].resource = -1; });
    checkRefused("writes input, which is input", [](Plan& p) { p.passes[0].bindings[1].resource = 0; });
    checkRefused("writes numbers, which is buffer", [](Plan& p) { p.passes[0].bindings[1].resource = 3; });
    checkRefused("writes camera, which is frame constants",
                 [](Plan& p) { p.passes[0].bindings[1].resource = 4; });
    checkRefused("reads a before", [](Plan& p) { std::swap(p.passes[0], p.passes[1]); });
    checkRefused("reads output before", [](Plan& p) { p.passes[0].bindings[0].resource = 2; });
    checkRefused("reads and writes a", [](Plan& p) {
        p.passes[1].bindings.push_back({3, 1, Access::write});
    });
}

TEST_CASE("history, buffers and items: what is refused") {
    checkRefused("reads what the frame before has left in a, which is transient; history was expected",
                 [](Plan& p) { p.passes[1].bindings[0].access = Access::readPrevious; });
    const auto addHistory = [](Plan& p) {
        return p.add({"mean", ResourceKind::history, Format::rgba16f, 3, {8, 4}, {}, 0});
    };
    checkRefused("reads mean before a pass has written it", [&](Plan& p) {
        p.passes[1].bindings.push_back({5, addHistory(p)});
    });
    checkRefused("plan.passes read mean, which is history that no pass writes", [&](Plan& p) {
        p.passes[1].bindings.push_back({5, addHistory(p), Access::readPrevious});
    });
    checkRefused("plan.passes read sums, which is persistent buffer that no pass writes", [](Plan& p) {
        p.passes[1].bindings.push_back(
            {5, p.add({"sums", ResourceKind::persistentBuffer, Format::r32f, 1, {}, {}, 16})});
    });
    checkRefused("reads list before", [](Plan& p) {
        p.passes[1].bindings.push_back(
            {5, p.add({"list", ResourceKind::transientBuffer, Format::r32f, 1, {}, {}, 16})});
    });
    checkRefused("writes links, which is input buffer", [](Plan& p) {
        p.passes[1].bindings.push_back(
            {5, p.add({"links", ResourceKind::inputBuffer, Format::r32f, 1, {}, {}, 16}), Access::write});
    });
    for (ResourceKind kind : {ResourceKind::inputBuffer, ResourceKind::outputBuffer,
                              ResourceKind::transientBuffer, ResourceKind::persistentBuffer}) {
        checkRefused("links is empty", [&](Plan& p) { p.add({"links", kind, Format::r32f, 1, {}, {}, 0}); });
        checkRefused("at most 4294967296 were expected", [&](Plan& p) {
            p.add({"links", kind, Format::r32f, 1, {}, {}, maximumBufferSize + 1});
        });
    }
    checkRefused("frame state has 8 bytes; 16 were expected", [](Plan& p) {
        Resource r = frameStateResource();
        r.size = 8;
        p.add(r);
    });
    checkRefused("first has a grid of 8x4 pixels and 7 items; one of both was expected",
                 [](Plan& p) { p.passes[0].items = 7; });
    for (int items : {-1, maximumItems + 1})
        checkRefused("items; 1 to 1073741824 was expected", [&](Plan& p) {
            p.passes[0].grid = {};
            p.passes[0].items = items;
        });
}

TEST_CASE("history is read as it was and written as it will be by one pass") {
    Plan plan{"history", {}, {}};
    const auto mean = plan.add({"mean", ResourceKind::history, Format::rgba16f, 3, {8, 4}, {}, 0});
    plan.passes = {{"mix", "k", {}, {{0, mean, Access::readPrevious}, {1, mean, Access::write}}, {8, 4}}};
    CHECK(validate(plan));
    plan.passes[0].bindings.push_back({2, mean});
    CHECK_FALSE(validate(plan));
}

TEST_CASE("memory of history is two images, and of buffers their size; transient buffers share with images") {
    Plan plan{"kinds", {}, {}};
    const auto mean = plan.add({"mean", ResourceKind::history, Format::rgba16f, 3, {64, 16}, {}, 0});
    const auto sums = plan.add({"sums", ResourceKind::persistentBuffer, Format::r32f, 1, {}, {}, 1000});
    const auto image = plan.add({"image", ResourceKind::transient, Format::r32ui, 1, {64, 16}, {}, 0});
    const auto list = plan.add({"list", ResourceKind::transientBuffer, Format::r32ui, 1, {}, {}, 4096});
    plan.add({"links", ResourceKind::inputBuffer, Format::r32f, 1, {}, {}, size_t(1) << 30});
    plan.add({"report", ResourceKind::outputBuffer, Format::r32f, 1, {}, {}, size_t(1) << 30});
    plan.add(frameStateResource());
    plan.passes = {{"1", "k", {}, {{0, image, Access::write}, {1, mean, Access::write}}, {64, 16}},
                   {"2", "k", {}, {{0, sums, Access::write}}, {}, 250},
                   {"3", "k", {}, {{0, list, Access::write}}, {}, 1024}};
    const auto use = memoryUse(plan);
    REQUIRE(use);
    CHECK(use->persistent == 2 * 64 * 16 * 8 + 1000);
    CHECK(use->transient == 4096); // one where the other was
    CHECK(use->transientUnshared == 2 * 4096);
    CHECK(use->buffers == 16);
    CHECK(use->total() == use->persistent + use->transient + use->buffers);
}

TEST_CASE("copies of a plan share their data") {
    Plan plan = smallPlan();
    const Plan copy = plan;
    CHECK(copy.resources[3].data == plan.resources[3].data);
}

TEST_CASE("a buffer holds its elements' bytes") {
    const Resource r = bufferResource("b", std::vector<int>{7, -1});
    CHECK(r.kind == ResourceKind::buffer);
    REQUIRE(r.data->size() == 8);
    int second = 0;
    std::memcpy(&second, r.data->data() + 4, 4);
    CHECK(second == -1);
    CHECK(r.size == 8);
    CHECK(bufferResource("e", std::vector<int>{}).size == 0);
}

TEST_CASE("lifetimes run from a resource's first pass to its last") {
    Plan plan = smallPlan();
    plan.add({"unused", ResourceKind::transient, Format::r32f, 1, {100, 100}, {}, 0});
    const auto lives = lifetimes(plan);
    CHECK((lives[0].first == 0 && lives[0].last == 0));
    CHECK((lives[1].first == 0 && lives[1].last == 1));
    CHECK((lives[2].first == 1 && lives[2].last == 1));
    CHECK(lives[5].first > lives[5].last);
    CHECK(lives[0].overlaps(lives[1]));
    CHECK_FALSE(lives[0].overlaps(lives[2]));
    // Nothing is set aside for what no pass uses: 8 x 4 texels of 8 bytes.
    CHECK(memoryUse(plan)->transient == 256);
}

TEST_CASE("memory of a plan: transients shared where they can be") {
    // a -> b -> c, of one size: c lies where a was.
    Plan plan{"chain", {}, {}};
    for (const char* name : {"a", "b", "c"})
        plan.add({name, ResourceKind::transient, Format::r32f, 1, {64, 64}, {}, 0});
    plan.passes = {{"1", "k", {}, {{0, 0, Access::write}}, {64, 64}},
                   {"2", "k", {}, {{0, 0}, {1, 1, Access::write}}, {64, 64}},
                   {"3", "k", {}, {{0, 1}, {1, 2, Access::write}}, {64, 64}}};
    plan.add(bufferResource("table", std::vector<float>(10)));
    CHECK(memoryUse(plan)->transientUnshared == 3 * 64 * 64 * 4);
    CHECK(memoryUse(plan)->transient == 2 * 64 * 64 * 4);
    CHECK(memoryUse(plan)->buffers == 40);
    CHECK(memoryUse(plan)->total() == 2 * 64 * 64 * 4 + 40);
}

TEST_CASE("no two transients that are alive together overlap, in plans at random") {
    std::mt19937 random(7);
    for (int round = 0; round < 400; ++round) {
        const Plan plan = randomPlan(random);
        REQUIRE(validate(plan));
        std::vector<size_t> sizes;
        for (const Resource& r : plan.resources)
            sizes.push_back(size_t(r.extent.width) * size_t(r.extent.height) * bytesPerTexel(r.format));
        for (size_t alignment : {1u, 64u, 256u}) {
            const TransientLayout layout = layoutTransients(plan, sizes, alignment);
            size_t sum = 0, largest = 0;
            for (int a = 0; a < int(plan.resources.size()); ++a) {
                const size_t beginA = layout.offsets[size_t(a)], endA = beginA + sizes[size_t(a)];
                if (!aliveTogether(plan, a, a)) continue;
                CHECK(beginA % alignment == 0);
                CHECK(endA <= layout.size);
                sum += (sizes[size_t(a)] + alignment - 1) / alignment * alignment;
                largest = std::max(largest, sizes[size_t(a)]);
                for (int b = 0; b < a; ++b) {
                    const size_t beginB = layout.offsets[size_t(b)], endB = beginB + sizes[size_t(b)];
                    if (aliveTogether(plan, a, b)) CHECK((endA <= beginB || endB <= beginA));
                }
            }
            CHECK(layout.sizeUnshared == sum);
            CHECK(layout.size <= sum);
            CHECK(layout.size >= largest);
        }
    }
}

TEST_CASE("the largest plan's memory is told without being allocated") {
    Plan plan{"large", {}, {}};
    Pass pass{"p", "k", {}, {}, {16384, 16384}};
    for (int i = 0; i < 16; ++i) {
        plan.add({numbered("t", i), ResourceKind::transient, Format::rgba32f, 4, {16384, 16384}, {}, 0});
        pass.bindings.push_back({i, i, Access::write});
    }
    plan.passes.push_back(pass);
    CHECK(memoryUse(plan)->transient == size_t(16) * 16384 * 16384 * 16);
}

TEST_CASE("a plan prints as text, a line a resource and a pass") {
    CHECK(toText(smallPlan()) == "plan small\n"
                                 "resource input: input 8x4 r32f, 1 channel\n"
                                 "resource a: transient 8x4 rgba16f, 3 channels\n"
                                 "resource output: output 8x4 rgba32f, 4 channels\n"
                                 "resource numbers: buffer 12 bytes\n"
                                 "resource camera: frame constants 96 bytes\n"
                                 "pass first: one <2,0> for 8x4, reads input, writes a, reads camera\n"
                                 "pass second: two for 8x4, reads a, writes output, reads numbers\n");
    Plan plan{"more", {}, {}};
    const auto mean = plan.add({"mean", ResourceKind::history, Format::r32ui, 1, {8, 4}, {}, 0});
    const auto sums = plan.add({"sums", ResourceKind::persistentBuffer, Format::r32f, 1, {}, {}, 64});
    plan.passes.push_back(
        {"mix", "one", {}, {{0, mean, Access::readPrevious}, {1, mean, Access::write}}, {8, 4}});
    plan.passes.push_back({"sum", "two", {}, {{0, sums, Access::write}}, {}, 16});
    CHECK(toText(plan) == "plan more\n"
                          "resource mean: history 8x4 r32ui, 1 channel\n"
                          "resource sums: persistent buffer 64 bytes\n"
                          "pass mix: one for 8x4, reads previous mean, writes mean\n"
                          "pass sum: two for 16 items, writes sums\n");
}

} // namespace rebound
