// SPDX-License-Identifier: MIT
#include "lab/conformance/tolerances.hpp"

namespace rebound::conformance {
namespace {

constexpr double halfUlp = 1.0 / 1024.0, smallestHalf = 6.2e-5;

ImageTolerance same(const Tolerance& t) { return {{t, t, t, t}, false, false, 1}; }

} // namespace

ImageTolerance toleranceOf(Format format) {
    if (format == Format::rgba16f)
        return same(
            {2.0 * halfUlp, smallestHalf,
             "the half's rounding, up or down, on top of weights that agree to 1e-4; halves below the "
             "smallest normal one may be 0"});
    if (isInteger(format)) return same({0.0, 0.0, "integers are exact"});
    return same({2e-6, 0.0, "a division, and a product or two"});
}

std::vector<ImageTolerance> techniqueTolerances(const Plan& plan, float largestRadiance) {
    const Extent2D full = plan.resources[size_t(plan.find("depth"))].extent;
    const Tolerance area{
        2e-5, 0.0,
        "square roots and divisions to a few units in the last place, Newton steps to 5e-7, four "
        "areas summed"};
    const Tolerance ratio{halfUlp, 2e-5,
                          "1 is taken off a ratio of distances near it, which leaves its rounding"};
    const Tolerance ring{
        2.0 * halfUlp, smallestHalf + 2e-6 * double(largestRadiance),
        "the half's rounding, which may differ by one; where surfaces lie in one plane the cosine is "
        "what rounding leaves of a distance, 1e-6, times the brightest sender; halves below the "
        "smallest normal one may be 0"};
    const Tolerance links{2e-6, 1e-7 * double(largestRadiance),
                          "a sum over links of either sign, which may leave next to nothing of them"};
    std::vector<ImageTolerance> tolerances;
    for (const Resource& r : plan.resources) {
        ImageTolerance t = toleranceOf(r.format);
        if (r.name.starts_with("surface ")) {
            for (size_t c = 0; c < 3; ++c) t.channels[c] = area;
            t.isVector = true;
            t.isChosen = r.extent != full;
            // A quarter's texel is chosen among four that were each chosen among four before, in one pass.
            if (r.name == "surface 0" && 2 * r.extent.width < full.width) t.choices = 5;
        } else if (r.name.starts_with("light ")) {
            t.channels[3] = ratio;
        } else if (r.name.starts_with("gathered ")) {
            t.channels.fill(ring);
        } else if (r.name == "caches") {
            t.channels.fill(links);
        }
        tolerances.push_back(t);
    }
    return tolerances;
}

} // namespace rebound::conformance
