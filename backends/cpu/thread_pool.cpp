// SPDX-License-Identifier: MIT
#include "rebound/cpu/parallel_for.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace rebound::cpu {

struct ThreadPool::State {
    std::vector<std::thread> threads;
    std::mutex calls; // held by the one run() at a time
    std::mutex mutex;
    std::condition_variable work, done;
    const std::function<void(int)>* body = nullptr;
    int count = 0;
    std::atomic<int> next{0};
    unsigned generation = 0;   // counts calls of run(), modulo its range
    int busy = 0;              // threads that have not finished the current generation
    std::exception_ptr thrown; // the first that a body threw in the current generation
    bool stopping = false;

    void drain() {
        try {
            for (int i = next.fetch_add(1); i < count; i = next.fetch_add(1)) (*body)(i);
        } catch (...) {
            next = count;
            std::lock_guard lock(mutex);
            if (!thrown) thrown = std::current_exception();
        }
    }

    void workLoop() {
        unsigned seen = 0;
        std::unique_lock lock(mutex);
        for (;;) {
            work.wait(lock, [&] { return stopping || generation != seen; });
            if (stopping) return;
            seen = generation;
            lock.unlock();
            drain();
            lock.lock();
            if (--busy == 0) done.notify_one();
        }
    }
};

ThreadPool::ThreadPool(int threads) : state(std::make_unique<State>()) {
    const int wanted = threads > 0 ? threads : std::max(1, int(std::thread::hardware_concurrency()));
    try {
        for (int i = 1; i < wanted; ++i) state->threads.emplace_back([s = state.get()] { s->workLoop(); });
    } catch (const std::system_error&) {
        // As many as the system gave are enough to run everything.
    }
}

ThreadPool::~ThreadPool() {
    {
        std::lock_guard lock(state->mutex);
        state->stopping = true;
    }
    state->work.notify_all();
    for (std::thread& t : state->threads) t.join();
}

int ThreadPool::threadCount() const { return int(state->threads.size()) + 1; }

void ThreadPool::run(int count, const std::function<void(int)>& body) {
    if (count <= 0) return;
    std::lock_guard oneAtATime(state->calls);
    if (state->threads.empty() || count == 1) {
        for (int i = 0; i < count; ++i) body(i);
        return;
    }
    {
        std::lock_guard lock(state->mutex);
        state->body = &body;
        state->count = count;
        state->thrown = nullptr;
        state->next = 0;
        state->busy = int(state->threads.size());
        ++state->generation;
    }
    state->work.notify_all();
    state->drain();
    std::unique_lock lock(state->mutex);
    state->done.wait(lock, [&] { return state->busy == 0; });
    if (state->thrown) std::rethrow_exception(std::exchange(state->thrown, nullptr));
}

} // namespace rebound::cpu
