// SPDX-License-Identifier: MIT
#include "parallel.hpp"

#include <doctest/doctest.h>

#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

using rebound::detail::parallelFor;

TEST_CASE("Every item is visited once, in the same chunks for any number of threads") {
    for (const size_t count : {0u, 1u, 9u, 10u, 1001u}) {
        std::set<std::pair<size_t, size_t>> expected;
        for (const int threads : {1, 2, 5}) {
            std::vector<int> visits(count);
            std::set<std::pair<size_t, size_t>> chunks;
            std::mutex mutex;
            parallelFor(
                count, threads,
                [&](size_t first, size_t last) {
                    const std::lock_guard lock(mutex);
                    chunks.emplace(first, last);
                    for (size_t i = first; i < last; ++i) ++visits[i];
                },
                10);
            CHECK(visits == std::vector<int>(count, 1));
            if (threads == 1) expected = chunks;
            CHECK(chunks == expected);
        }
    }
}

TEST_CASE("What a body throws is thrown to the caller, and no item is begun after it") {
    for (const int threads : {1, 3}) {
        size_t begun = 0;
        std::mutex mutex;
        const auto body = [&](size_t first, size_t) {
            const std::lock_guard lock(mutex);
            ++begun;
            if (first == 0) throw std::runtime_error("planted");
        };
        CHECK_THROWS_WITH_AS(parallelFor(1000000, threads, body, 1), "planted", std::runtime_error);
        CHECK(begun < 1000000);
    }
}
