// SPDX-License-Identifier: MIT
// The camera, and where its pixels lie in the world: one block, as kernels that read much else have few slots left. Shared
// by host, CPU and GPU (std140).
#ifndef REBOUND_SHADE_VIEW_CONSTANTS_H
#define REBOUND_SHADE_VIEW_CONSTANTS_H

#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/illuminance_composition_constants.h"

struct ShadeViewConstants {
    CameraConstants camera;
    ViewToWorldConstants world;
};

#endif
