// SPDX-License-Identifier: MIT
// Who does the costly work of a bake: this process, this one and an earlier one that was interrupted, or many together.
#pragma once

#include "rebound/bake/part_folder.hpp"
#include "rebound/result.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace rebound {

// Work in parts, each of which depends on no other, and gives the same numbers wherever it is done.
struct BakeTask {
    std::string_view name; // "receivers" or "links"
    // XXH3 of 128 bits of what the numbers depend on: geometry, surfels, tree, caches and settings. What surfaces are
    // made of, where rays pass through their holes, and the baker's own code are not in it.
    std::array<uint32_t, 4> key{};
    uint32_t parts = 0;
    std::function<std::vector<uint32_t>(uint32_t part)> run; // called by many threads at a time
};

// What each part has given, in their order.
using BakeParts = std::vector<std::vector<uint32_t>>;

// Called now and then with which share of a task is done, 0 to 1; by one thread at a time.
using BakeProgress = std::function<void(double)>;

// Does these parts of a task here, on so many threads (0: one a core); those that `kept` holds are read, others are kept
// there as soon as they are done. kept: null, where nothing is to be kept. Fails where a part cannot be kept, or memory
// is short.
Result<BakeParts> doBakeParts(const BakeTask&, std::span<const uint32_t> parts, int threads,
                              BakePartFolder* kept, const BakeProgress& progress);

class BakeCrew {
public:
    virtual ~BakeCrew() = default;

    // What all parts have given; nothing at all in a process that only helps.
    virtual Result<BakeParts> run(const BakeTask&, int threads, const BakeProgress&) = 0;
};

// This process alone.
class LocalBakeCrew : public BakeCrew {
public:
    // kept: where finished parts are kept, and has to outlive this; null: nowhere.
    explicit LocalBakeCrew(BakePartFolder* kept = nullptr) : folder(kept) {}
    Result<BakeParts> run(const BakeTask&, int threads, const BakeProgress&) override;

private:
    BakePartFolder* folder;
};

} // namespace rebound
