// SPDX-License-Identifier: MIT
// Light at pixels, of which static ones have a place in a bake's light map, and others have its grid. Kernel language, of
// kernels that declare what cache_map.h asks for, and
//   RB_FEATURE    projection
//   RB_INPUT      depth, normals, mapPlaces   the last in texels of the map; outside of it, such as negative: the grid
//   RB_CONSTANTS  view                        ShadeViewConstants
#ifndef REBOUND_MAPPED_PIXEL_LIGHT_H
#define REBOUND_MAPPED_PIXEL_LIGHT_H

// Irradiance over pi [W m^-2 sr^-1]; nothing where there is no surface.
RB_FUNCTION Vec3 receivedByPixel(Pixel pixel) RB_OF_KERNEL {
    Vec4 n = fetch(normals, pixel);
    Vec4 m = fetch(mapPlaces, pixel);
    // Areas do not matter here, so neither does their smallest cosine.
    Surface receiver = surfaceOf(view.camera, pixelCenter(pixel), fetch(depth, pixel).x, Vec3(n.x, n.y, n.z),
                                 1.0f, projection);
    Vec3 normal = worldDirection(view.world, receiver.normal);
    Mask receives = receiver.z > 0.0f;
    Vec2 place = Vec2(m.x, m.y);
    Mask mapped = receives && isInMap(place);
    Vec3 light = irradianceOfMap(place, normal, mapped);
    Mask others = receives && !mapped;
    if (anyLane(others)) {
        Vec3 position = viewPosition(viewRay(view.camera, pixelCenter(pixel)), receiver.z, projection);
        light += irradianceOfGrid(worldPosition(view.world, position), normal, others);
    }
    return light;
}

#endif
