// SPDX-License-Identifier: MIT
#include "parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace rebound::detail {

namespace {

class Chunks {
public:
    Chunks(size_t items, size_t itemsOfChunk, const std::function<void(size_t, size_t)>& call)
        : count(items), chunk(itemsOfChunk), body(call) {}

    void drain() {
        try {
            for (size_t first = next.fetch_add(chunk); first < count; first = next.fetch_add(chunk))
                body(first, std::min(first + chunk, count));
        } catch (...) {
            next = count;
            const std::lock_guard lock(mutex);
            if (!thrown) thrown = std::current_exception();
        }
    }

    void rethrow() const {
        if (thrown) std::rethrow_exception(thrown);
    }

private:
    size_t count, chunk;
    const std::function<void(size_t, size_t)>& body;
    std::atomic<size_t> next{0};
    std::mutex mutex;
    std::exception_ptr thrown; // the first
};

} // namespace

void parallelFor(size_t count, int threads, const std::function<void(size_t first, size_t last)>& body,
                 size_t chunk) {
    const size_t chunks = (count + chunk - 1) / chunk;
    const size_t wanted = threads > 0 ? size_t(threads) : std::max(1u, std::thread::hardware_concurrency());
    Chunks work(count, chunk, body);
    std::vector<std::thread> others;
    others.reserve(std::min(wanted, chunks));
    try {
        for (size_t i = 1; i < std::min(wanted, chunks); ++i) others.emplace_back([&] { work.drain(); });
    } catch (const std::exception&) {
        // As many threads as the system gave are enough to run everything.
    }
    work.drain();
    for (std::thread& thread : others) thread.join();
    work.rethrow();
}

} // namespace rebound::detail
