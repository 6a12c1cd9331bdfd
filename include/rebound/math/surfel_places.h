// SPDX-License-Identifier: MIT
// Places on surfels, and light averaged over them. Kernel language, of kernels for surfels that declare
//   RB_VALUES     surfels       the bake's section
//   RB_BUFFER     sources       LightSource
//   RB_BUFFER     places        SurfelPlace
//   RB_CONSTANTS  k, frame      SurfelLightConstants, SurfelLightFrameConstants
// and define, as a function or a macro,
//   Real litBySource(int source, Vec3 position, Vec3 normal)      the share that reaches a place
#ifndef REBOUND_SURFEL_PLACES_H
#define REBOUND_SURFEL_PLACES_H

// Irradiance over pi at a place on a surfel.
RB_FUNCTION Vec3 lightAtPlace(Vec3 position, Vec3 normal) RB_OF_KERNEL {
    Vec3 sum = Vec3(0.0f);
    for (int i = 0; i < min(frame.counts.x, k.limits.x); ++i) {
        LightSource source = sources[i];
        Real share = irradianceShare(source, position, normal);
        if (anyLane(share > 0.0f)) {
            share *= litBySource(i, position, normal);
            sum += Vec3(share * source.intensity.x, share * source.intensity.y, share * source.intensity.z);
        }
    }
    return sum * 0.318309886f;
}

// The same, averaged over the surfel's disc.
RB_FUNCTION Vec3 lightOnSurfel(Item item) RB_OF_KERNEL {
    Vec3 center = surfelPosition(item);
    Vec3 normal = surfelNormal(item);
    Real radius = sqrt(uintBitsToFloat(surfelNumber(item, 4)) * 0.318309886f);
    // Duff et al.: Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
    Real side = select(normal.z >= 0.0f, Real(1.0f), Real(-1.0f));
    Real a = Real(-1.0f) / (side + normal.z);
    Real b = normal.x * normal.y * a;
    Vec3 right = Vec3(side * normal.x * normal.x * a + 1.0f, side * b, -side * normal.x) * radius;
    Vec3 up = Vec3(b, normal.y * normal.y * a + side, -normal.y) * radius;
    Vec3 sum = Vec3(0.0f);
    for (int i = 0; i < k.counts.z; ++i)
        sum += lightAtPlace(center + right * places[i].place.x + up * places[i].place.y, normal);
    return sum * (1.0f / float(k.counts.z));
}

#endif
