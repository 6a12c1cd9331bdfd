// SPDX-License-Identifier: MIT
#include "lab/images/exr_colors.hpp"

#include <ImfStandardAttributes.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rebound::lab {
namespace {

// Chromaticities (x, y) of red, green, blue and white.
using Primaries = std::array<glm::dvec2, 4>;

constexpr Primaries rec709 = {glm::dvec2(0.64, 0.33), {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

// Headers state them in single precision, often rounded to three digits.
constexpr double roundedPrimaries = 1e-3;

glm::dvec3 toXyz(glm::dvec2 c) { return {c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y}; }

// From linear RGB to CIE XYZ, white having Y = 1.
glm::dmat3 xyzOf(const Primaries& p) {
    const glm::dmat3 columns(toXyz(p[0]), toXyz(p[1]), toXyz(p[2]));
    const glm::dvec3 scale = glm::inverse(columns) * toXyz(p[3]);
    return {columns[0] * scale.x, columns[1] * scale.y, columns[2] * scale.z};
}

glm::dmat3 adaptation(glm::dvec2 from, glm::dvec2 to) {
    const glm::dmat3 bradford =
        glm::transpose(glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
    const glm::dvec3 scale = (bradford * toXyz(to)) / (bradford * toXyz(from));
    const glm::dmat3 scaled(glm::dvec3(scale.x, 0, 0), glm::dvec3(0, scale.y, 0), glm::dvec3(0, 0, scale.z));
    return glm::inverse(bradford) * scaled * bradford;
}

bool isFinite(const glm::dmat3& m) {
    for (int i = 0; i < 9; ++i)
        if (!std::isfinite(m[i / 3][i % 3])) return false;
    return true;
}

} // namespace

Result<std::optional<glm::dmat3>> toRec709(const Imf::Header& header) {
    if (!Imf::hasChromaticities(header)) return std::optional<glm::dmat3>();
    const Imf::Chromaticities& stated = Imf::chromaticities(header);
    const auto vector = [](const Imath::V2f& v) { return glm::dvec2(double(v.x), double(v.y)); };
    const Primaries primaries = {vector(stated.red), vector(stated.green), vector(stated.blue),
                                 vector(stated.white)};
    bool same = true;
    for (size_t i = 0; i < primaries.size(); ++i)
        same = same && glm::length(primaries[i] - rec709[i]) < roundedPrimaries;
    if (same) return std::optional<glm::dmat3>();
    const glm::dmat3 matrix =
        glm::inverse(xyzOf(rec709)) * adaptation(primaries[3], rec709[3]) * xyzOf(primaries);
    // Of sets that are in use, the widest, ACES AP0, gives entries of up to 2.6.
    constexpr double largestEntry = 100.0;
    for (int i = 0; i < 9; ++i)
        if (!isFinite(matrix) || std::abs(matrix[i / 3][i % 3]) > largestEntry)
            return Error{ErrorCode::invalidData, "the primaries in its header span no colours"};
    return std::optional<glm::dmat3>(matrix);
}

void convertColors(Image& image, const glm::dmat3& matrix) {
    const size_t channels = size_t(image.channels);
    for (size_t i = 0; i + 2 < image.data.size(); i += channels) {
        const glm::dvec3 color =
            matrix * glm::dvec3(double(image.data[i]), double(image.data[i + 1]), double(image.data[i + 2]));
        for (size_t c = 0; c < 3; ++c) image.data[i + c] = float(color[int(c)]);
    }
}

} // namespace rebound::lab
