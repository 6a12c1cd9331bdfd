// SPDX-License-Identifier: MIT
// Four texels become one. The coarse texel keeps all their light and area; its normal and the place where it receives
// are those of one of them, never a mean.                     [RR-7162, sec. 4; Soler and Hoel, eq. 5]. Kernel language.
#ifndef REBOUND_REDUCTION_H
#define REBOUND_REDUCTION_H

// How far two texels lie on one surface, 0 to 1: nearly Gaussians of 1 - cos of the angle between their normals (of
// standard deviation 0.5), of the voter's distance from the candidate's tangent plane (2 texels), and of the relative
// difference in depth (0.05); each is 1 / (1 + d^2 / 8)^4, d in standard deviations.
//   inverseZ       of the candidate's distance along the viewing axis                       [m^-1]
//   inverseWidth   of a texel at the candidate                                              [m^-1]
RB_FUNCTION Real resemblance(Surface candidate, Vec3 position, Surface voter, Vec3 voterPosition,
                             Real inverseZ, Real inverseWidth) {
    Real angle = Real(1.0f) - dot(candidate.normal, voter.normal);
    Real plane = dot(candidate.normal, voterPosition - position) * (inverseWidth * 0.176776695f);
    Real depth = (voter.z - candidate.z) * (inverseZ * 7.07106781f);
    Real apart = (angle * angle * 0.5f + 1.0f) * (plane * plane + 1.0f) * (depth * depth + 1.0f);
    Real product = reciprocal(min(apart, Real(1e30f)));
    product = product * product;
    return product * product;
}

// The coarse texel that stands for four fine ones; empty texels do not count.
//   fine          in order (0,0), (1,0), (0,1), (1,1)
//   coordinate    of the coarse texel's centre, full-resolution pixels
//   fineScale     full-resolution pixels a fine texel
RB_FUNCTION LevelTexel reduceFour(LevelTexel fine[4], CameraConstants camera, Vec2 coordinate,
                                  float fineScale, int reduction, int projection) {
    Vec3 position[4];
    Real area = Real(0.0f);
    Real lowZ = Real(1e30f);
    Real highZ = Real(0.0f);
    LevelTexel coarse;
    coarse.senderZ = Real(0.0f);
    coarse.radiance = Vec3(0.0f);
    RB_UNROLL
    for (int i = 0; i < 4; ++i) {
        vec2 toFine = vec2(float(i & 1) - 0.5f, float(i >> 1) - 0.5f) * fineScale;
        Vec2 fineCoordinate = Vec2(coordinate.x + toFine.x, coordinate.y + toFine.y);
        position[i] = viewPosition(viewRay(camera, fineCoordinate), fine[i].surface.z, projection);
        Real a = fine[i].surface.areaOverPi;
        area += a;
        coarse.senderZ += fine[i].senderZ * a;
        coarse.radiance += fine[i].radiance * a;
        lowZ = select(a > 0.0f, min(lowZ, fine[i].surface.z), lowZ);
        highZ = max(highZ, fine[i].surface.z);
    }
    Real inverseArea = reciprocal(max(area, Real(1e-36f)));
    coarse.senderZ *= inverseArea;
    coarse.radiance = coarse.radiance * inverseArea;

    Surface chosen = fine[0].surface;
    Vec3 chosenPosition = position[0];
    Real bestScore = Real(0.0f);
    RB_UNROLL
    for (int i = 0; i < 4; ++i) {
        Surface s = fine[i].surface;
        Real inverseZ = reciprocal(max(s.z, Real(1e-30f)));
        Real score = inverseZ;
        if (reduction == reduceVoting) {
            // All four vote, each as heavy as its area.
            Real inverseWidth = inverseTexelWidth(camera, inverseZ, fineScale, projection);
            score = s.areaOverPi;
            RB_UNROLL
            for (int j = 1; j < 4; ++j) {
                Surface voter = fine[i ^ j].surface;
                score += voter.areaOverPi *
                         resemblance(s, position[i], voter, position[i ^ j], inverseZ, inverseWidth);
            }
        }
        score = select(s.areaOverPi > 0.0f, score, Real(0.0f));
        // By a margin: on a flat wall all four are alike, and the last bits of depth must not choose.
        Mask better = score > bestScore * 1.001f;
        chosen.normal = select(better, s.normal, chosen.normal);
        chosen.z = select(better, s.z, chosen.z);
        chosenPosition = select(better, position[i], chosenPosition);
        bestScore = select(better, score, bestScore);
    }

    // Where the chosen surface's tangent plane meets the coarse texel's own ray, but within the four depths.
    Vec2 ray = viewRay(camera, coordinate);
    Real along = chosen.normal.z;
    Real offset = dot(chosen.normal, chosenPosition);
    Real across = chosen.normal.x * ray.x + chosen.normal.y * ray.y;
    if (projection == orthographicProjection) offset -= across;
    else along += across;
    Real planeZ = offset * reciprocal(along);
    // A plane seen edge-on meets the ray anywhere.
    Real z = select(along < -1e-4f, min(max(planeZ, lowZ), highZ), chosen.z);
    Mask filled = area > 0.0f;
    coarse.surface.normal = select(filled, chosen.normal, Vec3(0.0f));
    coarse.surface.z = select(filled, z, Real(0.0f));
    coarse.surface.areaOverPi = area;
    return coarse;
}

#endif
