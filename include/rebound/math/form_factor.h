// SPDX-License-Identifier: MIT
// Form factors from a receiving point to a small sender: the share of the receiver's cosine-weighted hemisphere that
// the sender fills. Kernel language.
#ifndef REBOUND_FORM_FACTOR_H
#define REBOUND_FORM_FACTOR_H

// To a disc: R^2 cos(theta) / (r^2 + R^2), pi R^2 = cos(theta') ds. Bounded as r -> 0, and for small ds equal to the
// point-to-point factor.                                           [Soler and Hoel, eq. 4; RR-7162, eq. 4]
//   cosReceiver   cosine at the receiver, clamped to 0
//   discOverPi    the sender's area times its clamped cosine, over pi: R^2                  [m^2]
//   distance2     squared distance                                                          [m^2]
RB_FUNCTION Real pointToDisc(Real cosReceiver, Real discOverPi, Real distance2) {
    return cosReceiver * discOverPi * reciprocal(distance2 + discOverPi);
}

// To a differential area: cos(theta) cos(theta') ds / (pi r^2). Not bounded as r -> 0.      [RR-7162, eq. 1]
RB_FUNCTION Real pointToPoint(Real cosReceiver, Real discOverPi, Real distance2) {
    return cosReceiver * discOverPi * reciprocal(distance2);
}

#endif
