// SPDX-License-Identifier: MIT
// Values of the feature by which kernels know the camera's projection; shared by host, CPU and GPU.
#ifndef REBOUND_PROJECTION_FEATURE_H
#define REBOUND_PROJECTION_FEATURE_H

const int perspectiveProjection = 0;
const int orthographicProjection = 1;

#endif
