// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

namespace rebound::cpu {

// Calls body(i) once for every i in 0 to count - 1, from any threads, and returns when all calls have. Rebound's bodies
// throw nothing.
using ParallelFor = std::function<void(int count, const std::function<void(int)>& body)>;

// Threads that wait for work between calls. Calls from several threads take turns; none may come from within a body.
class ThreadPool {
public:
    // threads: 1 to 1024, counting the one that calls run(); 0: one a core. Where the system refuses to start as many,
    // the pool makes do with fewer.
    explicit ThreadPool(int threads = 0);
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    int threadCount() const;

    // Where body throws, calls that have not begun are left out, and run() throws the first exception once those that
    // have are done.
    void run(int count, const std::function<void(int)>& body);

private:
    struct State;
    std::unique_ptr<State> state;
};

} // namespace rebound::cpu
