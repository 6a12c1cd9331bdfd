// SPDX-License-Identifier: MIT
// A plan: what a technique will do, as a value. It names passes and resources before anything is allocated; a device
// compiles it, and answers what memory it takes.
#pragma once

#include "rebound/extent.hpp"
#include "rebound/kernel/kernel_interface.h"
#include "rebound/result.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace rebound {

inline constexpr size_t bytesPerTexel(Format f) {
    return f == Format::r32f || f == Format::r32ui ? 4 : f == Format::rgba16f ? 8 : 16;
}
inline constexpr bool isInteger(Format f) { return f == Format::r32ui || f == Format::rgba32ui; }
const char* name(Format);

enum class ResourceKind {
    input,     // an image of the host, read
    output,    // an image of the host, written
    transient, // an image of the device's own, that lives from its first pass to its last
    history, // two images of the device's own that change places with each frame: passes write one, and read
             // what the frame before left in the other
    buffer,  // data that the plan holds and the device uploads once; for tables of some kilobytes
    inputBuffer,  // a buffer of the host or of Device::createBuffer(), read; any number of programs share it
    outputBuffer, // a buffer of the host, written
    transientBuffer,  // a buffer of the device's own, that lives from its first pass to its last
    persistentBuffer, // a buffer of the device's own that keeps its contents from frame to frame
    frameConstants,   // a block of constants that the host hands in with each frame
    frameState,       // FrameState, which the device fills in
};
const char* name(ResourceKind);
inline constexpr bool isImage(ResourceKind k) {
    return k == ResourceKind::input || k == ResourceKind::output || k == ResourceKind::transient ||
           k == ResourceKind::history;
}
// Images and buffers that live within a frame, and share memory.
inline constexpr bool isTransient(ResourceKind k) {
    return k == ResourceKind::transient || k == ResourceKind::transientBuffer;
}
// What the device keeps from frame to frame.
inline constexpr bool isPersistent(ResourceKind k) {
    return k == ResourceKind::history || k == ResourceKind::persistentBuffer;
}
// Buffers of the host.
inline constexpr bool isHostBuffer(ResourceKind k) {
    return k == ResourceKind::inputBuffer || k == ResourceKind::outputBuffer;
}
inline constexpr bool isHostImage(ResourceKind k) {
    return k == ResourceKind::input || k == ResourceKind::output;
}
inline constexpr bool isWritable(ResourceKind k) {
    return k == ResourceKind::output || k == ResourceKind::outputBuffer || isTransient(k) || isPersistent(k);
}

// Data that copies of a plan and its programs share.
using SharedBytes = std::shared_ptr<const std::vector<std::byte>>;

struct Resource {
    std::string name;
    ResourceKind kind = ResourceKind::transient;
    Format format =
        Format::rgba32f; // of images; of input and output: what GPUs are advised to use. Of buffers of
                         // numbers: r32f of floats, r32ui of integers
    int channels = 4;    // channels in use, 1 to 4
    Extent2D extent;     // of images [texels]
    SharedBytes data;    // of buffers that the plan holds
    size_t size = 0;     // of buffers and constants [bytes]
};

// What kernels know of the frames before: the device's own constants, of kind frameState. As FrameState in
// rebound/kernel/frame_state.h.
Resource frameStateResource();

using ResourceIndex = int;

enum class Access {
    read,
    write,
    readPrevious, // of history: what the frame before has left; zeros in the first frame, and after Program::reset()
};

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
    int items = 0; // of a kernel for items, which has no grid: how many, 1 to maximumItems
    // It may read buffers that it writes too: elements that it does not write, or that an item reads before it writes them
    // itself.
    bool readsElsewhere = false;
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
    constexpr Format format = std::is_integral_v<T> ? Format::r32ui : Format::r32f;
    Resource r{std::move(name), ResourceKind::buffer, format, 1, {}, {}, 0};
    r.size = elements.size() * sizeof(T);
    std::vector<std::byte> bytes(r.size);
    if (r.size > 0) std::memcpy(bytes.data(), elements.data(), r.size);
    r.data = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
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
        if (isTransient(plan.resources[i].kind) && lives[i].last >= 0) order.push_back(i);
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

// Memory that a plan takes on a device [bytes]. What the host hands in is not counted, buffers of Device::createBuffer()
// neither.
struct MemoryUse {
    size_t transient = 0;         // the block that transients share
    size_t transientUnshared = 0; // what they would take without sharing
    size_t buffers = 0;           // tables and constants
    size_t persistent = 0;        // history, both images, and persistent buffers
    size_t total() const { return transient + buffers + persistent; }
};

inline constexpr int maximumItems = 1 << 30;
inline constexpr size_t maximumBufferSize = size_t(1) << 32; // [bytes]

// Checks what every device relies on: names and labels unique, bindings in range, what lives within a frame written
// before it is read, nothing read and written by one pass (but elements apart, where a pass says so), extents within 1 to maximumExtent, at most 16 slots and 4
// features.
Result<> validate(const Plan&);

// Of transients in memoryUse() [bytes].
inline constexpr size_t transientAlignment = 256;

// Of one image or buffer, tightly stored in the format of the plan [bytes].
size_t sizeOf(const Resource&);

// Memory use on a GPU that stores images tightly in the formats of the plan; a device's own answer includes its
// alignment and padding. Fails where the plan is not valid.
Result<MemoryUse> memoryUse(const Plan&);

// A resource of an appended plan that is one of the plan it joins.
struct PlanBinding {
    std::string resource; // name in the appended plan: an input, an input buffer, or constants of a frame
    std::string source;   // name in the plan that it joins, as it is there
};

struct AppendOptions {
    std::string
        prefix; // before names of what the appended plan has of its own: images, buffers, labels of passes
    std::string hostPrefix; // before names of what the host hands in or out, and of frame constants
    std::vector<PlanBinding> bindings;
};

// Lets one plan run behind another, in one frame and one block of memory: another technique, or the same for another
// camera. What the host hands in under the same name and of the same kind becomes one; bindings make an image or buffer of
// the first plan, such as its output, an input of the appended one. Inputs are prepared for each plan as ever and joined by
// append(FrameInputs&, ...). Fails, and changes nothing, where names or labels clash, sizes or kinds differ, or a name is
// unknown.
Result<> append(Plan& plan, const Plan& appended, const AppendOptions& = {});

// An output that the host does not want, as it is bound to an appended plan, becomes a transient. Fails where the plan has
// no output of that name.
Result<> keepInside(Plan&, std::string_view output);

// One line a resource and a pass, for people and for comparison in tests.
std::string toText(const Plan&);

} // namespace rebound

// In this order, which blank lines keep.
#include "rebound/detail/plan.inl"

#include "rebound/detail/append.inl"
