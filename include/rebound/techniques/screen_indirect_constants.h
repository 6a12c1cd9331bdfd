// SPDX-License-Identifier: MIT
// What screen_indirect's kernels are told; shared by host, CPU and GPU (std140, std430).
#ifndef REBOUND_SCREEN_INDIRECT_CONSTANTS_H
#define REBOUND_SCREEN_INDIRECT_CONSTANTS_H

#include "rebound/techniques/projection_feature.h"

// Features' values.
const int reduceNearest = 0;
const int reduceVoting = 1;
const int discFormFactor = 0;
const int pointFormFactor = 1;
const int unsmoothed = 0;
const int smoothed = 1;

struct ReduceConstants {
    ivec4 extent; // .xy of the level written [texels]
    vec4 scale;   // .x full-resolution pixels a texel of the level read; .y minimum cosine of pixel areas
};

struct GatherConstants {
    ivec4
        extent; // .xy of the level [texels], .z samples a texel, .w the same or, where all texels share a pattern, 0
    vec4 scale; // .x full-resolution pixels a texel
};

// A sample of a ring: what lies at the offset stands for weight texels.
struct RingSample {
    ivec2 offset; // [texels]
    float weight; // [texels]
    float unused;
};

struct UpsampleConstants {
    ivec4
        extent; // .xy of the image written [texels], .z log2 of the coarse texels' size in texels of that image
    vec4 scale; // .x full-resolution pixels a texel of the image written, .y the same of the coarse one
};

#endif
