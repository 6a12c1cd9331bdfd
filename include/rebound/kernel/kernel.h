// SPDX-License-Identifier: MIT
// The kernel language: one text, compiled as GLSL for GPUs and as scalar and SIMD C++ for CPUs.
//
//   float int vec2 vec3 vec4 ivec2 ivec4   uniform: one value for all lanes
//   Real  Int Vec2 Vec3 Vec4 IVec2 Mask    varying: one value a lane; on a GPU a lane is an invocation
//
// if, for and while test uniform values only. Lanes choose with select(mask, a, b), and a loop that lanes leave at
// different times runs until !anyLane(mask). The C++ compiler holds kernels to this: a Mask is not a bool.
// docs/kernel_language.md lists every type, function and declaration.
#ifdef REBOUND_CPU_LANES
#include "rebound/kernel/kernel_cpu.h"
#else
#include "rebound/kernel/kernel_glsl.h"
#endif
