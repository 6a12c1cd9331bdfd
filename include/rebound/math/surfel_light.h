// SPDX-License-Identifier: MIT
// What a surfel sends. Kernel language, of kernels for surfels that declare
//   RB_FEATURE            emission      whether the bake's emission is sent too
//   RB_VALUES             surfels       the bake's section
//                         surfelLight   direct irradiance over pi, [3][surfel]
//   RB_OUTPUT_VALUES      nodes         by node, flux over pi of three colours and 0
//   RB_CONSTANTS          k             LightSurfelsConstants
#ifndef REBOUND_SURFEL_LIGHT_H
#define REBOUND_SURFEL_LIGHT_H

// Number `kind` of the surfel.
RB_FUNCTION UInt surfelNumber(Item item, int kind) RB_OF_KERNEL {
    return loadOffset(surfels, item, kind * k.counts.y);
}

RB_FUNCTION Vec3 surfelPosition(Item item) RB_OF_KERNEL {
    return Vec3(uintBitsToFloat(surfelNumber(item, 0)), uintBitsToFloat(surfelNumber(item, 1)),
                uintBitsToFloat(surfelNumber(item, 2)));
}

RB_FUNCTION Vec3 surfelNormal(Item item) RB_OF_KERNEL { return unpackOctahedral(surfelNumber(item, 3)); }

// Writes radiance times area: what the host hands in is made sound here, and no sum over surfels can overflow, since
// caches would keep for ever what is no number.
//   indirect   irradiance over pi [W m^-2 sr^-1]
RB_FUNCTION void sendLight(Item item, Vec3 indirect) RB_OF_KERNEL {
    Vec3 direct = soundRadiance(Vec3(loadItem(surfelLight, item), loadOffset(surfelLight, item, k.counts.y),
                                     loadOffset(surfelLight, item, 2 * k.counts.y)));
    Vec3 radiance = unpackAlbedo(surfelNumber(item, 5)) * (direct + indirect);
    if (emission == withEmission) radiance += unpackEmission(surfelNumber(item, 6));
    Vec3 sent = soundRadiance(radiance) * uintBitsToFloat(surfelNumber(item, 4));
    storeFour(nodes, item, indexOf(item), Vec4(sent.x, sent.y, sent.z, Real(0.0f)));
    Mask isFirst = indexOf(item) == Int(0);
    if (anyLane(isFirst)) storeFour(nodes, item, select(isFirst, Int(k.counts.z), Int(-1)), Vec4(0.0f));
}

#endif
