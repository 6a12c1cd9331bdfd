// SPDX-License-Identifier: MIT
// Joint bilateral upsampling of a level to a finer image.                     [RR-7162, sec. 3.2]. Kernel language.
#ifndef REBOUND_UPSAMPLE_H
#define REBOUND_UPSAMPLE_H

// The coarse image's value at a receiver: bilinear over four texels, each weighed by how far its surface agrees.
//   receiver         of the pixel
//   position         of the receiver, view space                                            [m]
//   shift            log2 of the coarse texels' size in pixels; 0: the images are of one size, and nothing is filtered
//   coarseScale      full-resolution pixels a coarse texel
RB_FUNCTION Vec3 upsampled(RB_TEXTURE_ARGUMENT coarseSurfaces, RB_TEXTURE_ARGUMENT coarseLight, Pixel pixel,
                           Surface receiver, Vec3 position, CameraConstants camera, int shift,
                           float coarseScale, int projection) {
    if (shift == 0) {
        Vec4 same = fetchOffset(coarseLight, pixel, ivec2(0));
        return Vec3(same.x, same.y, same.z);
    }
    int halfTexel = 1 << (shift - 1);
    float toCoarse = 1.0f / float(1 << shift);
    Vec2 at = pixelCenter(pixel) * toCoarse - Vec2(0.5f);
    Vec2 base = Vec2(floor(at.x), floor(at.y));
    Vec2 fraction = at - base;
    Real inverseWidth =
        inverseTexelWidth(camera, reciprocal(max(receiver.z, Real(1e-30f))), coarseScale, projection);
    Vec3 n = receiver.normal;
    Real own = dot(n, position);
    Vec2 nearRay = viewRay(camera, (base + Vec2(0.5f)) * coarseScale);
    Real across = n.x * nearRay.x + n.y * nearRay.y;
    Real acrossColumn = n.x * (coarseScale * camera.ray.x);
    Real acrossRow = n.y * (coarseScale * camera.ray.y);
    Real apartness[4];
    Real share[4];              // of bilinear weight and likeness of normals
    Real nearest = Real(2e30f); // more than any
    RB_UNROLL
    for (int tap = 0; tap < 4; ++tap) {
        ivec2 offset = ivec2(tap & 1, tap >> 1);
        Vec4 surface = fetchMagnified(coarseSurfaces, pixel, ivec2(halfTexel), shift, offset - ivec2(1));
        Real tapAcross = across;
        if (offset.x == 1) tapAcross += acrossColumn;
        if (offset.y == 1) tapAcross += acrossRow;
        Real distance = planeDistance(n.z, own, tapAcross, surface.w, projection);
        apartness[tap] = select(surface.w > 0.0f, planeApartness(distance * inverseWidth), Real(4e30f));
        nearest = min(nearest, apartness[tap]);
        Real bilinear = (offset.x == 1 ? fraction.x : Real(1.0f) - fraction.x) *
                        (offset.y == 1 ? fraction.y : Real(1.0f) - fraction.y);
        share[tap] = bilinear * likenessOfNormals(n, Vec3(surface.x, surface.y, surface.z));
    }
    Vec3 sum = Vec3(0.0f);
    Real total = Real(0.0f);
    RB_UNROLL
    for (int tap = 0; tap < 4; ++tap) {
        ivec2 offset = ivec2(tap & 1, tap >> 1);
        Vec4 light = fetchMagnified(coarseLight, pixel, ivec2(halfTexel), shift, offset - ivec2(1));
        Real weight =
            select(apartness[tap] < 2e30f, share[tap] * nearness(nearest, apartness[tap]), Real(0.0f));
        sum += Vec3(light.x, light.y, light.z) * weight;
        total += weight;
    }
    return sum * reciprocal(max(total, Real(1e-30f)));
}

// What coarser levels hold for a texel of a level; nothing where it has no surface.
RB_FUNCTION Vec3 receivedByTexel(RB_TEXTURE_ARGUMENT coarseSurfaces, RB_TEXTURE_ARGUMENT coarseLight,
                                 Pixel pixel, Surface receiver, CameraConstants camera, UpsampleConstants k,
                                 int projection) {
    Vec3 position = viewPosition(viewRay(camera, pixelCenter(pixel) * k.scale.x), receiver.z, projection);
    Vec3 light = upsampled(coarseSurfaces, coarseLight, pixel, receiver, position, camera, k.extent.z,
                           k.scale.y, projection);
    return select(receiver.z > 0.0f, light, Vec3(0.0f));
}

// What the start resolution holds for a pixel of the host's; nothing where it has no surface, and, as such a pixel sends
// nothing, where its radiance is no number.
RB_FUNCTION Vec3 receivedByPixel(RB_TEXTURE_ARGUMENT startSurfaces, RB_TEXTURE_ARGUMENT startLight,
                                 Pixel pixel, Vec4 storedDepth, Vec4 storedNormal, Vec4 radiance,
                                 CameraConstants camera, UpsampleConstants k, int projection) {
    Vec3 normal = Vec3(storedNormal.x, storedNormal.y, storedNormal.z);
    // Areas do not matter here, so neither does their smallest cosine.
    Surface receiver = surfaceOf(camera, pixelCenter(pixel), storedDepth.x, normal, 1.0f, projection);
    Vec3 light = receivedByTexel(startSurfaces, startLight, pixel, receiver, camera, k, projection);
    return select(isFinite3(Vec3(radiance.x, radiance.y, radiance.z)), light, Vec3(0.0f));
}

#endif
