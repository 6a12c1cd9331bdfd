// SPDX-License-Identifier: MIT
// Barriers between passes: as few as their dependencies allow.
#include "device_state.hpp"

#include <algorithm>

namespace rebound::vulkan {
namespace {

// Whether two resources may touch the same memory.
struct Overlap {
    const Transients& transients;

    bool operator()(ResourceIndex a, ResourceIndex b) const {
        if (a == b) return true;
        return transients.sizeOf(a) > 0 && transients.sizeOf(b) > 0 && begin(a) < end(b) && begin(b) < end(a);
    }
    size_t begin(ResourceIndex r) const { return transients.layout.offsets[size_t(r)]; }
    size_t end(ResourceIndex r) const { return begin(r) + transients.sizeOf(r); }
};

bool dependsOn(const Pass& later, const Pass& earlier, const Overlap& overlap) {
    for (const PassBinding& l : later.bindings)
        for (const PassBinding& e : earlier.bindings) {
            const bool writes = l.access == Access::write || e.access == Access::write;
            // What the frame before has left lies in an image of its own.
            const bool isPrevious = l.access == Access::readPrevious || e.access == Access::readPrevious;
            if (writes && !isPrevious && overlap(l.resource, e.resource)) return true;
        }
    return false;
}

bool uses(const Pass& pass, ResourceIndex r, const Overlap& overlap) {
    return std::any_of(pass.bindings.begin(), pass.bindings.end(),
                       [&](const PassBinding& b) { return overlap(b.resource, r); });
}

} // namespace

void schedulePasses(const Plan& plan, const Transients& transients, bool separate,
                    std::vector<CompiledPass>& passes) {
    const Overlap overlap{transients};
    size_t lastBarrier = 0;
    for (size_t i = 0; i < passes.size(); ++i) {
        // The first barrier waits for the frame before, which had the same memory.
        passes[i].barrier = i == 0 || separate;
        for (size_t j = lastBarrier; j < i && !passes[i].barrier; ++j)
            passes[i].barrier = dependsOn(plan.passes[i], plan.passes[j], overlap);
        if (passes[i].barrier) lastBarrier = i;
    }
    const std::vector<Lifetime> lives = lifetimes(plan);
    for (size_t r = 0; r < lives.size(); ++r) {
        if (!transients.images[r].image) continue;
        // A barrier stands between the last use of its memory and its own first, as that use is a dependency.
        size_t earliest = 0;
        for (size_t i = 0; i < size_t(lives[r].first); ++i)
            if (uses(plan.passes[i], ResourceIndex(r), overlap)) earliest = i + 1;
        while (!passes[earliest].barrier) ++earliest;
        passes[earliest].beginning.push_back(ResourceIndex(r));
    }
}

} // namespace rebound::vulkan
