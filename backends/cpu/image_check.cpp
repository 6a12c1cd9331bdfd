// SPDX-License-Identifier: MIT
#include "image_check.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string>

namespace rebound::cpu {
namespace {

std::string bytes(ptrdiff_t count) { return std::to_string(count) + (count == 1 ? " byte" : " bytes"); }

// A terabyte: sums of what is addressed stay numbers.
constexpr ptrdiff_t longestStride = ptrdiff_t(1) << 40;

// One way to step through an image.
struct Axis {
    const char* name;
    ptrdiff_t stride; // [bytes]
    int count;        // of steps, the place where they begin included

    ptrdiff_t reach() const { return std::abs(stride) * (count - 1); }
};

// Channels, pixels and rows, the shortest stride first.
std::array<Axis, 3> axesOf(const Image& image) {
    std::array<Axis, 3> axes{Axis{"channel", image.channelStride, image.channels},
                             Axis{"pixel", image.pixelStride, image.extent.width},
                             Axis{"row", image.rowStride, image.extent.height}};
    const auto length = [](ptrdiff_t stride) { return stride < 0 ? 0 - size_t(stride) : size_t(stride); };
    std::stable_sort(axes.begin(), axes.end(),
                     [&](const Axis& a, const Axis& b) { return length(a.stride) < length(b.stride); });
    return axes;
}

Result<> checkShape(const Resource& r, const Image& image, const std::string& what) {
    if (!image.data) return invalidArgument(what + " has no data");
    if (image.extent != r.extent)
        return invalidArgument(what + " is " + detail::toText(image.extent) + "; " +
                               detail::toText(r.extent) + " was expected");
    if (image.channels < r.channels || image.channels > 4)
        return invalidArgument(what + " has " + std::to_string(image.channels) + " channels; " +
                               std::to_string(r.channels) + " to 4 were expected");
    if ((image.scalar == Scalar::uint32) != isInteger(r.format))
        return invalidArgument(what + " holds " +
                               (image.scalar == Scalar::uint32 ? "unsigned integers" : "floats") +
                               ", where the plan's " + name(r.format) + " was expected");
    return {};
}

// Every value lies at a multiple of its size, and has memory of its own. An input's channels may be one and the same.
Result<> checkLayout(const Resource& r, const Image& image, const std::string& what) {
    const ptrdiff_t size = sizeOf(image.scalar);
    if (const auto beyond = ptrdiff_t(reinterpret_cast<uintptr_t>(image.data) % uintptr_t(size)))
        return invalidArgument(what + " has misaligned data: its address is " + bytes(beyond) +
                               " behind a multiple of " + std::to_string(size) + "; a multiple was expected");
    ptrdiff_t taken = size; // by what the axes so far step through
    for (const Axis& axis : axesOf(image)) {
        const std::string stride = what + " has a " + axis.name + " stride of " + bytes(axis.stride);
        if (axis.stride % size != 0 || axis.stride > longestStride || axis.stride < -longestStride)
            return invalidArgument(stride + "; a multiple of " + std::to_string(size) + " within +-" +
                                   std::to_string(longestStride) + " was expected");
        const bool isRepeated =
            axis.stride == 0 && r.kind == ResourceKind::input && axis.name == std::string_view("channel");
        if (axis.count == 1 || isRepeated) continue;
        if (std::abs(axis.stride) < taken)
            return invalidArgument(stride + ", in which its texels lie on each other; at least " +
                                   bytes(taken) + " were expected");
        taken += axis.reach();
    }
    return {};
}

struct Bytes {
    intptr_t first = 0;
    ptrdiff_t count = 0;

    bool overlaps(const Bytes& other) const {
        return first < other.first + other.count && other.first < first + count;
    }
};

// From the first byte of an image to its last.
Bytes bytesOf(const Image& image) {
    Bytes range{reinterpret_cast<intptr_t>(image.data), sizeOf(image.scalar)};
    for (const Axis& axis : axesOf(image)) {
        if (axis.stride < 0) range.first -= axis.reach();
        range.count += axis.reach();
    }
    return range;
}

// The bytes that an image takes of every `period` of them, where it takes the same of each: from the first one's place
// in the period.
std::optional<Bytes> bytesOfPeriod(const Image& image, ptrdiff_t period) {
    Bytes part{bytesOf(image).first % period, sizeOf(image.scalar)};
    for (const Axis& axis : axesOf(image)) {
        if (axis.count == 1) continue;
        if (std::abs(axis.stride) < period) part.count += axis.reach();
        else if (axis.stride % period != 0) return {};
    }
    return part.count < period ? std::optional(part) : std::nullopt;
}

// Whether two images interleave, as the halves of a wide picture do, or channels of one.
bool interleaveWith(const Image& a, const Image& b, ptrdiff_t period) {
    if (period == 0) return false;
    const auto x = bytesOfPeriod(a, period), y = bytesOfPeriod(b, period);
    if (!x || !y) return false;
    const Bytes next{y->first + period, y->count}, previous{y->first - period, y->count};
    return !x->overlaps(*y) && !x->overlaps(next) && !x->overlaps(previous);
}

bool shareMemory(const Image& a, const Image& b) {
    if (!bytesOf(a).overlaps(bytesOf(b))) return false;
    const auto axes = axesOf(a);
    return std::none_of(axes.begin(), axes.end(),
                        [&](const Axis& axis) { return interleaveWith(a, b, std::abs(axis.stride)); });
}

Result<> checkAlone(const Plan& plan, size_t output, const std::vector<const Image*>& images) {
    for (size_t i = 0; i < images.size(); ++i)
        if (i != output && images[i] && shareMemory(*images[output], *images[i]))
            return invalidArgument("inputs.images: " + plan.resources[output].name + " and " +
                                   plan.resources[i].name +
                                   " share memory; an output of its own was expected");
    return {};
}

} // namespace

Result<> checkImages(const Plan& plan, const std::vector<const Image*>& images) {
    for (size_t i = 0; i < plan.resources.size(); ++i) {
        if (!images[i]) continue;
        const Resource& r = plan.resources[i];
        const std::string what = "inputs.images: " + r.name;
        if (auto valid = checkShape(r, *images[i], what); !valid) return valid.error();
        if (auto valid = checkLayout(r, *images[i], what); !valid) return valid.error();
    }
    for (size_t i = 0; i < plan.resources.size(); ++i)
        if (images[i] && plan.resources[i].kind != ResourceKind::input)
            if (auto alone = checkAlone(plan, i, images); !alone) return alone.error();
    return {};
}

} // namespace rebound::cpu
