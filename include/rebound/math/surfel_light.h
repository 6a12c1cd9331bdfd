// SPDX-License-Identifier: MIT
// What a surfel sends. Kernel language, of kernels for surfels that include surfel_numbers.h and declare
//   RB_FEATURE            emission      whether emission is sent too, and whose
//   RB_VALUES             surfels       the bake's section
//                         surfelLight   direct irradiance over pi, [3][surfel]
//                         surfelEmission   of the frame, [3][surfel]; read with withEmissionOfFrame alone
//   RB_OUTPUT_VALUES      nodes         by node, flux over pi of three colours and 0
//   RB_CONSTANTS          k             LightSurfelsConstants
#ifndef REBOUND_SURFEL_LIGHT_H
#define REBOUND_SURFEL_LIGHT_H

// Radiance times area: what the host hands in is made sound here, and no sum over surfels can overflow, since caches would
// keep for ever what is no number.
//   indirect   irradiance over pi [W m^-2 sr^-1]
RB_FUNCTION Vec3 sentBySurfel(Item item, Vec3 indirect) RB_OF_KERNEL {
    Vec3 direct = soundRadiance(Vec3(loadItem(surfelLight, item), loadOffset(surfelLight, item, k.counts.y),
                                     loadOffset(surfelLight, item, 2 * k.counts.y)));
    Vec3 radiance = unpackAlbedo(surfelNumber(item, 5)) * (direct + indirect);
    if (emission == withEmission) radiance += unpackEmission(surfelNumber(item, 6));
    if (emission == withEmissionOfFrame)
        radiance +=
            soundRadiance(Vec3(loadItem(surfelEmission, item), loadOffset(surfelEmission, item, k.counts.y),
                               loadOffset(surfelEmission, item, 2 * k.counts.y)));
    return soundRadiance(radiance) * uintBitsToFloat(surfelNumber(item, 4));
}

// Writes what a surfel sends, and the empty node.
RB_FUNCTION void storeSent(Item item, Vec3 sent) RB_OF_KERNEL {
    storeFour(nodes, item, indexOf(item), Vec4(sent.x, sent.y, sent.z, Real(0.0f)));
    Mask isFirst = indexOf(item) == Int(0);
    if (anyLane(isFirst)) storeFour(nodes, item, select(isFirst, Int(k.counts.z), Int(-1)), Vec4(0.0f));
}

#endif
