// SPDX-License-Identifier: MIT
#include "rebound/cpu/parallel_for.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

namespace rebound::cpu {

TEST_CASE("a thread pool calls its body once for every index") {
    for (int threads : {1, 2, 3, 7}) {
        ThreadPool pool(threads);
        CHECK(pool.threadCount() == threads);
        for (int count : {0, 1, 2, 3, 100, 10000}) {
            std::vector<std::atomic<int>> calls(size_t(count) + 1);
            pool.run(count, [&](int i) { ++calls[size_t(i)]; });
            CHECK(std::all_of(calls.begin(), calls.end() - 1, [](const auto& n) { return n == 1; }));
            CHECK(calls.back() == 0);
        }
        pool.run(-5, [](int) { FAIL_CHECK("called for a negative count"); });
    }
}

TEST_CASE("a thread pool hands what its body wrote to the caller, run after run") {
    ThreadPool pool(4);
    std::vector<int> values(64, 0);
    for (int run = 0; run < 2000; ++run) pool.run(int(values.size()), [&](int i) { ++values[size_t(i)]; });
    CHECK(std::all_of(values.begin(), values.end(), [](int v) { return v == 2000; }));
}

TEST_CASE("a thread pool's calls from several threads take turns") {
    ThreadPool pool(3);
    std::atomic<int> inside{0}, calls{0}, overlaps{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            for (int run = 0; run < 100; ++run)
                pool.run(8, [&](int) {
                    // Bodies of one caller alone: each adds its own number, and no other's may be there.
                    const int own = 1 << (8 * t);
                    if (((inside += own) & ~(0xff << (8 * t))) != 0) ++overlaps;
                    inside -= own;
                    ++calls;
                });
        });
    for (std::thread& t : threads) t.join();
    CHECK(calls == 3200);
    CHECK(overlaps == 0);
}

TEST_CASE("a thread pool of 0 threads has one a core") {
    CHECK(ThreadPool(0).threadCount() >= 1);
    CHECK(ThreadPool(0).threadCount() == ThreadPool().threadCount());
}

TEST_CASE("thread pools come and go") {
    for (int i = 0; i < 200; ++i) {
        ThreadPool pool(3);
        if (i % 2 == 0) {
            std::atomic<int> sum{0};
            pool.run(5, [&](int k) { sum += k; });
            CHECK(sum == 10);
        }
    }
}

TEST_CASE("a thread pool's run throws what its body threw, and serves again") {
    for (int threads : {1, 2, 5}) {
        ThreadPool pool(threads);
        for (int round = 0; round < 50; ++round) {
            std::atomic<int> calls{0};
            auto body = [&](int i) {
                ++calls;
                if (i == 7) throw std::runtime_error("seven");
            };
            CHECK_THROWS_WITH_AS(pool.run(1000, body), "seven", std::runtime_error);
            CHECK(calls >= 1);
            calls = 0;
            pool.run(1000, [&](int) { ++calls; });
            CHECK(calls == 1000);
        }
    }
}

TEST_CASE("every call of a thread pool's body may throw") {
    ThreadPool pool(4);
    for (int round = 0; round < 50; ++round) CHECK_THROWS_AS(pool.run(100, [](int i) { throw i; }), int);
}

} // namespace rebound::cpu
