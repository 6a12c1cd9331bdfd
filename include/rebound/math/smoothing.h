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
    Real inverseWidth = inverseTexelWidth(camera, receiver.z, scale, projection);
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
        Real inTexels = planeDistance(n, own, tapRay, surface.w, projection) * inverseWidth;
        Real cosine2 = agreementOfNormals(n, Vec3(surface.x, surface.y, surface.z));
        float tent =
            (offset.x == 2 || offset.x == -2 ? 0.5f : 1.0f) * (offset.y == 2 || offset.y == -2 ? 0.5f : 1.0f);
        // The receiver itself is on its plane: it is the nearest.
        Real agreement = bilateralWeight(Real(1.0f), planeApartness(inTexels * inTexels), cosine2) * tent;
        Real weight = select(surface.w > 0.0f, agreement, Real(0.0f));
        sum += Vec3(light.x, light.y, light.z) * weight;
        total += weight;
    }
    return sum * reciprocal(total);
}

#endif
