// SPDX-License-Identifier: MIT
// Points of one camera's view space in another picture. Kernel language.
#ifndef REBOUND_REPROJECTION_H
#define REBOUND_REPROJECTION_H

// A row's product with (p, 1).
RB_FUNCTION Real rowProduct(vec4 row, Vec3 p) { return p.x * row.x + p.y * row.y + p.z * row.z + row.w; }

// .x / .z and .y / .z: pixel coordinates in the other picture; .z: w, which is positive in front of its camera.
//   position   view space of CameraConstants [m]
RB_FUNCTION Vec3 reprojected(ReprojectionConstants k, Vec3 position) {
    return Vec3(rowProduct(k.x, position), rowProduct(k.y, position), rowProduct(k.w, position));
}

#endif
