// SPDX-License-Identifier: MIT
// A kernel as a program of OpenGL.
#pragma once

#include "objects.hpp"
#include "state_guard.hpp"

#include <vector>

namespace rebound::opengl {

// A kernel's slots as units. Each kind counts from 0, since there may be as few as 4 image units and storage
// blocks, and slots go up to 15.
struct Units {
    int bySlot[slotCount] = {};
    UnitCounts counts;
};
Units unitsOf(const KernelInfo&);

struct ShaderProgram {
    Object program;
    Units units;
};

// The text that the driver gets: version, features, and the kernel with units in place of slots.
std::string sourceOf(const Shader&, const std::vector<int>& features, bool es);

// Fails with the driver's words where it refuses the shader.
Result<std::shared_ptr<const ShaderProgram>> buildProgram(const std::shared_ptr<const Gl>&, const Shader&,
                                                          const std::vector<int>& features);

} // namespace rebound::opengl
