// SPDX-License-Identifier: MIT
#include "lab/metrics/flip_colors.hpp"

#include <cmath>

namespace rebound::metrics {

namespace {

using glm::dmat3;
using glm::dvec3;

// sRGB's primaries to CIE XYZ under D65, with the digits that FLIP's authors use; GLM's columns are the
// primaries.
const dmat3 xyzOfLinear(10135552.0 / 24577794.0, 2613072.0 / 12288897.0, 1425312.0 / 73733382.0,
                        8788810.0 / 24577794.0, 8788810.0 / 12288897.0, 8788810.0 / 73733382.0,
                        4435075.0 / 24577794.0, 887015.0 / 12288897.0, 70074185.0 / 73733382.0);
const dmat3 linearOfXyz = glm::inverse(xyzOfLinear);
const dvec3 white = xyzOfLinear * dvec3(1.0);

double decoded(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

// CIELab's cube root, linear near black.
double compressed(double value) {
    constexpr double delta = 6.0 / 29.0;
    return value > delta * delta * delta ? std::cbrt(value) : value / (3.0 * delta * delta) + 4.0 / 29.0;
}

// Section 4.1.3's exponent qc.
double power(double distance) { return std::pow(distance, 0.7); }

double largestPower() {
    return power(hyabDistance(huntLabOfLinear({0.0, 1.0, 0.0}), huntLabOfLinear({0.0, 0.0, 1.0})));
}

} // namespace

dvec3 decodedSrgb(const dvec3& encoded) {
    return {decoded(encoded.x), decoded(encoded.y), decoded(encoded.z)};
}

dvec3 yCxCzOfLinear(const dvec3& linear) {
    const dvec3 n = xyzOfLinear * linear / white;
    return {116.0 * n.y - 16.0, 500.0 * (n.x - n.y), 200.0 * (n.y - n.z)};
}

dvec3 linearOfYCxCz(const dvec3& color) {
    const double y = (color.x + 16.0) / 116.0;
    return linearOfXyz * (dvec3(y + color.y / 500.0, y, y - color.z / 200.0) * white);
}

dvec3 huntLabOfLinear(const dvec3& linear) {
    const dvec3 n = xyzOfLinear * linear / white;
    const dvec3 f(compressed(n.x), compressed(n.y), compressed(n.z));
    const double lightness = 116.0 * f.y - 16.0;
    return {lightness, 0.01 * lightness * 500.0 * (f.x - f.y), 0.01 * lightness * 200.0 * (f.y - f.z)};
}

double hyabDistance(const dvec3& a, const dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

double colorError(double distance) {
    // Distances up to a share pc of the largest one take errors up to pt: few pairs of colours are further
    // apart.
    constexpr double pc = 0.4, pt = 0.95;
    static const double largest = largestPower();
    const double value = power(distance), knee = pc * largest;
    return value < knee ? pt * value / knee : pt + (1.0 - pt) * (value - knee) / (largest - knee);
}

} // namespace rebound::metrics
