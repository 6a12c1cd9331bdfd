// SPDX-License-Identifier: MIT
// Loops over independent items on several threads, cut into the same chunks for any number of them.
#pragma once

#include <cstddef>
#include <functional>

namespace rebound::detail {

// Calls body(first, last) once for each chunk of [0, count), in no order, and returns when all are done. Chunks are
// `chunk` items long, the last one shorter: what a body keeps for its chunk does not depend on the number of threads.
// threads: 0: one a core; where the system refuses to start as many, fewer do. What a body throws ends the loop and is
// thrown here.
void parallelFor(size_t count, int threads, const std::function<void(size_t first, size_t last)>& body,
                 size_t chunk = 1024);

} // namespace rebound::detail
