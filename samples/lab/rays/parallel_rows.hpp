// SPDX-License-Identifier: MIT
// A loop over independent rows on several threads.
#pragma once

#include "lab/rays/frame.hpp"

#include <functional>

namespace rebound::lab {

// Calls body(row) once for each row in [0, rows), in no order, and returns when all are done. threads: 0: one
// a core. What a body or the progress callback throws ends the loop and is thrown here.
void parallelRows(int rows, int threads, const Progress&, const std::function<void(int)>& body);

} // namespace rebound::lab
