// SPDX-License-Identifier: MIT
// Light of a bake's light map at a receiver. Kernel language, of kernels that declare what cache_grid.h asks for, and
//   RB_VALUES     mapTexels   the bake's section
//   RB_CONSTANTS  grid        CacheMapConstants
#ifndef REBOUND_CACHE_MAP_H
#define REBOUND_CACHE_MAP_H

// Whether a place lies in the map; one that is no number does not. [texels]
RB_FUNCTION Mask isInMap(Vec2 place) RB_OF_KERNEL {
    return place.x >= 0.5f && place.y >= 0.5f && place.x <= float(grid.extent.z) - 0.5f &&
           place.y <= float(grid.extent.w) - 0.5f;
}

// Irradiance over pi at receivers where the mask is true, 0 elsewhere [W m^-2 sr^-1]: between the middles of four texels.
// Lanes between the same four share the loads of their caches.                    [Jendersie, Kuri, Grosch, sec. 3.2]
RB_FUNCTION Vec3 irradianceOfMap(Vec2 place, Vec3 normal, Mask receives) RB_OF_KERNEL {
    // The first texel of the four; the last but one on the far sides.
    Int column = toInt(clamp(place.x - 0.5f, Real(0.0f), Real(float(grid.extent.z) - 1.5f)));
    Int row = toInt(clamp(place.y - 0.5f, Real(0.0f), Real(float(grid.extent.w) - 1.5f)));
    Real right = place.x - 0.5f - toReal(column);
    Real below = place.y - 0.5f - toReal(row);
    Int texelOfLane = row * Int(grid.extent.z) + column;
    Harmonics lobeCoefficients = lobe(normal, Real(1.0f));
    Vec3 result = Vec3(0.0f);
    Mask waiting = receives;
    while (anyLane(waiting)) {
        int texel = firstLane(waiting, texelOfLane);
        Mask here = waiting && texelOfLane == Int(texel);
        Vec3 light = Vec3(0.0f);
        RB_UNROLL
        for (int corner = 0; corner < 4; ++corner) {
            int cache = int(mapTexels[texel + (corner & 1) + (corner >> 1) * grid.extent.z] & 0xffffffu);
            if (cache != noMapCache) {
                Real weight = ((corner & 1) == 1 ? right : Real(1.0f) - right) *
                              ((corner & 2) == 2 ? below : Real(1.0f) - below);
                light += radianceOver(cache, lobeCoefficients) * weight;
            }
        }
        // Bands that are left out leave a little less than nothing.
        result = select(here, max(light, 0.0f), result);
        waiting = waiting && !here;
    }
    return result;
}

#endif
