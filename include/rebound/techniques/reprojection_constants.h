// SPDX-License-Identifier: MIT
// Where points of one camera's view space lie in another picture; shared by host, CPU and GPU (std140). Filled by
// reprojection().
#ifndef REBOUND_REPROJECTION_CONSTANTS_H
#define REBOUND_REPROJECTION_CONSTANTS_H

// Rows whose products with (position in the view space of CameraConstants, 1) give the other picture's pixel coordinates
// times w, and w: the other camera's distance along its viewing axis for a perspective one [m], 1 for an orthographic one.
struct ReprojectionConstants {
    vec4 x;
    vec4 y;
    vec4 w;
};

#endif
