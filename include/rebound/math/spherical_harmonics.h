// SPDX-License-Identifier: MIT
// Real spherical harmonics of bands 0 to 3, orthonormal over the sphere, and the cosine lobes that are read through them.
// Number l * l + l + m is y of band l and order m; there is no Condon-Shortley sign. Kernel language; for host code see
// spherical_harmonics.hpp.
#ifndef REBOUND_SPHERICAL_HARMONICS_H
#define REBOUND_SPHERICAL_HARMONICS_H

const int maximumHarmonics = 16;

struct Harmonics {
    Real value[maximumHarmonics];
};

// y_i of a unit vector. Those that nobody uses cost nothing.
RB_FUNCTION Harmonics sphericalHarmonics(Vec3 d) {
    Real xx = d.x * d.x;
    Real yy = d.y * d.y;
    Real zz = d.z * d.z;
    Harmonics y;
    y.value[0] = Real(0.282094792f); // 1/2 sqrt(1 / pi)
    y.value[1] = d.y * 0.488602512f; // 1/2 sqrt(3 / pi)
    y.value[2] = d.z * 0.488602512f;
    y.value[3] = d.x * 0.488602512f;
    y.value[4] = d.x * d.y * 1.092548431f; // 1/2 sqrt(15 / pi)
    y.value[5] = d.y * d.z * 1.092548431f;
    y.value[6] = (zz * 3.0f - 1.0f) * 0.315391565f; // 1/4 sqrt(5 / pi)
    y.value[7] = d.x * d.z * 1.092548431f;
    y.value[8] = (xx - yy) * 0.546274215f;                 // 1/4 sqrt(15 / pi)
    y.value[9] = d.y * (xx * 3.0f - yy) * 0.590043590f;    // 1/4 sqrt(35 / (2 pi))
    y.value[10] = d.x * d.y * d.z * 2.890611443f;          // 1/2 sqrt(105 / pi)
    y.value[11] = d.y * (zz * 5.0f - 1.0f) * 0.457045799f; // 1/4 sqrt(21 / (2 pi))
    y.value[12] = d.z * (zz * 5.0f - 3.0f) * 0.373176333f; // 1/4 sqrt(7 / pi)
    y.value[13] = d.x * (zz * 5.0f - 1.0f) * 0.457045799f;
    y.value[14] = d.z * (xx - yy) * 1.445305721f; // 1/4 sqrt(105 / pi)
    y.value[15] = d.x * (xx - yy * 3.0f) * 0.590043590f;
    return y;
}

// The band of a harmonic's number.
RB_FUNCTION int bandOf(int harmonic) { return harmonic < 1 ? 0 : harmonic < 4 ? 1 : harmonic < 9 ? 2 : 3; }

// Factor s_l of a lobe max(0, cos)^exponent around d that is normalised to unit integral: its coefficients are s_l y_lm(d).
// Exponent 1: 1, 2/3, 1/4, 0.                       [Jendersie, Kuri, Grosch, appendix B, normalised]
RB_FUNCTION Real lobeFactor(int band, Real exponent) {
    if (band == 1) return (exponent + 1.0f) / (exponent + 2.0f);
    if (band == 2) return exponent / (exponent + 3.0f);
    if (band == 3) return (exponent + 1.0f) * (exponent - 1.0f) / ((exponent + 2.0f) * (exponent + 4.0f));
    return Real(1.0f);
}

// Coefficients of that lobe. Its product with the coefficients of a radiance is the lobe's mean radiance: with exponent 1
// and a surface's normal, irradiance over pi.
RB_FUNCTION Harmonics lobe(Vec3 d, Real exponent) {
    Harmonics h = sphericalHarmonics(d);
    RB_UNROLL
    for (int i = 0; i < maximumHarmonics; ++i) h.value[i] = h.value[i] * lobeFactor(bandOf(i), exponent);
    return h;
}

#endif
