// SPDX-License-Identifier: MIT
// From view space to the world. Kernel language.
#ifndef REBOUND_WORLD_POSITION_H
#define REBOUND_WORLD_POSITION_H

RB_FUNCTION Real turned(vec4 row, Vec3 v) { return v.x * row.x + v.y * row.y + v.z * row.z; }

// Of a direction in the view space of CameraConstants.
RB_FUNCTION Vec3 worldDirection(ViewToWorldConstants world, Vec3 direction) {
    return Vec3(turned(world.x, direction), turned(world.y, direction), turned(world.z, direction));
}

// Of a position there [m].
RB_FUNCTION Vec3 worldPosition(ViewToWorldConstants world, Vec3 position) {
    return worldDirection(world, position) + Vec3(Real(world.x.w), Real(world.y.w), Real(world.z.w));
}

#endif
