// SPDX-License-Identifier: MIT
// A plan: what a technique will do, as a value. It names passes and resources before anything is allocated; a device
// compiles it, and answers what memory it takes.
#pragma once

#include "rebound/extent.hpp"
#include "rebound/result.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace rebound {

// Formats of images, as GPUs store them. A CPU stores 32-bit floats, and only the channels in use.
enum class Format { r32f, rgba16f, rgba32f };
inline constexpr size_t bytesPerTexel(Format f) {
    return f == Format::r32f ? 4 : f == Format::rgba16f ? 8 : 16;
}
inline constexpr const char* name(Format f) {
    return f == Format::r32f ? "r32f" : f == Format::rgba16f ? "rgba16f" : "rgba32f";
}

enum class ResourceKind {
    input,          // an image of the host, read
    output,         // an image of the host, written
    transient,      // an image of the device's own, that lives from its first pass to its last
    buffer,         // data that the plan holds and the device uploads once
    frameConstants, // a block of constants that the host hands in with each frame
};

struct Resource {
    std::string name;
    ResourceKind kind = ResourceKind::transient;
    Format format = Format::rgba32f; // of images; of input and output: what GPUs are advised to use
    int channels = 4;                // channels in use, 1 to 4
    Extent2D extent;                 // of images [texels]
    std::vector<std::byte> data;     // of buffers
    size_t size = 0;                 // of buffers and frame constants [bytes]
};

using ResourceIndex = int;

enum class Access { read, write };

struct PassBinding {
    int slot = 0;               // as the kernel declares it
    ResourceIndex resource = 0; // index into Plan::resources
    Access access = Access::read;
};

struct Pass {
    std::string label;         // what the pass does, for people, captures and timings; unique in a plan
    std::string kernel;        // name of the kernel, such as "screen_indirect/gather"
    std::vector<int> features; // values of the kernel's features, by their number
    std::vector<PassBinding> bindings;
    Extent2D grid; // pixels that the kernel runs for
};

struct Plan {
    std::string technique;
    std::vector<Resource> resources;
    std::vector<Pass> passes; // in order; each may read what earlier ones wrote

    ResourceIndex add(Resource resource) {
        resources.push_back(std::move(resource));
        return int(resources.size()) - 1;
    }
    // The resource of that name, or -1.
    ResourceIndex find(std::string_view name) const {
        for (size_t i = 0; i < resources.size(); ++i)
            if (resources[i].name == name) return int(i);
        return -1;
    }
};

// A buffer resource that holds the elements' bytes.
template <class T>
Resource bufferResource(std::string name, const std::vector<T>& elements) {
    static_assert(std::is_trivially_copyable_v<T>);
    Resource r{std::move(name), ResourceKind::buffer, Format::r32f, 1, {}, {}, 0};
    r.size = elements.size() * sizeof(T);
    r.data.resize(r.size);
    if (r.size > 0) std::memcpy(r.data.data(), elements.data(), r.size);
    return r;
}

// First and last pass that use a resource; first > last where none does. Of a valid plan.
struct Lifetime {
    int first = 0;
    int last = -1;
    bool overlaps(const Lifetime& other) const { return first <= other.last && other.first <= last; }
};

inline std::vector<Lifetime> lifetimes(const Plan& plan) {
    std::vector<Lifetime> result(plan.resources.size());
    for (int pass = 0; pass < int(plan.passes.size()); ++pass)
        for (const PassBinding& binding : plan.passes[size_t(pass)].bindings) {
            Lifetime& life = result[size_t(binding.resource)];
            if (life.last < 0) life.first = pass;
            life.last = pass;
        }
    return result;
}

// Where transient resources lie in one block of memory that those with disjoint lifetimes share.
struct TransientLayout {
    std::vector<size_t> offsets; // by resource; 0 for those that are not transient [bytes]
    size_t size = 0;             // of the block [bytes]
    size_t sizeUnshared = 0;     // the sum of the resources' sizes [bytes]
};

// Places the transients, largest first, each at the lowest offset that no resource alive with it overlaps.
// sizes: by resource [bytes]; those of resources that are not transient do not matter. alignment: a power of two [bytes].
inline TransientLayout layoutTransients(const Plan& plan, const std::vector<size_t>& sizes,
                                        size_t alignment) {
    const std::vector<Lifetime> lives = lifetimes(plan);
    std::vector<size_t> order;
    for (size_t i = 0; i < plan.resources.size(); ++i)
        if (plan.resources[i].kind == ResourceKind::transient && lives[i].last >= 0) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return sizes[a] > sizes[b]; });

    TransientLayout layout{std::vector<size_t>(plan.resources.size(), 0), 0, 0};
    std::vector<size_t> placed;
    for (size_t i : order) {
        const size_t size = (sizes[i] + alignment - 1) / alignment * alignment;
        std::vector<size_t> alive;
        for (size_t j : placed)
            if (lives[i].overlaps(lives[j])) alive.push_back(j);
        std::sort(alive.begin(), alive.end(),
                  [&](size_t a, size_t b) { return layout.offsets[a] < layout.offsets[b]; });
        size_t offset = 0;
        for (size_t j : alive) {
            if (offset + size <= layout.offsets[j]) break;
            offset = std::max(offset, layout.offsets[j] + (sizes[j] + alignment - 1) / alignment * alignment);
        }
        layout.offsets[i] = offset;
        layout.size = std::max(layout.size, offset + size);
        layout.sizeUnshared += size;
        placed.push_back(i);
    }
    return layout;
}

// Memory that a plan takes on a device [bytes]. Images that the host hands in are not counted.
struct MemoryUse {
    size_t transient = 0;         // the block that transients share
    size_t transientUnshared = 0; // what they would take without sharing
    size_t buffers = 0;
    size_t total() const { return transient + buffers; }
};

// Checks what every device relies on: names and labels unique, bindings in range, each transient and output written
// before it is read, never read and written by one pass, extents within 1 to maximumExtent, at most 16 slots and 4
// features.
Result<> validate(const Plan&);

// Of transients in memoryUse() [bytes].
inline constexpr size_t transientAlignment = 256;

// Memory use on a GPU that stores images tightly in the formats of the plan; a device's own answer includes its
// alignment and padding. Zero where the plan is not valid.
inline MemoryUse memoryUse(const Plan& plan) {
    std::vector<size_t> sizes;
    MemoryUse use;
    if (!validate(plan)) return use;
    for (const Resource& r : plan.resources) {
        sizes.push_back(bytesPerTexel(r.format) * size_t(r.extent.width) * size_t(r.extent.height));
        if (r.kind == ResourceKind::buffer || r.kind == ResourceKind::frameConstants) use.buffers += r.size;
    }
    const TransientLayout layout = layoutTransients(plan, sizes, transientAlignment);
    use.transient = layout.size;
    use.transientUnshared = layout.sizeUnshared;
    return use;
}

// One line a resource and a pass, for people and for comparison in tests.
std::string toText(const Plan&);

} // namespace rebound

#include "rebound/detail/plan.inl"
