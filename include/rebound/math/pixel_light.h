// SPDX-License-Identifier: MIT
// Light of a bake's grid at pixels. Kernel language, of kernels that declare what cache_grid.h asks for, and
//   RB_FEATURE    projection
//   RB_INPUT      depth, normals
//   RB_CONSTANTS  camera, world   CameraConstants, ViewToWorldConstants
#ifndef REBOUND_PIXEL_LIGHT_H
#define REBOUND_PIXEL_LIGHT_H

struct PixelReceiver {
    Vec3 viewed;           // position in the view space of CameraConstants [m]
    Vec3 position, normal; // in the world
    Mask receives;
};

RB_FUNCTION PixelReceiver receiverAt(Pixel pixel) RB_OF_KERNEL {
    Vec4 n = fetch(normals, pixel);
    // Areas do not matter here, so neither does their smallest cosine.
    Surface surface =
        surfaceOf(camera, pixelCenter(pixel), fetch(depth, pixel).x, Vec3(n.x, n.y, n.z), 1.0f, projection);
    PixelReceiver r;
    r.viewed = viewPosition(viewRay(camera, pixelCenter(pixel)), surface.z, projection);
    r.position = worldPosition(world, r.viewed);
    r.normal = worldDirection(world, surface.normal);
    r.receives = surface.z > 0.0f;
    return r;
}

// Irradiance over pi [W m^-2 sr^-1]; nothing where there is no surface.
RB_FUNCTION Vec3 receivedByPixel(Pixel pixel) RB_OF_KERNEL {
    PixelReceiver r = receiverAt(pixel);
    return irradianceOfGrid(r.position, r.normal, r.receives);
}

// Half vectors turn by half of the angle by which directions do, so that a power of their cosine is about as sharp as a quarter of
// it around the mirror's direction.
const float exponentOfHalfVector = 0.25f;

// Mean radiance over a lobe around the direction in which a mirror would be looked through [W m^-2 sr^-1]; nothing where there
// is no surface.
//   kind   of the cosine that is raised to the exponent: mirrorLobe, of the angle off that direction; halfwayLobe, between the
//          normal and the half vector of viewer and light
RB_FUNCTION Vec3 seenThroughLobe(Pixel pixel, int kind, Real exponent) RB_OF_KERNEL {
    PixelReceiver r = receiverAt(pixel);
    Vec3 away = Vec3(Real(0.0f), Real(0.0f), Real(1.0f));
    if (projection == perspectiveProjection)
        away = r.viewed * inverseSqrt(max(dot(r.viewed, r.viewed), Real(1.2e-38f)));
    away = worldDirection(world, away);
    Vec3 direction = away - r.normal * (dot(away, r.normal) * 2.0f);
    float share = kind == halfwayLobe ? exponentOfHalfVector : 1.0f;
    return radianceOfGrid(r.position, r.normal, lobe(direction, exponent * share), r.receives);
}

#endif
