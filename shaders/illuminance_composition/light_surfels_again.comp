// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/illuminance_composition_constants.h"
#include "rebound/math/radiance.h"
#include "rebound/math/bake_packing.h"
#include "rebound/math/spherical_harmonics.h"
#include "rebound/math/cache_layout.h"
#include "rebound/math/cache_weights.h"

// What surfels send of direct light, and of the light that caches received in the frame before: one bounce more a frame.
//                                                                       [Jendersie, Kuri, Grosch, fig. 2, step 2]
RB_ITEM_KERNEL(LightSurfelsAgain)
RB_FEATURE(0, emission, 3)
RB_FEATURE(1, bands, 3)
RB_VALUES(0, uint, surfels)
RB_VALUES(1, float, surfelLight)
RB_OUTPUT_VALUES(2, float, nodes)
RB_CONSTANTS(3, LightSurfelsConstants, k)
RB_VALUES(4, float, caches)
RB_VALUES(5, float, places)
RB_VALUES(6, uint, bricks)
RB_VALUES(7, uint, brickCells)
RB_VALUES(8, uint, cells)
RB_VALUES(9, uint, receivers)
RB_CONSTANTS(10, CacheGridConstants, grid)
RB_VALUES(11, float, surfelEmission)
#include "rebound/math/surfel_numbers.h"
#include "rebound/math/cache_grid.h"
#include "rebound/math/surfel_light.h"
RB_ITEM_MAIN(item, k.counts.x)
    Mask exists = indexOf(item) < Int(k.counts.x);
    storeSent(item, sentBySurfel(item, irradianceOfGrid(surfelPosition(item), surfelNormal(item), exists)));
RB_END_KERNEL
