// SPDX-License-Identifier: MIT
// Barriers between passes: as few as their dependencies allow.
#include "device_state.hpp"

#include <algorithm>

namespace rebound::vulkan {
namespace {

// Whether two resources may touch the same memory.
struct Overlap {
    const TransientLayout& layout;
    const std::vector<TransientImage>& images;

    bool operator()(ResourceIndex a, ResourceIndex b) const {
        if (a == b) return true;
        if (!images[size_t(a)].image || !images[size_t(b)].image) return false;
        return begin(a) < end(b) && begin(b) < end(a);
    }
    size_t begin(ResourceIndex r) const { return layout.offsets[size_t(r)]; }
    size_t end(ResourceIndex r) const { return begin(r) + size_t(images[size_t(r)].requirements.size); }
};

bool dependsOn(const Pass& later, const Pass& earlier, const Overlap& overlap) {
    for (const PassBinding& l : later.bindings)
        for (const PassBinding& e : earlier.bindings)
            if ((l.access == Access::write || e.access == Access::write) && overlap(l.resource, e.resource))
                return true;
    return false;
}

bool uses(const Pass& pass, ResourceIndex r, const Overlap& overlap) {
    return std::any_of(pass.bindings.begin(), pass.bindings.end(),
                       [&](const PassBinding& b) { return overlap(b.resource, r); });
}

} // namespace

void schedulePasses(const Plan& plan, const TransientLayout& layout,
                    const std::vector<TransientImage>& images, bool separate,
                    std::vector<CompiledPass>& passes) {
    const Overlap overlap{layout, images};
    size_t lastBarrier = 0;
    for (size_t i = 0; i < passes.size(); ++i) {
        // The first barrier waits for the frame before, which had the same memory.
        passes[i].barrier = i == 0 || separate;
        for (size_t j = lastBarrier; j < i && !passes[i].barrier; ++j)
            passes[i].barrier = dependsOn(plan.passes[i], plan.passes[j], overlap);
        if (passes[i].barrier) lastBarrier = i;
    }
    const std::vector<Lifetime> lives = lifetimes(plan);
    for (size_t r = 0; r < images.size(); ++r) {
        if (!images[r].image) continue;
        // A barrier stands between the last use of its memory and its own first, as that use is a dependency.
        size_t earliest = 0;
        for (size_t i = 0; i < size_t(lives[r].first); ++i)
            if (uses(plan.passes[i], ResourceIndex(r), overlap)) earliest = i + 1;
        while (!passes[earliest].barrier) ++earliest;
        passes[earliest].beginning.push_back(ResourceIndex(r));
    }
}

} // namespace rebound::vulkan
