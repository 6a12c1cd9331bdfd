// SPDX-License-Identifier: MIT
// A bake's surfels. Kernel language, of kernels for surfels that declare
//   RB_VALUES     surfels   the bake's section
//   RB_CONSTANTS  k         .counts.y: from one kind of their numbers to the next
#ifndef REBOUND_SURFEL_NUMBERS_H
#define REBOUND_SURFEL_NUMBERS_H

// Number `kind` of the surfel.
RB_FUNCTION UInt surfelNumber(Item item, int kind) RB_OF_KERNEL {
    return loadOffset(surfels, item, kind * k.counts.y);
}

RB_FUNCTION Vec3 surfelPosition(Item item) RB_OF_KERNEL {
    return Vec3(uintBitsToFloat(surfelNumber(item, 0)), uintBitsToFloat(surfelNumber(item, 1)),
                uintBitsToFloat(surfelNumber(item, 2)));
}

RB_FUNCTION Vec3 surfelNormal(Item item) RB_OF_KERNEL { return unpackOctahedral(surfelNumber(item, 3)); }

#endif
