// SPDX-License-Identifier: MIT
// What input_check's kernels are told; shared by host, CPU and GPU (std140).
#ifndef REBOUND_INPUT_CHECK_CONSTANTS_H
#define REBOUND_INPUT_CHECK_CONSTANTS_H

#include "rebound/techniques/projection_feature.h"
#include "rebound/techniques/reprojection_constants.h"

// Each pixel of the grid sums every grid.x-th column of every grid.y-th row, so that neighbours read neighbours.
struct TileConstants {
    ivec4 grid; // .xy of the image written [texels], .zw columns and rows that a texel sums
    vec4 size;  // .xy of the image read [pixels]
};

// Distances along the viewing axis that the projection does not clip [m].
struct PlaneConstants {
    vec4 range; // .x near, .y far, both with a margin for rounding
};

// A way to read stored depth: as stated, or as it may have been meant.
struct DepthReading {
    vec4 depth; // as CameraConstants::depth
    vec4 form;  // .x 1: the result is a distance along the pixel's ray, not along the viewing axis
};

struct MotionConstants {
    ReprojectionConstants previous; // to the picture that motion leads to
    vec4 units; // .xy, .zw and .xy of moreUnits: to pixels, as stated and the two other units
    vec4 moreUnits;
};

// Histograms count what exceeds a first bound and seven more, each so much larger than the one before.
const float firstDepthBound = 1e-3f; // [m]
const float depthBoundStep = 10.0f;
const float firstRadianceBound = 1e-5f; // [W m^-2 sr^-1]
const float radianceBoundStep = 20.0f;

#endif
