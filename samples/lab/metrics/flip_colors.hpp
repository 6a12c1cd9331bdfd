// SPDX-License-Identifier: MIT
// Colour spaces of FLIP and distances in them.
#pragma once

#include <glm/glm.hpp>

namespace rebound::metrics {

// sRGB-encoded to linear, each channel 0 to 1.
glm::dvec3 decodedSrgb(const glm::dvec3&);

// The linear opponent space in which contrast sensitivity is known: luminance -16 to 100, red to green, blue
// to yellow.
glm::dvec3 yCxCzOfLinear(const glm::dvec3& linear);
glm::dvec3 linearOfYCxCz(const glm::dvec3&);

// CIELab with a and b scaled by L / 100: colours seem less colourful where it is darker (Hunt).
glm::dvec3 huntLabOfLinear(const glm::dvec3& linear);

// City-block distance in lightness plus Euclidean distance in chroma (HyAB).
double hyabDistance(const glm::dvec3&, const glm::dvec3&);

// A distance in Hunt-adjusted CIELab as an error, 0 to 1; the distance from green to blue is 1.
double colorError(double distance);

} // namespace rebound::metrics
