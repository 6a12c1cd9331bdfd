// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/surfel_light_constants.h"
#include "rebound/math/bake_packing.h"

// Surfels as pixels, for an engine's own light shader.                  [Jendersie, Kuri, Grosch, fig. 2, step 1]
RB_KERNEL(SurfelImages)
RB_VALUES(0, uint, surfels)
RB_OUTPUT(1, rgba32f, positions)             // [m], and area [m^2]
RB_OUTPUT(2, rgba16f, normals)
RB_OUTPUT(3, rgba16f, albedo)
RB_CONSTANTS(4, SurfelImageConstants, k)
#include "rebound/math/surfel_numbers.h"
RB_MAIN(pixel, k.extent)
    Item item = itemOf(pixel, k.extent.x);
    Mask exists = indexOf(item) < Int(k.counts.x);
    Vec3 p = surfelPosition(item);
    Vec3 n = surfelNormal(item);
    Vec3 a = unpackAlbedo(surfelNumber(item, 5));
    Vec4 none = Vec4(0.0f);
    store(positions, pixel, select(exists, Vec4(p.x, p.y, p.z, uintBitsToFloat(surfelNumber(item, 4))), none));
    store(normals, pixel, select(exists, Vec4(n.x, n.y, n.z, Real(0.0f)), none));
    store(albedo, pixel, select(exists, Vec4(a.x, a.y, a.z, Real(1.0f)), none));
RB_END_KERNEL
