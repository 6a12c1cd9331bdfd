// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/illuminance_composition_constants.h"
#include "rebound/techniques/cache_update_feature.h"
#include "rebound/math/bake_packing.h"
#include "rebound/math/spherical_harmonics.h"
#include "rebound/math/cache_layout.h"
#include "rebound/math/settled_light.h"

// Radiance that caches receive through their links: the sum of flux times link, as coefficients of spherical harmonics.
//                                                          [Jendersie, Kuri, Grosch, eq. 4 and fig. 2, step 4]
RB_ITEM_KERNEL(LightCaches)
RB_FEATURE(0, bands, 3)
RB_FEATURE(1, form, 2)
RB_FEATURE(2, update, cacheUpdateCount)
RB_VALUES(0, float, nodes)
RB_VALUES(1, uint, linkNodes)
RB_VALUES(2, float, linkFactors)
RB_VALUES(3, uint, linkShapes)
RB_OUTPUT_VALUES(4, float, caches)
RB_CONSTANTS(5, LightCachesConstants, k)
RB_VALUES(6, float, settled)                 // 1: surfels sent the same in the frame before
RB_VALUES(7, float, cachesBefore)            // the same as caches
RB_ITEM_MAIN(item, k.counts.x)
    if (update == anewUnlessSettled || update == closeUnlessSettled) {
        if (settled[0] != 0.0f) return;
    }
    const int coefficients = (bands + 2) * (bands + 2);
    // Coefficients form: bits of a coefficient, how many are in a word, and words of a link.
    const int bits = bands == 0 ? 10 : 8;
    const int inWord = bands == 0 ? 3 : 4;
    int floats = floatsOfCache(bands);
    const int words = form == directionLinks || bands == 0 ? 1 : bands == 1 ? 2 : 4;
    Real sum[3 * maximumHarmonics];
    RB_UNROLL
    for (int i = 0; i < floats; ++i) sum[i] = Real(0.0f);
    // Links of 16 caches lie one behind the other.
    int firstLink = groupOf(item) * 16 * (k.counts.y - 1);
    int firstWord = groupOf(item) * 16 * (k.counts.y * words - 1);
    for (int link = 0; link < k.counts.y; ++link) {
        Vec4 flux = loadFour(nodes, toInt(loadOffset(linkNodes, item, firstLink + 16 * link)));
        Vec3 light = Vec3(flux.x, flux.y, flux.z) * loadOffset(linkFactors, item, firstLink + 16 * link);
        sum[0] += light.x;
        sum[1] += light.y;
        sum[2] += light.z;
        Harmonics shape;
        if (form == directionLinks) {
            shape = sphericalHarmonics(unpackOctahedral(loadOffset(linkShapes, item, firstWord + 16 * link)));
        } else {
            UInt shapeWords[4];
            RB_UNROLL
            for (int word = 0; word < words; ++word)
                shapeWords[word] = loadOffset(linkShapes, item, firstWord + 16 * (link * words + word));
            RB_UNROLL
            for (int i = 1; i < coefficients; ++i)
                shape.value[i] = signedBits(shapeWords[(i - 1) / inWord], (i - 1) % inWord * bits, bits);
        }
        RB_UNROLL
        for (int i = 1; i < coefficients; ++i) {
            sum[3 * i] += light.x * shape.value[i];
            sum[3 * i + 1] += light.y * shape.value[i];
            sum[3 * i + 2] += light.z * shape.value[i];
        }
    }
    // From steps of what is stored to coefficients: by a direction's over its first, or by the largest that there are.
    RB_UNROLL
    for (int i = 1; i < coefficients; ++i) {
        float largest = bandOf(i) == 1 ? 1.732050808f : bandOf(i) == 2 ? 2.236067977f : 2.645751311f; // sqrt(2 l + 1)
        float scale = form == directionLinks ? 3.544907702f : largest / float((1 << (bits - 1)) - 1); // 2 sqrt(pi)
        sum[3 * i] *= scale;
        sum[3 * i + 1] *= scale;
        sum[3 * i + 2] *= scale;
    }
    Int first = indexOf(item) * Int(floats / 4);
    Mask isKept = Real(1.0f) < Real(0.0f);
    if (update == keptIfClose || update == closeUnlessSettled) {
        isKept = Real(0.0f) < Real(1.0f);
        RB_UNROLL
        for (int i = 0; i < floats / 4; ++i) {
            Vec4 before = loadFour(cachesBefore, first + Int(i));
            isKept = isKept && isClose(sum[4 * i], before.x, sum[4 * i % 3]) &&
                     isClose(sum[4 * i + 1], before.y, sum[(4 * i + 1) % 3]) &&
                     isClose(sum[4 * i + 2], before.z, sum[(4 * i + 2) % 3]) &&
                     isClose(sum[4 * i + 3], before.w, sum[(4 * i + 3) % 3]);
        }
    }
    RB_UNROLL
    for (int i = 0; i < floats / 4; ++i)
        storeFour(caches, item, select(isKept, Int(-1), first + Int(i)),
                  Vec4(sum[4 * i], sum[4 * i + 1], sum[4 * i + 2], sum[4 * i + 3]));
RB_END_KERNEL
