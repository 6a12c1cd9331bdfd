// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/surfel_light_constants.h"
#include "rebound/math/bake_packing.h"
#include "rebound/math/light_sources.h"

// Direct light on surfels, of sources with and without shadow maps.    [Jendersie, Kuri, Grosch, fig. 2, step 1]
RB_ITEM_KERNEL(SurfelLightShadowed)
RB_FEATURE(0, maps, 4)
RB_VALUES(0, uint, surfels)
RB_BUFFER(1, LightSource, sources)
RB_BUFFER(2, SurfelPlace, places)
RB_CONSTANTS(3, SurfelLightConstants, k)
RB_CONSTANTS(4, SurfelLightFrameConstants, frame)
RB_OUTPUT_VALUES(5, float, surfelLight)      // irradiance over pi, [3][surfel] [W m^-2 sr^-1]
RB_BUFFER(6, ShadowView, views)
RB_INPUT(7, map0)
RB_INPUT(8, map1)
RB_INPUT(9, map2)
RB_INPUT(10, map3)
#include "rebound/math/shadow_views.h"
// Views that the buffer does not hold hide nothing.
RB_FUNCTION Real litBySource(int source, Vec3 position, Vec3 normal) RB_OF_KERNEL {
    int first = sources[source].kind.y;
    int count = sources[source].kind.z;
    if (first < 0 || first >= k.limits.y || count > k.limits.y - first) count = 0;
    return litByViews(first, count, position, normal);
}
#include "rebound/math/surfel_numbers.h"
#include "rebound/math/surfel_places.h"
RB_ITEM_MAIN(item, k.counts.x)
    Vec3 light = lightOnSurfel(item);
    storeItem(surfelLight, item, light.x);
    storeOffset(surfelLight, item, k.counts.y, light.y);
    storeOffset(surfelLight, item, 2 * k.counts.y, light.z);
RB_END_KERNEL
