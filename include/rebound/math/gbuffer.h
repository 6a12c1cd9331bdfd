// SPDX-License-Identifier: MIT
// A host's G-buffer texel as Rebound uses it. Kernel language.
#ifndef REBOUND_GBUFFER_H
#define REBOUND_GBUFFER_H

// The surface behind stored depth and normal; empty where depth says so, where it is not in front of the eye by 1e-6 to
// 1e7 m, and where depth or normal is not a number or the normal has no direction.
RB_FUNCTION Surface surfaceOf(CameraConstants camera, Vec2 pixelCoordinate, Real storedDepth,
                              Vec3 storedNormal, float minimumCosine, int projection) {
    Real z = linearDepth(camera, storedDepth);
    Vec3 n = viewNormal(camera, storedNormal);
    Real n2 = dot(n, n);
    // A normal that is off by more than a factor of a thousand is no normal; squares of areas must stay floats.
    Mask valid = isFinite(storedDepth) && isFinite(z) && z > 1e-6f && z < 1e7f &&
                 !(storedDepth == camera.empty.x) && isFinite(n2) && n2 > 1e-6f && n2 < 1e6f;
    z = select(valid, z, Real(1.0f));
    n = select(valid, n * inverseSqrt(select(valid, n2, Real(1.0f))), Vec3(0.0f, 0.0f, -1.0f));
    Vec3 position = viewPosition(viewRay(camera, pixelCoordinate), z, projection);
    Real area = pixelArea(camera, position, n, minimumCosine, projection);

    Surface s;
    s.normal = select(valid, n, Vec3(0.0f));
    s.z = select(valid, z, Real(0.0f));
    s.areaOverPi = select(valid, area * 0.318309886f, Real(0.0f));
    return s;
}

// A pixel as a level's texel; empty where it has no surface, or its radiance is not a number. Negative radiance is none.
RB_FUNCTION LevelTexel texelOf(CameraConstants camera, Vec2 pixelCoordinate, Vec4 storedDepth,
                               Vec4 storedNormal, Vec4 radiance, float minimumCosine, int projection) {
    Vec3 light = Vec3(radiance.x, radiance.y, radiance.z);
    Mask bright = isFinite3(light);
    LevelTexel t;
    t.surface = surfaceOf(camera, pixelCoordinate, storedDepth.x,
                          Vec3(storedNormal.x, storedNormal.y, storedNormal.z), minimumCosine, projection);
    t.surface.normal = select(bright, t.surface.normal, Vec3(0.0f));
    t.surface.z = select(bright, t.surface.z, Real(0.0f));
    t.surface.areaOverPi = select(bright, t.surface.areaOverPi, Real(0.0f));
    t.senderZ = t.surface.z;
    t.radiance = select(bright && t.surface.z > 0.0f, min(max(light, 0.0f), maximumRadiance), Vec3(0.0f));
    return t;
}

#endif
