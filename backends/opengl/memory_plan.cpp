// SPDX-License-Identifier: MIT
#include "memory_plan.hpp"

#include <algorithm>

namespace rebound::opengl {
namespace {

size_t sizeOf(Format format, Extent2D e) {
    return bytesPerTexel(format) * size_t(e.width) * size_t(e.height);
}

size_t aligned(size_t size, size_t alignment) { return (size + alignment - 1) / alignment * alignment; }

void shareTextures(const Plan& plan, MemoryPlan& memory) {
    const std::vector<Lifetime> lives = lifetimes(plan);
    std::vector<size_t> order;
    for (size_t i = 0; i < plan.resources.size(); ++i)
        if (plan.resources[i].kind == ResourceKind::transient && lives[i].last >= 0) order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return lives[a].first < lives[b].first; });
    memory.textureOf.assign(plan.resources.size(), -1);
    for (size_t i : order) {
        const Resource& r = plan.resources[i];
        const size_t size = sizeOf(r.format, r.extent);
        auto texture = std::ranges::find_if(memory.textures, [&](const TextureUse& t) {
            return t.format == r.format && t.extent == r.extent && t.lastPass < lives[i].first;
        });
        if (texture == memory.textures.end()) {
            memory.textures.push_back({r.format, r.extent, r.name, -1});
            texture = memory.textures.end() - 1;
            memory.use.transient += size;
        } else {
            texture->label += ", " + r.name;
        }
        texture->lastPass = lives[i].last;
        memory.textureOf[i] = int(texture - memory.textures.begin());
        memory.use.transientUnshared += size;
    }
}

} // namespace

MemoryPlan planMemory(const Plan& plan, size_t alignment) {
    MemoryPlan memory;
    shareTextures(plan, memory);
    for (const Resource& r : plan.resources) {
        size_t* total = r.kind == ResourceKind::buffer           ? &memory.buffers
                        : r.kind == ResourceKind::frameConstants ? &memory.frameConstants
                                                                 : nullptr;
        memory.bufferOffsets.push_back(total ? *total : 0);
        if (total) *total += aligned(r.size, alignment);
    }
    memory.use.buffers = memory.buffers + memory.frameConstants;
    return memory;
}

std::vector<GLbitfield> barriersBefore(const Plan& plan, const MemoryPlan& memory) {
    // Textures of the device first, then one for each output. What was used since the last barrier:
    struct Pending {
        bool stored = false; // must become visible to those who fetch
        bool used = true;    // must be over before it is overwritten; at first, by the frame before
    };
    std::vector<Pending> pending(memory.textures.size() + plan.resources.size());
    const auto pendingOf = [&](ResourceIndex r) -> Pending& {
        const int texture = memory.textureOf[size_t(r)];
        return pending[texture >= 0 ? size_t(texture) : memory.textures.size() + size_t(r)];
    };
    std::vector<GLbitfield> barriers;
    for (const Pass& pass : plan.passes) {
        GLbitfield bits = 0;
        for (const PassBinding& b : pass.bindings) {
            if (b.access == Access::read && pendingOf(b.resource).stored)
                bits |= GL_TEXTURE_FETCH_BARRIER_BIT;
            if (b.access == Access::write && pendingOf(b.resource).used)
                bits |= GL_SHADER_IMAGE_ACCESS_BARRIER_BIT;
        }
        for (Pending& p : pending) {
            p.stored = p.stored && !(bits & GL_TEXTURE_FETCH_BARRIER_BIT);
            p.used = p.used && !(bits & GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        }
        for (const PassBinding& b : pass.bindings) {
            pendingOf(b.resource).used = true;
            pendingOf(b.resource).stored = pendingOf(b.resource).stored || b.access == Access::write;
        }
        barriers.push_back(bits);
    }
    return barriers;
}

} // namespace rebound::opengl
