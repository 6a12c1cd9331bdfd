// SPDX-License-Identifier: MIT
// What C++ has to include before a kernel of which it takes the declarations and runs nothing: that of a GPU. Nothing that
// uses GLM may be included before it.
#pragma once

#define REBOUND_ISA declarations
#define REBOUND_CPU_LANES
#define REBOUND_SCALAR_LANES
#include "rebound/kernel/lanes_headers.h"

#include "rebound/kernel/cpu_binding.h"
#include "rebound/shaders.hpp"
