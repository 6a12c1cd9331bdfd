// SPDX-License-Identifier: MIT
#include "memory_plan.hpp"

#include <algorithm>

namespace rebound::opengl {
namespace {

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
        const size_t size = sizeOf(r);
        auto texture = std::ranges::find_if(memory.textures, [&](const TextureUse& t) {
            return t.isShareable && t.format == r.format && t.extent == r.extent &&
                   t.lastPass < lives[i].first;
        });
        if (texture == memory.textures.end()) {
            memory.textures.push_back({r.format, r.extent, r.name, -1, true});
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

void addHistory(const Plan& plan, MemoryPlan& memory) {
    for (size_t i = 0; i < plan.resources.size(); ++i) {
        const Resource& r = plan.resources[i];
        if (r.kind != ResourceKind::history) continue;
        memory.textureOf[i] = int(memory.textures.size());
        memory.textures.insert(memory.textures.end(), 2, {r.format, r.extent, r.name, -1, false});
        memory.use.persistent += 2 * sizeOf(r);
    }
}

void addBuffers(const Plan& plan, size_t alignment, MemoryPlan& memory) {
    std::vector<size_t> sizes; // nothing of images, which do not lie in the same memory
    for (const Resource& r : plan.resources) sizes.push_back(aligned(r.size, alignment));
    const TransientLayout transients = layoutTransients(plan, sizes, alignment);
    memory.bufferOffsets = transients.offsets;
    for (size_t i = 0; i < sizes.size(); ++i) {
        const BufferGroup group = bufferGroupOf(plan.resources[i].kind);
        if (group == BufferGroup::none || group == BufferGroup::transient) continue;
        size_t& total = memory.bufferSizes[size_t(group)];
        memory.bufferOffsets[i] = total;
        total += sizes[i];
    }
    memory.bufferSizes[size_t(BufferGroup::transient)] = transients.size;
    memory.use.transient += transients.size;
    memory.use.transientUnshared += transients.sizeUnshared;
    memory.use.persistent += memory.bufferSizes[size_t(BufferGroup::persistent)];
    memory.use.buffers = memory.bufferSizes[size_t(BufferGroup::tables)] +
                         memory.bufferSizes[size_t(BufferGroup::frameConstants)];
}

} // namespace

BufferGroup bufferGroupOf(ResourceKind kind) {
    switch (kind) {
    case ResourceKind::buffer:
        return BufferGroup::tables;
    case ResourceKind::frameConstants:
    case ResourceKind::frameState:
        return BufferGroup::frameConstants;
    case ResourceKind::transientBuffer:
        return BufferGroup::transient;
    case ResourceKind::persistentBuffer:
        return BufferGroup::persistent;
    default:
        return BufferGroup::none;
    }
}

MemoryPlan planMemory(const Plan& plan, size_t alignment) {
    MemoryPlan memory;
    shareTextures(plan, memory);
    addHistory(plan, memory);
    addBuffers(plan, alignment, memory);
    return memory;
}

GLbitfield barrierForHost(const Plan& plan) {
    GLbitfield bits = GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                      GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT;
    for (const Pass& pass : plan.passes)
        for (const PassBinding& b : pass.bindings)
            if (b.access == Access::write && !isImage(plan.resources[size_t(b.resource)].kind))
                bits |= GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT;
    return bits;
}

std::vector<GLbitfield> barriersBefore(const Plan& plan, const MemoryPlan& memory) {
    // Textures of the device first, then one for each other resource; transient buffers are one, as they may lie in the same
    // memory. What was used since the last barrier:
    struct Pending {
        bool stored = false; // must become visible to those who read
        bool used = true;    // must be over before it is overwritten; at first, by the frame before
    };
    struct Barriers {
        GLbitfield reading, writing;
    };
    constexpr Barriers ofImages{GL_TEXTURE_FETCH_BARRIER_BIT, GL_SHADER_IMAGE_ACCESS_BARRIER_BIT},
        ofBuffers{GL_SHADER_STORAGE_BARRIER_BIT, GL_SHADER_STORAGE_BARRIER_BIT};
    std::vector<Pending> images(memory.textures.size() + plan.resources.size()),
        buffers(plan.resources.size() + 1);
    // Of history the image that is written, or the one of the frame before: which is which changes with each frame, and does
    // not matter here.
    const auto pendingOf = [&](const PassBinding& b) -> Pending& {
        const Resource& r = plan.resources[size_t(b.resource)];
        if (!isImage(r.kind))
            return buffers[isTransient(r.kind) ? plan.resources.size() : size_t(b.resource)];
        const int texture = memory.textureOf[size_t(b.resource)];
        if (texture < 0) return images[memory.textures.size() + size_t(b.resource)];
        return images[size_t(texture + (b.access == Access::readPrevious ? 1 : 0))];
    };
    std::vector<GLbitfield> barriers;
    for (const Pass& pass : plan.passes) {
        GLbitfield bits = 0;
        for (const PassBinding& b : pass.bindings) {
            const Barriers& kind = isImage(plan.resources[size_t(b.resource)].kind) ? ofImages : ofBuffers;
            if (b.access != Access::write && pendingOf(b).stored) bits |= kind.reading;
            if (b.access == Access::write && pendingOf(b).used) bits |= kind.writing;
        }
        const auto settle = [bits](std::vector<Pending>& pending, const Barriers& kind) {
            for (Pending& p : pending) {
                p.stored = p.stored && !(bits & kind.reading);
                p.used = p.used && !(bits & kind.writing);
            }
        };
        settle(images, ofImages);
        settle(buffers, ofBuffers);
        for (const PassBinding& b : pass.bindings) {
            pendingOf(b).used = true;
            pendingOf(b).stored = pendingOf(b).stored || b.access == Access::write;
        }
        barriers.push_back(bits);
    }
    return barriers;
}

} // namespace rebound::opengl
