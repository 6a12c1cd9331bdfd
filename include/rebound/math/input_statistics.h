// SPDX-License-Identifier: MIT
// What is measured of a G-buffer to tell whether it is what its host says. Kernel language.
#ifndef REBOUND_INPUT_STATISTICS_H
#define REBOUND_INPUT_STATISTICS_H

// 1 where the mask is true, else 0: sums of it count.
RB_FUNCTION Real count(Mask m) { return select(m, Real(1.0f), Real(0.0f)); }

RB_FUNCTION Real largest(Vec3 v) { return max(max(v.x, v.y), v.z); }

RB_FUNCTION Real smallest(Vec3 v) { return min(min(v.x, v.y), v.z); }

// Whether a pixel lies inside an image, but for a margin.                                       [pixels]
RB_FUNCTION Mask liesInside(Vec2 coordinate, vec4 size, float margin) {
    return coordinate.x > margin && coordinate.y > margin && coordinate.x < size.x - margin &&
           coordinate.y < size.y - margin;
}

// Whether stored depth is a surface's, whatever the normal is.
RB_FUNCTION Mask holdsSurface(CameraConstants camera, Real storedDepth) {
    Real z = linearDepth(camera, storedDepth);
    return isFinite(storedDepth) && isFinite(z) && z > 1e-6f && z < 1e7f && !(storedDepth == camera.empty.x);
}

// The surface at a pixel as the techniques take it; areas do not matter here.
RB_FUNCTION Surface plainSurface(CameraConstants camera, Vec2 coordinate, Vec4 storedDepth, Vec4 storedNormal,
                                 int projection) {
    return surfaceOf(camera, coordinate, storedDepth.x, Vec3(storedNormal.x, storedNormal.y, storedNormal.z),
                     1.0f, projection);
}

// The point of a pixel under a reading of its depth; z is 0 where there is none.
RB_FUNCTION Vec3 readPosition(DepthReading reading, CameraConstants camera, Vec2 coordinate, Real stored,
                              int projection) {
    Vec2 ray = viewRay(camera, coordinate);
    Real denominator = stored * reading.depth.w + reading.depth.z;
    Real z = (stored * reading.depth.y + reading.depth.x) / denominator;
    if (reading.form.x > 0.5f && projection == perspectiveProjection)
        z = z * inverseSqrt(dot(ray, ray) + 1.0f);
    // Depth that was cleared is at either end of its range.
    Mask valid = isFinite(z) && z > 1e-6f && z < 1e7f && !(stored == 0.0f) && !(stored == 1.0f);
    return viewPosition(ray, select(valid, z, Real(0.0f)), projection);
}

RB_FUNCTION Vec3 unitOrZero(Vec3 v) {
    Real v2 = dot(v, v);
    Mask valid = isFinite(v2) && v2 > 1e-20f;
    return select(valid, v * inverseSqrt(select(valid, v2, Real(1.0f))), Vec3(0.0f));
}

// Light at the edge between two albedos on one surface, for one channel.
//   .x 1 where it can be judged: albedos apart by a factor of 1.5 to 8, and light on both
//   .y 1 where light hardly follows albedo: its ratio is nearer to 1 than to the albedos' ratio
//   .z 1 where it follows too much: its ratio is nearer to the square of the albedos' ratio
RB_FUNCTION Vec3 edgeVote(Real albedo, Real otherAlbedo, Real light, Real otherLight) {
    Mask isHigher = albedo > otherAlbedo;
    Real high = select(isHigher, albedo, otherAlbedo);
    Real low = select(isHigher, otherAlbedo, albedo);
    Real lightOfHigh = select(isHigher, light, otherLight);
    Real lightOfLow = select(isHigher, otherLight, light);
    Mask judged =
        low > 0.02f && high > low * 1.5f && high < low * 8.0f && lightOfLow > 0.0f && lightOfHigh > 0.0f;
    // Nearer in logarithms: light's ratio against the albedos' ratio to the powers 1/2 and 3/2, all squared.
    Real ratio = lightOfHigh / select(judged, lightOfLow, Real(1.0f));
    Real albedoRatio = high / select(judged, low, Real(1.0f));
    Real ratio2 = ratio * ratio;
    return Vec3(count(judged), count(judged && ratio2 < albedoRatio),
                count(judged && ratio2 > albedoRatio * albedoRatio * albedoRatio));
}

// A nearly black surface beside one that is not: .x 1 where a pair is one, .y 1 where the black one is more than half as
// bright. By diffuse light it would be a fifth as bright at most, in the same light.
RB_FUNCTION Vec2 darkVote(Vec3 albedo, Vec3 otherAlbedo, Vec3 light, Vec3 otherLight) {
    Real a = largest(albedo);
    Real b = largest(otherAlbedo);
    Real la = light.x + light.y + light.z;
    Real lb = otherLight.x + otherLight.y + otherLight.z;
    Mask first = a < 0.02f && b > 0.1f && lb > 0.0f;
    Mask second = b < 0.02f && a > 0.1f && la > 0.0f;
    return Vec2(count(first || second), count((first && la > lb * 0.5f) || (second && lb > la * 0.5f)));
}

// 1 where a motion vector, once in pixels, is the expected one up to half a pixel or a tenth.
RB_FUNCTION Real motionAgrees(Vec2 motion, Real scaleX, Real scaleY, Vec2 expected, Mask judged) {
    Vec2 off = Vec2(motion.x * scaleX - expected.x, motion.y * scaleY - expected.y);
    Real tolerance2 = max(dot(expected, expected) * 0.01f, Real(0.25f));
    return count(judged && dot(off, off) < tolerance2);
}

#endif
