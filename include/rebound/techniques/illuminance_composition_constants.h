// SPDX-License-Identifier: MIT
// What illuminance_composition's kernels are told; shared by host, CPU and GPU (std140). Counts and strides are those of
// BakeLayout.
#ifndef REBOUND_ILLUMINANCE_COMPOSITION_CONSTANTS_H
#define REBOUND_ILLUMINANCE_COMPOSITION_CONSTANTS_H

#include "rebound/techniques/projection_feature.h"

// Features' values. Of bands: how many, minus 2.
const int coefficientLinks = 0;
const int directionLinks = 1;
const int withoutEmission = 0;
const int withEmission = 1;
const int withEmissionOfFrame = 2;
const int alwaysComputed = 0;
const int skippedIfSettled = 1;

// Of a light map's texel, in its lower 24 bits: nothing arrives there.
const int noMapCache = 0xffffff;

struct LightSurfelsConstants {
    ivec4 counts; // .x surfels, .y from one kind of their numbers to the next, .z the empty node
};

// Of a stage.
struct PullConstants {
    ivec4 counts; // .x nodes, .y from one term to the next, .z the first node, .w index of its first term
    ivec4 terms;  // .x how many
};

struct LightCachesConstants {
    ivec4 counts; // .x caches, .y links of each
};

struct CacheGridConstants {
    vec4 origin;  // .xyz [m], .w cells a metre
    ivec4 bricks; // .xyz of 4 x 4 x 4 cells, along each axis
};

struct SettleConstants {
    ivec4 counts; // .x items, .y numbers of each, .z index of the first
};

// Values of GlossyConstants::lobe.
const int mirrorLobe = 0;
const int halfwayLobe = 1;
const int constantExponent = 0;
const int exponentOfPixel = 1;

struct GlossyConstants {
    ivec4 extent;  // .xy of the picture [pixels]
    ivec4 lobe;    // .x around which direction, .y where the exponent comes from
    vec4 exponent; // .x
};

// CacheGridConstants, and what a light map's kernels need beside.
struct CacheMapConstants {
    vec4 origin;
    ivec4 bricks;
    ivec4 extent; // .xy of the picture [pixels], .zw of the light map [texels]
};

struct ShadeConstants {
    ivec4 extent; // .xy of the picture [pixels]
};

// Rows whose products with (position in the view space of CameraConstants, 1) are the position in the world [m]; those of
// their .xyz with a normal are the normal there.
struct ViewToWorldConstants {
    vec4 x;
    vec4 y;
    vec4 z;
};

#endif
