// SPDX-License-Identifier: MIT
// Light of a bake's grid of caches at a receiver. Kernel language, of kernels that declare
//   RB_FEATURE    bands                                                  of the caches, minus 2
//   RB_VALUES     caches, places, bricks, brickCells, cells, receivers   what light_caches writes, and the bake's sections
//   RB_CONSTANTS  grid                                                   CacheGridConstants
#ifndef REBOUND_CACHE_GRID_H
#define REBOUND_CACHE_GRID_H

// In cells from the grid's lowest corner.
RB_FUNCTION Vec3 inCells(Vec3 position) RB_OF_KERNEL {
    return (position - Vec3(Real(grid.origin.x), Real(grid.origin.y), Real(grid.origin.z))) * grid.origin.w;
}

// The whole cell of a coordinate along an axis; the nearest outside.
RB_FUNCTION Int wholeCell(Real at, int bricksAlong) RB_OF_KERNEL {
    return toInt(clamp(at, Real(0.0f), Real(float(4 * bricksAlong) - 0.5f)));
}

// A receiver's place in the grid, 10 bits an axis, x lowest.
RB_FUNCTION Int placeInGrid(Vec3 at) RB_OF_KERNEL {
    return wholeCell(at.x, grid.bricks.x) | (wholeCell(at.y, grid.bricks.y) << 10) |
           (wholeCell(at.z, grid.bricks.z) << 20);
}

// Number of the cell in effect there.
RB_FUNCTION int cellAt(int place) RB_OF_KERNEL {
    int x = place & 1023;
    int y = (place >> 10) & 1023;
    int z = place >> 20;
    int brick = ((z >> 2) * grid.bricks.y + (y >> 2)) * grid.bricks.x + (x >> 2);
    return int(brickCells[64 * int(bricks[brick]) + 16 * (z & 3) + 4 * (y & 3) + (x & 3)]);
}

struct CornerWeights {
    Real value[8]; // by corner
};

// How much of each of a cell's caches a receiver sees, by the baked receivers around; up to a factor of all.
//   local   from the cell's lowest corner [cells]
RB_FUNCTION CornerWeights visibilityInCell(int cell, Vec3 local, Vec3 normal, Mask here) RB_OF_KERNEL {
    int first = 4 * int(cells[12 * cell + 9]);
    int end = first + 4 * int(cells[12 * cell + 10]);
    CornerWeights seen;
    RB_UNROLL
    for (int corner = 0; corner < 8; ++corner) seen.value[corner] = Real(visibilityPrior * 255.0f);
    for (int i = first; i < end; i += 4) {
        Vec3 direction = octahedralDirection(UInt(receivers[i + 1]));
        Real alongNormal = max(dot(direction, normal), Real(0.0f));
        if (anyLane(here && alongNormal > 0.0f)) {
            Vec3 apart = local - unpackPlaceInCell(UInt(receivers[i]));
            Real weight = receiverWeight(direction, alongNormal, apart);
            RB_UNROLL
            for (int corner = 0; corner < 8; ++corner) {
                int share = int((receivers[i + 2 + corner / 4] >> (8 * (corner & 3))) & 255u);
                seen.value[corner] += weight * float(share);
            }
        }
    }
    return seen;
}

// How much each of a cell's caches says at a receiver, up to a factor of all; 0 where it says next to nothing, or there is
// none.
//   at   of the receiver [cells from the grid's lowest corner]
RB_FUNCTION CornerWeights cacheWeights(int cell, Vec3 at, Vec3 position, Vec3 normal,
                                       Mask here) RB_OF_KERNEL {
    int first = 12 * cell;
    int place = int(cells[first + 8]);
    Vec3 local = at - Vec3(Real(float(place & 1023)), Real(float((place >> 10) & 1023)),
                           Real(float((place >> 20) & 1023)));
    CornerWeights weights = visibilityInCell(cell, local, normal, here);
    Real x = withinCell(local.x);
    Real y = withinCell(local.y);
    Real z = withinCell(local.z);
    Vec3 inRamps = normal * (grid.origin.w / tangentRamp);
    Real own = dot(inRamps, position);
    Real total = Real(0.0f);
    RB_UNROLL
    for (int corner = 0; corner < 8; ++corner) {
        int cache = int(cells[first + corner]);
        Real weight = Real(0.0f);
        if (cache >= 0) {
            Real trilinear = ((corner & 1) == 1 ? x : Real(1.0f) - x) *
                             ((corner & 2) == 2 ? y : Real(1.0f) - y) *
                             ((corner & 4) == 4 ? z : Real(1.0f) - z);
            Real height = inRamps.x * places[4 * cache] - own + inRamps.y * places[4 * cache + 1] +
                          inRamps.z * places[4 * cache + 2];
            weight = trilinear * tangentWeight(height) * weights.value[corner];
        }
        weights.value[corner] = weight;
        total += weight;
    }
    Real least = total * negligibleShare;
    RB_UNROLL
    for (int corner = 0; corner < 8; ++corner)
        weights.value[corner] =
            select(here && weights.value[corner] > least, weights.value[corner], Real(0.0f));
    return weights;
}

// A cache's mean radiance over a lobe [W m^-2 sr^-1].
RB_FUNCTION Vec3 radianceOver(int cache, Harmonics lobeCoefficients) RB_OF_KERNEL {
    int first = cache * floatsOfCache(bands);
    Vec3 sum = Vec3(0.0f);
    RB_UNROLL
    for (int i = 0; i < (bands + 2) * (bands + 2); ++i) {
        Real c = lobeCoefficients.value[i];
        sum.x += c * caches[first + 3 * i];
        sum.y += c * caches[first + 3 * i + 1];
        sum.z += c * caches[first + 3 * i + 2];
    }
    return sum;
}

// The same of what a cell's caches say together at receivers where the mask is true.
RB_FUNCTION Vec3 lightOfCell(int cell, Vec3 at, Vec3 position, Vec3 normal, Harmonics lobeCoefficients,
                             Mask here) RB_OF_KERNEL {
    CornerWeights weights = cacheWeights(cell, at, position, normal, here);
    Vec3 sum = Vec3(0.0f);
    Real total = Real(0.0f);
    RB_UNROLL
    for (int corner = 0; corner < 8; ++corner) {
        if (anyLane(weights.value[corner] > 0.0f)) {
            sum += radianceOver(int(cells[12 * cell + corner]), lobeCoefficients) * weights.value[corner];
            total += weights.value[corner];
        }
    }
    return sum * reciprocal(max(total, Real(1e-30f)));
}

// Mean radiance over a lobe at receivers where the mask is true, 0 elsewhere [W m^-2 sr^-1]. Lanes in one cell share the
// loads of its caches: they are neighbours mostly.
RB_FUNCTION Vec3 radianceOfGrid(Vec3 position, Vec3 normal, Harmonics lobeCoefficients,
                                Mask receives) RB_OF_KERNEL {
    Vec3 at = inCells(position);
    Int placeOfLane = placeInGrid(at + normal * receiverOffset);
    Vec3 result = Vec3(0.0f);
    Mask waiting = receives;
    while (anyLane(waiting)) {
        int place = firstLane(waiting, placeOfLane);
        Mask here = waiting && placeOfLane == Int(place);
        // Bands that are left out leave a little less than nothing.
        Vec3 light = max(lightOfCell(cellAt(place), at, position, normal, lobeCoefficients, here), 0.0f);
        result = select(here, light, result);
        waiting = waiting && !here;
    }
    return result;
}

// Irradiance over pi.
RB_FUNCTION Vec3 irradianceOfGrid(Vec3 position, Vec3 normal, Mask receives) RB_OF_KERNEL {
    return radianceOfGrid(position, normal, lobe(normal, Real(1.0f)), receives);
}

#endif
