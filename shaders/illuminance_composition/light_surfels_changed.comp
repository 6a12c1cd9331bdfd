// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/illuminance_composition_constants.h"
#include "rebound/math/radiance.h"
#include "rebound/math/bake_packing.h"

// As light_surfels, for surfels whose light is not what it was.
RB_ITEM_KERNEL(LightSurfelsChanged)
RB_FEATURE(0, emission, 3)
RB_VALUES(0, uint, surfels)
RB_VALUES(1, float, surfelLight)
RB_OUTPUT_VALUES(2, float, nodes)
RB_CONSTANTS(3, LightSurfelsConstants, k)
RB_VALUES(11, float, surfelEmission)
RB_VALUES(12, float, nodesBefore)
RB_VALUES(13, float, keptBefore)
RB_OUTPUT_VALUES(14, float, kept)
RB_VALUES(15, float, settled)
#include "rebound/math/surfel_numbers.h"
#include "rebound/math/surfel_light.h"
#include "rebound/math/surfel_changes.h"
RB_ITEM_MAIN(item, k.counts.x)
    Mask isLit = isToBeLit(item);
    Mask changed = isLit;
    if (anyLane(isLit)) {
        Vec3 sent = sentBySurfel(item, Vec3(0.0f));
        changed = hasChanged(item, sent);
        storeSent(item, sent);
        keepHandedIn(item);
    }
    storeChange(item, changed);
RB_END_KERNEL
