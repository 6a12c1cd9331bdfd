// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/illuminance_composition_constants.h"
#include "rebound/math/radiance.h"
#include "rebound/math/bake_packing.h"

// What surfels send of direct light: the leaves of the tree.            [Jendersie, Kuri, Grosch, fig. 2, step 2]
RB_ITEM_KERNEL(LightSurfels)
RB_FEATURE(0, emission, 3)
RB_VALUES(0, uint, surfels)
RB_VALUES(1, float, surfelLight)
RB_OUTPUT_VALUES(2, float, nodes)
RB_CONSTANTS(3, LightSurfelsConstants, k)
RB_VALUES(11, float, surfelEmission)
#include "rebound/math/surfel_numbers.h"
#include "rebound/math/surfel_light.h"
RB_ITEM_MAIN(item, k.counts.x)
    storeSent(item, sentBySurfel(item, Vec3(0.0f)));
RB_END_KERNEL
