// SPDX-License-Identifier: MIT
#include "lab/metrics/flip.hpp"

#include "lab/metrics/flip_colors.hpp"
#include "lab/metrics/flip_filters.hpp"
#include "lab/rays/parallel_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rebound::metrics {

namespace {

// What an observer perceives of one picture.
struct Percept {
    ColorPlanes colors; // CIELab, adjusted after Hunt
    Plane edges;        // strengths of features
    Plane points;
};

// Replaces every pixel by what `convert` makes of it.
template <class Convert>
void convertPixels(ColorPlanes& planes, const Convert& convert) {
    lab::parallelRows(planes[0].height, 0, {}, [&](int y) {
        double* const rows[3] = {planes[0].row(y), planes[1].row(y), planes[2].row(y)};
        for (int x = 0; x < planes[0].width; ++x) {
            const glm::dvec3 converted = convert(glm::dvec3(rows[0][x], rows[1][x], rows[2][x]));
            for (int c = 0; c < 3; ++c) rows[c][x] = converted[c];
        }
    });
}

// What remains of details once they are too fine to be seen.
ColorPlanes withoutUnseenDetail(const ColorPlanes& yCxCz, const ContrastFilters& filters) {
    ColorPlanes seen;
    seen[0] = filtered(yCxCz[0], filters.luminance, filters.luminance);
    seen[1] = filtered(yCxCz[1], filters.redGreen, filters.redGreen);
    seen[2] = filtered(yCxCz[2], filters.blueYellow[0], filters.blueYellow[0]);
    const Plane second = filtered(yCxCz[2], filters.blueYellow[1], filters.blueYellow[1]);
    for (size_t i = 0; i < second.values.size(); ++i)
        seen[2].values[i] =
            filters.blueYellowShares[0] * seen[2].values[i] + filters.blueYellowShares[1] * second.values[i];
    return seen;
}

// The length of a feature's two components, along x and along y.
Plane strengthOf(const Plane& luminance, const Weights& feature, const Weights& gaussian) {
    Plane strength = filtered(luminance, feature, gaussian);
    const Plane other = filtered(luminance, gaussian, feature);
    for (size_t i = 0; i < strength.values.size(); ++i)
        strength.values[i] = std::hypot(strength.values[i], other.values[i]);
    return strength;
}

Percept perceptOf(ColorPlanes picture, double pixelsPerDegree) {
    convertPixels(picture, [](const glm::dvec3& srgb) { return yCxCzOfLinear(decodedSrgb(srgb)); });
    Percept percept;
    percept.colors = withoutUnseenDetail(picture, contrastFilters(pixelsPerDegree));
    convertPixels(percept.colors, [](const glm::dvec3& yCxCz) {
        return huntLabOfLinear(glm::clamp(linearOfYCxCz(yCxCz), 0.0, 1.0));
    });
    Plane& luminance = picture[0];
    for (double& y : luminance.values) y = (y + 16.0) / 116.0;
    const FeatureFilters features = featureFilters(pixelsPerDegree);
    percept.edges = strengthOf(luminance, features.edge, features.gaussian);
    percept.points = strengthOf(luminance, features.point, features.gaussian);
    return percept;
}

glm::dvec3 colorAt(const Percept& percept, size_t i) {
    return {percept.colors[0].values[i], percept.colors[1].values[i], percept.colors[2].values[i]};
}

double errorAt(const Percept& a, const Percept& b, size_t i) {
    const double color = colorError(hyabDistance(colorAt(a, i), colorAt(b, i)));
    const double difference = std::max(std::abs(a.edges.values[i] - b.edges.values[i]),
                                       std::abs(a.points.values[i] - b.points.values[i]));
    const double feature = std::min(std::sqrt(difference / std::numbers::sqrt2), 1.0); // exponent qf
    return std::pow(color, 1.0 - feature);
}

} // namespace

Plane flipMap(const ColorPlanes& test, const ColorPlanes& truth, double pixelsPerDegree) {
    const Percept a = perceptOf(test, pixelsPerDegree), b = perceptOf(truth, pixelsPerDegree);
    Plane errors(test[0].width, test[0].height);
    lab::parallelRows(errors.height, 0, {}, [&](int y) {
        for (int x = 0; x < errors.width; ++x) {
            const size_t i = size_t(y) * size_t(errors.width) + size_t(x);
            errors.values[i] = errorAt(a, b, i);
        }
    });
    return errors;
}

} // namespace rebound::metrics
