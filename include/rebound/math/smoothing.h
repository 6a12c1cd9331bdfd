// SPDX-License-Identifier: MIT
// Joint bilateral mean over the four sample patterns of a level. Kernel language.
#ifndef REBOUND_SMOOTHING_H
#define REBOUND_SMOOTHING_H

// A level's gathered light at a receiver: the mean over 5x5 texels, the outer ones by half, each weighed by how far its
// surface agrees. Each of the four patterns of a 2x2 block has the same share in it.
//   receiver   of the pixel
//   scale      full-resolution pixels a texel
RB_FUNCTION Vec3 smoothedGather(RB_TEXTURE_ARGUMENT surfaces, RB_TEXTURE_ARGUMENT gathered, Pixel pixel,
                                Surface receiver, CameraConstants camera, float scale, int projection) {
    Vec2 ray = viewRay(camera, pixelCenter(pixel) * scale);
    Vec3 n = receiver.normal;
    Real own = dot(n, viewPosition(ray, receiver.z, projection));
    Real inverseWidth =
        inverseTexelWidth(camera, reciprocal(max(receiver.z, Real(1e-30f))), scale, projection);
    Vec4 center = fetchOffset(gathered, pixel, ivec2(0));
    Vec3 sum = Vec3(center.x, center.y, center.z);
    Real total = Real(1.0f);
    for (int i = 0; i < 25; ++i) {
        ivec2 offset = ivec2(i % 5 - 2, i / 5 - 2);
        if (i == 12 || !reaches(surfaces, pixel, offset)) continue;
        Vec4 surface = fetchOffset(surfaces, pixel, offset);
        Vec4 light = fetchOffset(gathered, pixel, offset);
        Vec2 tapRay = Vec2(ray.x + float(offset.x) * scale * camera.ray.x,
                           ray.y + float(offset.y) * scale * camera.ray.y);
        Real distance = planeDistance(n.z, own, n.x * tapRay.x + n.y * tapRay.y, surface.w, projection);
        float tent =
            (offset.x == 2 || offset.x == -2 ? 0.5f : 1.0f) * (offset.y == 2 || offset.y == -2 ? 0.5f : 1.0f);
        // The receiver itself is on its plane: it is the nearest.
        Real agreement = likenessOfNormals(n, Vec3(surface.x, surface.y, surface.z)) *
                         nearness(Real(1.0f), planeApartness(distance * inverseWidth));
        Real weight = select(surface.w > 0.0f, agreement * tent, Real(0.0f));
        sum += Vec3(light.x, light.y, light.z) * weight;
        total += weight;
    }
    return sum * reciprocal(total);
}

#endif
