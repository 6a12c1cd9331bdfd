// SPDX-License-Identifier: MIT
// What the texels of input_check's statistics mean: rows of 16 values, written by shaders/input_check.
#pragma once

#include "rebound/techniques/input_check.hpp"

namespace rebound::detail {

enum class StatisticRow {
    values,
    levels, // histograms: eight counts of depth, eight of radiance
    geometry0,
    geometry1,
    geometry2,
    geometry3,
    geometry4,
    albedo,
    radiance,
    lit,
    motion
};
inline constexpr int depthReadingCount = 5;
inline constexpr int statisticRowCount = inputStatisticsExtent.height;
static_assert(int(StatisticRow::motion) + 1 == statisticRowCount);

// Counts of pixels; from normalNotFinite on, of those with a surface.
struct ValueStatistic {
    enum Index {
        pixels,
        depthNotFinite,
        depthNegative,
        depthAboveOne,
        depthEmpty, // as stored where there is no surface
        surfaces,
        outsidePlanes,
        depthOpposite, // exactly at the other end of device depth
        normalNotFinite,
        normalWithoutDirection,
        normalNotUnit,
        normalLength, // a sum
        unitIfSigned,
        unitIfUnsigned,
        normalWithinZeroToOne, // all components
        normalFacingAway
    };
};

// .xyz of the first three texels: rows of the correlation matrix; .w: the sum of the geometry's normals.
struct GeometryStatistic {
    enum Index {
        lengthIfSigned = 12, // sums
        lengthIfUnsigned,
        judged,  // pixels amid one smooth surface
        surfaces // pixels with a surface all around
    };
};

// Counts of surfaces.
struct AlbedoStatistic {
    enum Index { surfaces, notFinite, negative, aboveOne, white, black, sum };
};
struct LightStatistic {
    enum Index {
        surfaces,
        notFinite,
        negative,
        clipped,
        black,
        darkPairs = 6, // pairs of a nearly black surface with another
        shiningPairs,  // of these, those where the black one is bright
        edges,         // between albedos on one surface, channel by channel
        edgesWithoutAlbedo,
        edgesWithSquare
    };
};
struct MotionStatistic {
    enum Index { notFinite, moving, still, stillButMoved, agreements }; // twelve agreements
};

} // namespace rebound::detail
