// SPDX-License-Identifier: MIT
// What the test kernels are told; shared by tests and kernels.
#ifndef REBOUND_TEST_CONSTANTS_H
#define REBOUND_TEST_CONSTANTS_H

// Operations of the arithmetic kernel.
const int opAdd = 0;
const int opSubtract = 1;
const int opMultiply = 2;
const int opDivide = 3;
const int opNegate = 4;
const int opAddTo = 5;
const int opSubtractFrom = 6;
const int opMultiplyBy = 7;
const int opDivideBy = 8;
const int opLess = 9;
const int opGreater = 10;
const int opLessEqual = 11;
const int opGreaterEqual = 12;
const int opEqual = 13;
const int opAnd = 14;
const int opOr = 15;
const int opNot = 16;
const int opMin = 17;
const int opMax = 18;
const int opAbs = 19;
const int opSqrt = 20;
const int opFloor = 21;
const int opClamp = 22;
const int opIsFinite = 23;
const int opSelect = 24;
const int opInverseSqrt = 25;
const int opReciprocal = 26;
const int opMix = 27;
const int opIntAdd = 28;
const int opIntSubtract = 29;
const int opIntMultiply = 30;
const int opIntAnd = 31;
const int opIntOr = 32;
const int opIntShiftRight = 33;
const int opIntShiftLeft = 34;
const int opIntEqual = 35;
const int opIntLess = 36;
const int opIntGreater = 37;
const int opIntSelect = 38;
const int opRoundTrip = 39;
const int opVectors = 40;
const int opVectorSelect = 41;
const int opRoughReciprocal = 42;
const int opCount = 43;

struct GridConstants {
    ivec4 extent; // .xy of the image written [texels]
};

// Modes of the access kernel.
const int accessFetch = 0;
const int accessOffset = 1;
const int accessMinified = 2;
const int accessMagnified = 3;
const int accessAt = 4;
const int accessReaches = 5;
const int accessHost = 6;
const int accessHostOffset = 7;
const int accessHostMinified = 8;
const int accessCenter = 9;
const int accessHostQuarter = 10;
const int accessHostAt = 11;
const int accessCount = 12;

// Modes of the sparse kernel.
const int sparseFetch = 0;
const int sparseOffset = 1;
const int sparseReaches = 2;
const int sparsePlace = 3;
const int sparseModeCount = 4;

struct AccessConstants {
    ivec4 extent; // .xy of the image written [texels], .z shift, .w bias
    ivec4 offset; // .xy [texels]
};

struct LanguageConstants {
    ivec4 extent; // .xy of the image written [texels], .z number of entries of the table
    vec4 values;
};

struct TableEntry {
    vec4 value;
    ivec2 index;
    float weight;
    float unused;
};

// Modes of the kernel camera_math.
const int cameraPosition = 0;
const int cameraNormal = 1;
const int cameraArea = 2;
const int cameraSurface = 3;
const int cameraSurfaceArea = 4;
const int cameraModeCount = 5;

struct CameraMathConstants {
    ivec4 extent; // .xy of the image written [texels]
    vec4 scale;   // .x minimum cosine
};

// Modes of the kernel light_math.
const int lightDisc = 0;
const int lightPoint = 1;
const int lightBilateral = 2;
const int lightUnpacked = 3;
const int lightUnpackedArea = 4;
const int lightModeCount = 5;

// Operations of the kernel integers.
const int uintAdd = 0;
const int uintSubtract = 1;
const int uintMultiply = 2;
const int uintAnd = 3;
const int uintOr = 4;
const int uintXor = 5;
const int uintNot = 6;
const int uintShiftRight = 7;
const int uintShiftLeft = 8;
const int uintLess = 9;
const int uintGreater = 10;
const int uintEqual = 11;
const int uintSelect = 12;
const int uintToReal = 13;
const int uintFromReal = 14;
const int uintFloatBits = 15;
const int uintBitCount = 16;
const int uintToInt = 17;
const int uintFromInt = 18;
const int uintOffset = 19;
const int uintAddTo = 20;
const int uintOpCount = 21;

// Ways of the kernel numbers to reach a buffer's elements.
const int reachItem = 0;
const int reachOffset = 1;
const int reachAt = 2;
const int reachUniform = 3;
const int reachStoreOffset = 4;
const int reachStoreAt = 5;
const int reachFour = 6;
const int reachStoreFour = 7;
const int reachFirst = 8;
const int reachCount = 9;

// Modes of the kernel harmonics.
const int harmonicsAlone = 0;
const int harmonicsLobe = 1;
const int harmonicsModeCount = 2;

struct ItemConstants {
    ivec4 count; // .x of items, .y offset or stride [elements]
};

// Of the made-up technique: sums over frames of what pixels hold.
struct SumConstants {
    ivec4 extent; // .xy of the image [texels], .z their number
    vec4 share;   // .x of a frame in the mean over frames
};

#endif
