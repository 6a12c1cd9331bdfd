// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/screen_indirect_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/bilateral.h"

// A 3x3 binomial filter over texels whose surfaces agree.
RB_KERNEL(Smooth)
RB_FEATURE(0, projection, 2)
RB_TEXTURE(0, surfaces)
RB_TEXTURE(1, indirect)
RB_IMAGE(2, rgba16f, smoothed)               // irradiance over pi [W m^-2 sr^-1]
RB_CONSTANTS(3, CameraConstants, camera)
RB_CONSTANTS(4, UpsampleConstants, k)
RB_MAIN(pixel, k.extent)
    Surface receiver = unpackSurface(fetch(surfaces, pixel));
    Vec2 ray = viewRay(camera, pixelCenter(pixel) * k.scale.x);
    Vec3 position = viewPosition(ray, receiver.z, projection);
    Real inverseWidth = inverseTexelWidth(camera, receiver.z, k.scale.x, projection);
    Vec4 own = fetch(indirect, pixel);
    Vec3 sum = Vec3(own.x, own.y, own.z) * 4.0f;
    Real total = Real(4.0f);
    RB_UNROLL
    for (int i = 0; i < 9; ++i) {
        ivec2 offset = ivec2(i % 3 - 1, i / 3 - 1);
        if (i == 4) continue;
        Surface s = unpackSurface(fetchOffset(surfaces, pixel, offset));
        Vec4 light = fetchOffset(indirect, pixel, offset);
        Vec2 tapRay = Vec2(ray.x + float(offset.x) * k.scale.x * camera.ray.x,
                           ray.y + float(offset.y) * k.scale.x * camera.ray.y);
        Real planeDistance = dot(receiver.normal, viewPosition(tapRay, s.z, projection) - position) * inverseWidth;
        float binomial = offset.x * offset.y == 0 ? 2.0f : 1.0f;
        Real cosine = max(dot(receiver.normal, s.normal), Real(0.0f));
        Real agreement = bilateralWeight(Real(1.0f), planeApartness(planeDistance * planeDistance), cosine * cosine);
        Real weight = select(s.z > 0.0f, agreement * binomial, Real(0.0f));
        sum += Vec3(light.x, light.y, light.z) * weight;
        total += weight;
    }
    sum = sum * reciprocal(total);
    store(smoothed, pixel, Vec4(sum.x, sum.y, sum.z, Real(0.0f)));
RB_END_KERNEL
