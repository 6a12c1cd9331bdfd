// SPDX-License-Identifier: MIT
// Kernel language.
#ifndef REBOUND_COMPOSITION_H
#define REBOUND_COMPOSITION_H

// lit + albedo * E / pi: what a Lambertian surface sends out once indirect light is there.      [RR-7162, sec. 4]
RB_FUNCTION Vec3 composition(Vec3 lit, Vec3 albedo, Vec3 indirect) {
    return Vec3(lit.x + albedo.x * indirect.x, lit.y + albedo.y * indirect.y, lit.z + albedo.z * indirect.z);
}

#endif
