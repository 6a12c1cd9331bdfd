// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/shade_view_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/gbuffer.h"
#include "rebound/math/world_position.h"
#include "rebound/math/bake_packing.h"
#include "rebound/math/spherical_harmonics.h"
#include "rebound/math/cache_layout.h"
#include "rebound/math/cache_weights.h"
#include "rebound/math/composition.h"

// Indirect light of caches on surfaces, and of the grid where there are none, handed out and added to the
// picture.                                                                        [Jendersie, Kuri, Grosch, sec. 3.2]
RB_KERNEL(ShadeMapBoth)
RB_FEATURE(0, projection, 2)
RB_FEATURE(1, bands, 3)
RB_INPUT(0, depth)
RB_INPUT(1, normals)
RB_CONSTANTS(2, ShadeViewConstants, view)
RB_VALUES(3, uint, mapTexels)
RB_VALUES(4, float, caches)
RB_VALUES(5, float, places)
RB_VALUES(6, uint, bricks)
RB_VALUES(7, uint, brickCells)
RB_VALUES(8, uint, cells)
RB_VALUES(9, uint, receivers)
RB_CONSTANTS(10, CacheMapConstants, grid)
RB_INPUT(11, mapPlaces)
RB_OUTPUT(12, rgba16f, indirect)             // irradiance over pi [W m^-2 sr^-1]
RB_INPUT(13, albedo)
RB_INPUT(14, lit)
RB_OUTPUT(15, rgba16f, composed)
#include "rebound/math/cache_grid.h"
#include "rebound/math/cache_map.h"
#include "rebound/math/mapped_pixel_light.h"
RB_MAIN(pixel, grid.extent)
    Vec3 light = receivedByPixel(pixel);
    store(indirect, pixel, Vec4(light.x, light.y, light.z, Real(1.0f)));
    Vec4 a = fetch(albedo, pixel);
    Vec4 l = fetch(lit, pixel);
    Vec3 sum = composition(Vec3(l.x, l.y, l.z), Vec3(a.x, a.y, a.z), light);
    store(composed, pixel, Vec4(sum.x, sum.y, sum.z, Real(1.0f)));
RB_END_KERNEL
