// SPDX-License-Identifier: MIT
// Features, tables, constants and loops of the kernel language.
#include "kernel_runner.hpp"

namespace rebound::test {
namespace {

int collatzSteps(int n) {
    int steps = 0;
    for (; n > 1; n = n % 2 ? 3 * n + 1 : n / 2) ++steps;
    return steps;
}

Picture language(cpu::Isa isa, std::vector<int> features, Picture& start,
                 const std::vector<TableEntry>& table) {
    const Extent2D extent = start.extent;
    const LanguageConstants k{{extent.width, extent.height, int(table.size()), 0}, {9.0f, 0.5f, 9.0f, 42.0f}};
    std::vector<std::byte> entries(table.size() * sizeof(TableEntry));
    std::memcpy(entries.data(), table.data(), entries.size());
    return runKernel(
        isa, {"language", std::move(features), {{0, &start}}, {{2, bytesOf(k)}, {3, entries}}, 1, extent});
}

const std::vector<TableEntry> threeEntries = {
    {{0, 0, 2, 0}, {0, 1}, 0.5f, 0}, {{0, 0, -1, 0}, {0, 0}, 4.0f, 0}, {{0, 0, 8, 0}, {7, -3}, 0.25f, 0}};

} // namespace

TEST_CASE("a loop runs on for the lanes that have not finished") {
    Picture start({100, 3}, 1);
    for (size_t i = 0; i < start.values.size(); ++i) start.values[i] = float(i * 37 % 301);
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Picture result = language(isa, {}, start, threeEntries);
        for (size_t i = 0; i < start.values.size(); ++i)
            CHECK(result.values[4 * i] == float(collatzSteps(int(start.values[i]))));
    }
}

TEST_CASE("every combination of features selects its kernel; features that are left out are 0") {
    Picture start({3, 1}, 1);
    for (cpu::Isa isa : cpu::availableIsas()) {
        for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 3; ++b)
                for (int c = 0; c < 2; ++c)
                    for (int d = 0; d < 4; ++d)
                        CHECK(language(isa, {a, b, c, d}, start, threeEntries).values[1] ==
                              float(a + 10 * b + 100 * c + 1000 * d));
        CHECK(language(isa, {1, 2}, start, threeEntries).values[1] == 21.0f);
        CHECK(language(isa, {}, start, threeEntries).values[1] == 0.0f);
    }
}

TEST_CASE("tables and constants reach every lane") {
    Picture start({20, 2}, 1);
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Picture result = language(isa, {}, start, threeEntries);
        for (size_t i = 0; i < start.values.size(); ++i) {
            // 0.5 + (2 * 0.5 + 1) + (-1 * 4 + 0) + (8 * 0.25 - 3), exact in any order.
            CHECK(result.values[4 * i + 2] == -2.5f);
            CHECK(result.values[4 * i + 3] == 42.0f);
        }
    }
}

} // namespace rebound::test
