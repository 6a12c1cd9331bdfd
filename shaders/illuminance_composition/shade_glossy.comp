// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/illuminance_composition_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/gbuffer.h"
#include "rebound/math/world_position.h"
#include "rebound/math/bake_packing.h"
#include "rebound/math/spherical_harmonics.h"
#include "rebound/math/sound_exponent.h"
#include "rebound/math/cache_layout.h"
#include "rebound/math/cache_weights.h"

// Mean radiance that pixels see of the caches through a lobe.                [Jendersie, Kuri, Grosch, sec. 3.2, app. B]
RB_KERNEL(ShadeGlossy)
RB_FEATURE(0, projection, 2)
RB_FEATURE(1, bands, 3)
RB_INPUT(0, depth)
RB_INPUT(1, normals)
RB_CONSTANTS(2, CameraConstants, camera)
RB_CONSTANTS(3, ViewToWorldConstants, world)
RB_VALUES(4, float, caches)
RB_VALUES(5, float, places)
RB_VALUES(6, uint, bricks)
RB_VALUES(7, uint, brickCells)
RB_VALUES(8, uint, cells)
RB_VALUES(9, uint, receivers)
RB_CONSTANTS(10, CacheGridConstants, grid)
RB_CONSTANTS(11, GlossyConstants, k)
RB_OUTPUT(12, rgba16f, glossy)               // [W m^-2 sr^-1]
RB_INPUT(13, exponents)
#include "rebound/math/cache_grid.h"
#include "rebound/math/pixel_light.h"
RB_MAIN(pixel, k.extent)
    Real exponent = Real(k.exponent.x);
    if (k.lobe.y == exponentOfPixel) exponent = fetch(exponents, pixel).x;
    Vec3 radiance = seenThroughLobe(pixel, k.lobe.x, soundExponent(exponent));
    store(glossy, pixel, Vec4(radiance.x, radiance.y, radiance.z, Real(1.0f)));
RB_END_KERNEL
