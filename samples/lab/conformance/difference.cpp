// SPDX-License-Identifier: MIT
#include "lab/conformance/difference.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace rebound::conformance {
namespace {

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
double magnitudeOf(const ImageTolerance& t, const float* texel, int channel) {
    return t.isVector && channel < 3 ? lengthOf(texel) : std::abs(double(texel[channel]));
}

// Two values that are equal, or no numbers both; of integers, the same bits.
bool isSame(Format format, float a, float b) {
    if (isInteger(format)) return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
    return a == b || (std::isnan(a) && std::isnan(b));
}

double excess(const Tolerance& t, double difference, double magnitude) {
    if (!std::isfinite(difference)) return INFINITY;
    const double allowed = t.relative * magnitude + t.absolute;
    return allowed > 0.0 ? difference / allowed : INFINITY;
}

struct Comparison {
    const PassImages& images;

    // How far beyond its tolerance the worst channel of a texel lies; at most 1 where all agree.
    double measure(int x, int y, Difference& d) const {
        const float* a = images.reference->at(x, y);
        const float* b = images.value->at(x, y);
        double worst = 0.0;
        for (int c = 0; c < images.reference->channels; ++c) {
            if (isSame(images.format, a[c], b[c])) continue;
            const Tolerance& tolerance = images.tolerance->channels[size_t(c)];
            const double magnitude = magnitudeOf(*images.tolerance, a, c);
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
        d.maximumUlp = std::max(d.maximumUlp, difference / lastPlace(images.format, magnitude));
    }

    // Where the vector's length agrees and another value does not, as ImageTolerance says.
    bool isDecision(int x, int y) const {
        if (!images.tolerance->isChosen) return false;
        const double a = lengthOf(images.reference->at(x, y)), b = lengthOf(images.value->at(x, y));
        return a > 0.0 && std::abs(a - b) <= images.tolerance->channels[0].relative * a;
    }
};

} // namespace

std::vector<Difference> compare(const std::vector<PassImages>& images) {
    std::vector<Difference> differences(images.size());
    if (images.empty()) return differences;
    const Extent2D extent = images[0].reference->extent();
    int choices = 1;
    for (const PassImages& i : images) choices = std::max(choices, i.tolerance->choices);
    for (Difference& d : differences) {
        d.texels = size_t(extent.width) * size_t(extent.height);
        d.choices = choices;
    }
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            bool decided = false;
            for (const PassImages& i : images) {
                Difference unused;
                const Comparison comparison{i};
                decided = decided || (comparison.measure(x, y, unused) > 1.0 && comparison.isDecision(x, y));
            }
            for (size_t i = 0; i < images.size(); ++i) {
                if (decided) differences[i].decisions += 1;
                else if (Comparison{images[i]}.measure(x, y, differences[i]) > 1.0)
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
    into.choices = std::max(into.choices, d.choices);
    if (d.worstExcess <= into.worstExcess) return;
    into.worstExcess = d.worstExcess;
    into.worstX = d.worstX;
    into.worstY = d.worstY;
    into.worstChannel = d.worstChannel;
    into.worstReference = d.worstReference;
    into.worstValue = d.worstValue;
}

} // namespace rebound::conformance
