// SPDX-License-Identifier: MIT
// The SDK's input check (docs/input_check.md) on a frame of the lab.
#pragma once

#include "lab/rays/frame.hpp"
#include "rebound/techniques/input_check.hpp"

#include <vector>

namespace rebound::examine {

// What does not fit together in a frame, as a technique would get it; nothing where all is well. Motion is held against
// depth and both cameras, as if nothing but the camera moved. Runs on the CPU;
// threads: 0: one a core. Fails where the frame is not complete, or memory runs out.
Result<std::vector<InputFinding>> examineFrame(const lab::Frame&, int threads);

} // namespace rebound::examine
