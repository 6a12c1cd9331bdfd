// SPDX-License-Identifier: MIT
// How a bake's sections hold vectors and colours, see BakeSection. The other way is rebound/bake/packing.hpp. Kernel
// language.
#ifndef REBOUND_BAKE_PACKING_H
#define REBOUND_BAKE_PACKING_H

// A signed number of so many bits that begins at a bit, 0 lowest: -2^(bits - 1) to 2^(bits - 1) - 1.
RB_FUNCTION Real signedBits(UInt word, int first, int bits) {
    return toReal(toInt(word << (32 - bits - first)) >> (32 - bits));
}

// The same without a sign.
RB_FUNCTION Real unsignedBits(UInt word, int first, int bits) {
    return toReal(toInt((word >> first) & UInt((1u << uint(bits)) - 1u)));
}

// A direction on the octahedron, its lower half folded out: two signed 16-bit numbers, x low. Of length 0.57 to 1.
RB_FUNCTION Vec3 octahedralDirection(UInt word) {
    Real x = signedBits(word, 0, 16) * (1.0f / 32767.0f);
    Real y = signedBits(word, 16, 16) * (1.0f / 32767.0f);
    Real z = Real(1.0f) - abs(x) - abs(y);
    Real fold = max(-z, Real(0.0f));
    return Vec3(x + select(x >= 0.0f, -fold, fold), y + select(y >= 0.0f, -fold, fold), z);
}
RB_FUNCTION Vec3 unpackOctahedral(UInt word) {
    Vec3 v = octahedralDirection(word);
    return v * inverseSqrt(dot(v, v));
}

// Reflectances of 0 to 1, 10 bits each, red low.
RB_FUNCTION Vec3 unpackAlbedo(UInt word) {
    return Vec3(unsignedBits(word, 0, 10), unsignedBits(word, 10, 10), unsignedBits(word, 20, 10)) *
           (1.0f / 1023.0f);
}

// 9 bits each and a common exponent of 5 bits, red low.    [OpenGL 4.6 core profile, section 8.5.2]
RB_FUNCTION Vec3 unpackEmission(UInt word) {
    Real scale = uintBitsToFloat(((word >> 27) + UInt(127u - 15u - 9u)) << 23);
    return Vec3(unsignedBits(word, 0, 9), unsignedBits(word, 9, 9), unsignedBits(word, 18, 9)) * scale;
}

// A position within a cell, 10 bits an axis, x low: -1 to 2 cells from its lowest corner.
RB_FUNCTION Vec3 unpackPlaceInCell(UInt word) {
    return Vec3(unsignedBits(word, 0, 10), unsignedBits(word, 10, 10), unsignedBits(word, 20, 10)) *
               (3.0f / 1023.0f) -
           Vec3(1.0f);
}

#endif
