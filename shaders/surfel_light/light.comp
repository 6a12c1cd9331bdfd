// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/surfel_light_constants.h"
#include "rebound/math/bake_packing.h"
#include "rebound/math/light_sources.h"

// Direct light on surfels, of sources that nothing hides.              [Jendersie, Kuri, Grosch, fig. 2, step 1]
RB_ITEM_KERNEL(SurfelLight)
RB_VALUES(0, uint, surfels)
RB_BUFFER(1, LightSource, sources)
RB_BUFFER(2, SurfelPlace, places)
RB_CONSTANTS(3, SurfelLightConstants, k)
RB_CONSTANTS(4, SurfelLightFrameConstants, frame)
RB_OUTPUT_VALUES(5, float, surfelLight)      // irradiance over pi, [3][surfel] [W m^-2 sr^-1]
#define litBySource(source, position, normal) Real(1.0f)
#include "rebound/math/surfel_numbers.h"
#include "rebound/math/surfel_places.h"
RB_ITEM_MAIN(item, k.counts.x)
    Vec3 light = lightOnSurfel(item);
    storeItem(surfelLight, item, light.x);
    storeOffset(surfelLight, item, k.counts.y, light.y);
    storeOffset(surfelLight, item, 2 * k.counts.y, light.z);
RB_END_KERNEL
