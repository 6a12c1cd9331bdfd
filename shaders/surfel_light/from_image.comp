// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/surfel_light_constants.h"
#include "rebound/math/bake_packing.h"

// What an engine's light shader has made of the images of surfels, as their light.
RB_KERNEL(SurfelLightFromImage)
RB_FEATURE(0, meaning, 2)
RB_VALUES(0, uint, surfels)
RB_INPUT(1, image)
RB_OUTPUT_VALUES(2, float, surfelLight)      // irradiance over pi, [3][surfel] [W m^-2 sr^-1]
RB_CONSTANTS(3, SurfelImageConstants, k)
#include "rebound/math/surfel_numbers.h"
RB_MAIN(pixel, k.extent)
    Item item = itemOf(pixel, k.extent.x);
    Vec4 texel = fetch(image, pixel);
    Vec3 light = Vec3(texel.x, texel.y, texel.z);
    if (meaning == imageOfReflection) {
        // What reflects nothing sends nothing, whatever its light.
        Vec3 albedo = unpackAlbedo(surfelNumber(item, 5));
        light = Vec3(select(albedo.x > 0.0f, light.x / albedo.x, Real(0.0f)),
                     select(albedo.y > 0.0f, light.y / albedo.y, Real(0.0f)),
                     select(albedo.z > 0.0f, light.z / albedo.z, Real(0.0f)));
    }
    storeItem(surfelLight, item, light.x);
    storeOffset(surfelLight, item, k.counts.y, light.y);
    storeOffset(surfelLight, item, 2 * k.counts.y, light.z);
RB_END_KERNEL
