// SPDX-License-Identifier: MIT
// What kernels know of a frame's camera; shared by host, CPU and GPU (std140). Filled by cameraConstants().
#ifndef REBOUND_CAMERA_CONSTANTS_H
#define REBOUND_CAMERA_CONSTANTS_H

// Kernels work in a view space whose z is the distance along the viewing axis; x and y are the engine's.
struct CameraConstants {
    vec4 ray;     // .xy per pixel and .zw at pixel coordinate 0: x, y at z = 1, or, orthographic, x, y [m]
    vec4 depth;   // z = (.x + .y * stored) / (.z + .w * stored) [m]
    vec4 normalX; // rows of the rotation from the stored normal to view space, .w: added to that component
    vec4 normalY;
    vec4 normalZ;
    vec4 empty; // .x: the stored depth of a pixel without surface
};

#endif
