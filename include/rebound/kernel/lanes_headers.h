// SPDX-License-Identifier: MIT
// What lanes.h needs, to be included before the instruction set's namespace opens.
#pragma once

// GLM and xsimd get a name of their own in each file that is compiled for a particular instruction set. Otherwise the
// linker would merge their inline functions across such files, and a processor could meet instructions it lacks.
#ifdef REBOUND_ISA
#define REBOUND_JOIN_(a, b) a##_##b
#define REBOUND_JOIN(a, b) REBOUND_JOIN_(a, b)
#define glm REBOUND_JOIN(glm, REBOUND_ISA)
#define xsimd REBOUND_JOIN(xsimd, REBOUND_ISA)
#endif

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <type_traits>
#include <utility>
#ifndef REBOUND_SCALAR_LANES
#include <xsimd/xsimd.hpp>
#endif
