// SPDX-License-Identifier: MIT
// Light of a bake's grid at pixels. Kernel language, of kernels that declare what cache_grid.h asks for, and
//   RB_FEATURE    projection
//   RB_INPUT      depth, normals
//   RB_CONSTANTS  camera, world   CameraConstants, ViewToWorldConstants
#ifndef REBOUND_PIXEL_LIGHT_H
#define REBOUND_PIXEL_LIGHT_H

// Irradiance over pi [W m^-2 sr^-1]; nothing where there is no surface.
RB_FUNCTION Vec3 receivedByPixel(Pixel pixel) RB_OF_KERNEL {
    Vec4 n = fetch(normals, pixel);
    // Areas do not matter here, so neither does their smallest cosine.
    Surface receiver =
        surfaceOf(camera, pixelCenter(pixel), fetch(depth, pixel).x, Vec3(n.x, n.y, n.z), 1.0f, projection);
    Vec3 position = viewPosition(viewRay(camera, pixelCenter(pixel)), receiver.z, projection);
    return irradianceOfGrid(worldPosition(world, position), worldDirection(world, receiver.normal),
                            receiver.z > 0.0f);
}

#endif
