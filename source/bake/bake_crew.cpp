// SPDX-License-Identifier: MIT
#include "rebound/bake/bake_crew.hpp"

#include "parallel.hpp"

#include <mutex>
#include <new>
#include <numeric>
#include <optional>
#include <string>

namespace rebound {

namespace {

// Parts of a task, done by threads; the first that fails ends it.
class PartWork {
public:
    PartWork(const BakeTask& work, std::span<const uint32_t> partNumbers, BakePartFolder* folder,
             const BakeProgress& report)
        : task(work), numbers(partNumbers), kept(folder), progress(report), results(partNumbers.size()) {}

    // Which of them are still to be done.
    std::vector<size_t> readKept() {
        std::vector<size_t> left;
        for (size_t i = 0; i < numbers.size(); ++i) {
            if (auto earlier = kept ? kept->read(task, numbers[i]) : std::nullopt)
                results[i] = *std::move(earlier);
            else left.push_back(i);
        }
        done = numbers.size() - left.size();
        return left;
    }

    void report() const {
        if (progress && !numbers.empty()) progress(double(done) / double(numbers.size()));
    }

    void finish(size_t i) {
        {
            const std::lock_guard lock(mutex);
            if (failure) return;
        }
        results[i] = task.run(numbers[i]);
        const Result<> written = kept ? kept->write(task, numbers[i], results[i]) : Result<>{};
        const std::lock_guard lock(mutex);
        if (!written && !failure) failure = written.error();
        ++done;
        report();
    }

    Result<BakeParts> outcome() {
        if (failure) return *failure;
        return std::move(results);
    }

private:
    const BakeTask& task;
    const std::span<const uint32_t> numbers;
    BakePartFolder* const kept;
    const BakeProgress& progress;
    BakeParts results;
    std::mutex mutex; // guards what follows
    size_t done = 0;
    std::optional<Error> failure;
};

} // namespace

Result<BakeParts> doBakeParts(const BakeTask& task, std::span<const uint32_t> parts, int threads,
                              BakePartFolder* kept, const BakeProgress& progress) {
    try {
        PartWork work(task, parts, kept, progress);
        const std::vector<size_t> left = work.readKept();
        work.report();
        detail::parallelFor(
            left.size(), threads,
            [&](size_t first, size_t last) {
                for (size_t i = first; i < last; ++i) work.finish(left[i]);
            },
            1);
        return work.outcome();
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "memory is too short for " + std::to_string(parts.size()) +
                                                 " parts of a bake's " + std::string(task.name)};
    }
}

Result<BakeParts> LocalBakeCrew::run(const BakeTask& task, int threads, const BakeProgress& progress) {
    std::vector<uint32_t> all(task.parts);
    std::iota(all.begin(), all.end(), 0u);
    return doBakeParts(task, all, threads, folder, progress);
}

} // namespace rebound
