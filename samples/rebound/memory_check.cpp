// SPDX-License-Identifier: MIT
#include "memory_check.hpp"

#include <unistd.h>

#include <cstdio>

namespace rebound::cli {

namespace {

// The frame takes 52, its outgoing radiance 12, the host's images up to 64, the outputs and one that is
// encoded 72.
constexpr double bytesPerPixel = 200.0;

} // namespace

Result<> checkMemory(Extent2D size, double perPixel, double furtherBytes) {
    const long pages = sysconf(_SC_PHYS_PAGES), pageSize = sysconf(_SC_PAGESIZE);
    if (pages <= 0 || pageSize <= 0) return {};
    const double needed = perPixel * double(size.width) * double(size.height) + furtherBytes;
    const double available = double(pages) * double(pageSize);
    if (needed <= available) return {};
    char message[160];
    std::snprintf(message, sizeof message,
                  "--size is %dx%d, which takes about %.0f GB; this machine has %.0f GB", size.width,
                  size.height, needed / 1e9, available / 1e9);
    return Error{ErrorCode::outOfMemory, message};
}

Result<> checkMemory(const runner::Backend& backend, const Plan& plan, Extent2D size) {
    const auto use = backend.memoryUse(plan);
    if (!use) return use.error();
    return checkMemory(size, bytesPerPixel, double(use->total()));
}

} // namespace rebound::cli
