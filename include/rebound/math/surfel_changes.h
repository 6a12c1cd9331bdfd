// SPDX-License-Identifier: MIT
// Whether a surfel's light is what it was in the frame before, to the last bit. Kernel language, of kernels for surfels that
// declare what surfel_light.h asks for, and
//   RB_VALUES           nodesBefore   the same as nodes
//                       keptBefore    the same as kept
//                       settled       1: every surfel sent in the frame before what it had sent in the one before that
//   RB_OUTPUT_VALUES    kept          as the host handed it in: light, [3][surfel], whether what is sent has changed,
//                                     [surfel], and with withEmissionOfFrame emission, [3][surfel]
#ifndef REBOUND_SURFEL_CHANGES_H
#define REBOUND_SURFEL_CHANGES_H

RB_FUNCTION Mask hasSameBits(Real a, Real b) RB_OF_KERNEL { return floatBitsToUint(a) == floatBitsToUint(b); }

// Of light, and of emission.
RB_FUNCTION Mask isHandedInAgain(Item item) RB_OF_KERNEL {
    Mask same = indexOf(item) == indexOf(item);
    RB_UNROLL
    for (int c = 0; c < 3; ++c) {
        same = same && hasSameBits(loadOffset(surfelLight, item, c * k.counts.y),
                                   loadOffset(keptBefore, item, c * k.counts.y));
        if (emission == withEmissionOfFrame)
            same = same && hasSameBits(loadOffset(surfelEmission, item, c * k.counts.y),
                                       loadOffset(keptBefore, item, (4 + c) * k.counts.y));
    }
    return same;
}

// False only where the result of the frame before stands: nothing was handed in that is new, and caches, which surfels of
// the frame before have lit, are as they were.
RB_FUNCTION Mask isToBeLit(Item item) RB_OF_KERNEL {
    Mask exists = indexOf(item) < Int(k.counts.x);
    if (settled[0] == 0.0f) return exists;
    return exists && !isHandedInAgain(item);
}

// Whether what is sent differs from what was.
RB_FUNCTION Mask hasChanged(Item item, Vec3 sent) RB_OF_KERNEL {
    Vec4 before = loadFour(nodesBefore, indexOf(item));
    return !(hasSameBits(sent.x, before.x) && hasSameBits(sent.y, before.y) && hasSameBits(sent.z, before.z));
}

// Writes what the next frame compares with.
RB_FUNCTION void keepHandedIn(Item item) RB_OF_KERNEL {
    RB_UNROLL
    for (int c = 0; c < 3; ++c) {
        storeOffset(kept, item, c * k.counts.y, loadOffset(surfelLight, item, c * k.counts.y));
        if (emission == withEmissionOfFrame)
            storeOffset(kept, item, (4 + c) * k.counts.y, loadOffset(surfelEmission, item, c * k.counts.y));
    }
}

RB_FUNCTION void storeChange(Item item, Mask changed) RB_OF_KERNEL {
    storeOffset(kept, item, 3 * k.counts.y, select(changed, Real(1.0f), Real(0.0f)));
}

#endif
