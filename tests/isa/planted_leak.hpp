// SPDX-License-Identifier: MIT
// What kernels must not have: an inline function that files of different instruction sets share by name.
#pragma once

[[gnu::noinline]] inline float plantedLeak(const float* values, int count) {
    float sum = 0.0f;
    for (int i = 0; i < count; ++i) sum += values[i];
    return sum;
}
