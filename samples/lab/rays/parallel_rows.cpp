// SPDX-License-Identifier: MIT
#include "lab/rays/parallel_rows.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace rebound::lab {

namespace {

class RowLoop {
public:
    RowLoop(int rowCount, const Progress& progressCallback, const std::function<void(int)>& rowBody)
        : rows(rowCount), progress(progressCallback), body(rowBody) {}

    void work() {
        try {
            for (int row = next++; row < rows; row = next++) {
                body(row);
                report();
            }
        } catch (...) {
            const std::scoped_lock lock(mutex);
            next = rows;
            if (!failure) failure = std::current_exception();
        }
    }

    void rethrow() const {
        if (failure) std::rethrow_exception(failure);
    }

private:
    void report() {
        const std::scoped_lock lock(mutex);
        ++done;
        if (progress) progress(double(done) / double(rows));
    }

    int rows;
    const Progress& progress;
    const std::function<void(int)>& body;
    std::atomic<int> next = 0;
    std::mutex mutex;
    int done = 0;
    std::exception_ptr failure;
};

} // namespace

void parallelRows(int rows, int threads, const Progress& progress, const std::function<void(int)>& body) {
    RowLoop loop(rows, progress, body);
    const int wanted = threads > 0 ? threads : int(std::max(1u, std::thread::hardware_concurrency()));
    {
        std::vector<std::jthread> helpers;
        try {
            while (int(helpers.size()) + 1 < std::min(wanted, rows))
                helpers.emplace_back([&loop] { loop.work(); });
        } catch (const std::system_error&) {
            // The system grants no more threads; those that run share the rows.
        }
        loop.work();
    }
    loop.rethrow();
}

} // namespace rebound::lab
