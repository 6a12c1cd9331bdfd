// SPDX-License-Identifier: MIT
#include "lab/conformance/difference.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::conformance {
namespace {

bool isSurface(const Resource& r) { return r.format == Format::rgba32f; }
bool isReduction(const std::string& kernel) {
    return kernel == "screen_indirect/reduce" || kernel == "screen_indirect/prepare_half";
}

// Spacing of a format's values at a magnitude.
double lastPlace(Format format, double magnitude) {
    const int digits = format == Format::rgba16f ? 10 : 23, least = format == Format::rgba16f ? -14 : -126;
    if (!(magnitude > 0.0)) return std::ldexp(1.0, least - digits);
    return std::ldexp(1.0, std::max(std::ilogb(magnitude), least) - digits);
}

double lengthOf(const float* texel) {
    return std::sqrt(double(texel[0]) * texel[0] + double(texel[1]) * texel[1] + double(texel[2]) * texel[2]);
}

// What a channel's difference is held against: a vector's components against its length.
double magnitudeOf(const Resource& r, const float* texel, int channel) {
    return isSurface(r) && channel < 3 ? lengthOf(texel) : std::abs(double(texel[channel]));
}

// Two values that are equal, or no numbers both.
bool isSame(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

double excess(const Tolerance& t, double difference, double magnitude) {
    if (!std::isfinite(difference)) return INFINITY;
    const double allowed = t.relative * magnitude + t.absolute;
    return allowed > 0.0 ? difference / allowed : INFINITY;
}

struct Comparison {
    const std::string& kernel;
    const PassImages& images;
    float largestRadiance;

    // How far beyond its tolerance the worst channel of a texel lies; at most 1 where all agree.
    double measure(int x, int y, Difference& d) const {
        const float* a = images.reference->at(x, y);
        const float* b = images.value->at(x, y);
        double worst = 0.0;
        for (int c = 0; c < images.reference->channels; ++c) {
            if (isSame(a[c], b[c])) continue;
            const Tolerance tolerance = toleranceOf(kernel, *images.resource, c, largestRadiance);
            const double magnitude = magnitudeOf(*images.resource, a, c);
            double difference = std::abs(double(a[c]) - double(b[c]));
            if (!std::isfinite(difference)) difference = INFINITY;
            const double over = excess(tolerance, difference, magnitude);
            worst = std::max(worst, over);
            note(d, difference, magnitude, tolerance);
            if (over > d.worstExcess) {
                d.worstExcess = over;
                d.worstX = x;
                d.worstY = y;
                d.worstChannel = c;
                d.worstReference = a[c];
                d.worstValue = b[c];
            }
        }
        return worst;
    }

    void note(Difference& d, double difference, double magnitude, const Tolerance& tolerance) const {
        d.maximumAbsolute = std::max(d.maximumAbsolute, difference);
        if (magnitude <= tolerance.absolute || !std::isfinite(magnitude)) return;
        d.maximumRelative = std::max(d.maximumRelative, difference / magnitude);
        d.maximumUlp = std::max(d.maximumUlp, difference / lastPlace(images.resource->format, magnitude));
    }

    // A coarser texel takes the light and area of all four finer ones whichever lends it its place: where the areas agree
    // and place or normal does not, another one was chosen.
    bool isDecision(int x, int y) const {
        if (!isReduction(kernel) || !isSurface(*images.resource)) return false;
        const double a = lengthOf(images.reference->at(x, y)), b = lengthOf(images.value->at(x, y));
        const Tolerance tolerance = toleranceOf(kernel, *images.resource, 0, largestRadiance);
        return a > 0.0 && std::abs(a - b) <= tolerance.relative * a;
    }
};

} // namespace

Tolerance toleranceOf(const std::string& kernel, const Resource& r, int channel, float largestRadiance) {
    constexpr double halfUlp = 1.0 / 1024.0, smallestHalf = 6.2e-5;
    if (isSurface(r))
        return channel < 3 ? Tolerance{2e-5, 0.0,
                                       "square roots and divisions to a few units in the last place, Newton "
                                       "steps to 5e-7, four areas summed"}
                           : Tolerance{2e-6, 0.0, "a division, in each projection"};
    if (r.name.starts_with("light") && channel == 3)
        return {halfUlp, 2e-5, "1 is taken off a ratio of distances near it, which leaves its rounding"};
    if (kernel == "screen_indirect/gather")
        return {2.0 * halfUlp, smallestHalf + 2e-6 * double(largestRadiance),
                "the half's rounding, which may differ by one; where surfaces lie in one plane the cosine is "
                "what rounding "
                "leaves of a distance, 1e-6, times the brightest sender; halves below the smallest normal "
                "one may be 0"};
    return {2.0 * halfUlp, smallestHalf,
            "the half's rounding, up or to zero, on top of weights that agree to 1e-4; halves below the "
            "smallest normal "
            "one may be 0"};
}

std::vector<Difference> compare(const std::string& kernel, const std::vector<PassImages>& images,
                                float largestRadiance) {
    std::vector<Difference> differences(images.size());
    if (images.empty()) return differences;
    const Extent2D extent = images[0].reference->extent();
    for (Difference& d : differences) d.texels = size_t(extent.width) * size_t(extent.height);
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            bool decided = false;
            for (const PassImages& i : images) {
                Difference unused;
                const Comparison comparison{kernel, i, largestRadiance};
                decided = decided || (comparison.measure(x, y, unused) > 1.0 && comparison.isDecision(x, y));
            }
            for (size_t i = 0; i < images.size(); ++i) {
                if (decided) differences[i].decisions += 1;
                else if (Comparison{kernel, images[i], largestRadiance}.measure(x, y, differences[i]) > 1.0)
                    differences[i].beyond += 1;
            }
        }
    return differences;
}

void merge(Difference& into, const Difference& d) {
    into.maximumAbsolute = std::max(into.maximumAbsolute, d.maximumAbsolute);
    into.maximumRelative = std::max(into.maximumRelative, d.maximumRelative);
    into.maximumUlp = std::max(into.maximumUlp, d.maximumUlp);
    into.texels += d.texels;
    into.beyond += d.beyond;
    into.decisions += d.decisions;
    if (d.worstExcess <= into.worstExcess) return;
    into.worstExcess = d.worstExcess;
    into.worstX = d.worstX;
    into.worstY = d.worstY;
    into.worstChannel = d.worstChannel;
    into.worstReference = d.worstReference;
    into.worstValue = d.worstValue;
}

} // namespace rebound::conformance
