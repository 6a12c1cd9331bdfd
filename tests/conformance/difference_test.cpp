// SPDX-License-Identifier: MIT
// What a comparison of two images finds, planted by hand.
#include "lab/conformance/difference.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace rebound;
using namespace rebound::conformance;

namespace {

constexpr Extent2D extent{5, 4};

// Of an image of that name that is half as large as the frame.
ImageTolerance toleranceOfNamed(const char* name, Format format) {
    Plan plan{"test", {}, {}};
    plan.add({"depth", ResourceKind::input, Format::r32f, 1, {10, 8}, {}, 0});
    const auto r = plan.add({name, ResourceKind::transient, format, 4, extent, {}, 0});
    return techniqueTolerances(plan, 10.0f)[size_t(r)];
}

Difference single(const char* name, Format format, const lab::Image& a, const lab::Image& b) {
    const ImageTolerance tolerance = toleranceOfNamed(name, format);
    return compare({{format, &tolerance, &a, &b}})[0];
}

} // namespace

TEST_CASE("equal images agree, and so do two that are no numbers in the same place") {
    lab::Image a(extent, 3, 0.25f);
    a.at(1, 1)[2] = std::numeric_limits<float>::quiet_NaN();
    const Difference d = single("gathered 0", Format::rgba16f, a, a);
    CHECK(d.agrees());
    CHECK(d.texels == 20);
    CHECK(d.maximumAbsolute == 0.0);
    CHECK(d.worstX == -1);
}

TEST_CASE("one value out of bounds is found, with its place and its figures") {
    const lab::Image a(extent, 3, 0.25f);
    lab::Image b = a;
    b.at(3, 2)[1] = 0.5f;
    b.at(0, 0)[0] = 0.25f + 0.25f / 1024.0f; // one unit in the last place of a half
    const Difference d = single("combined 0", Format::rgba16f, a, b);
    CHECK_FALSE(d.agrees());
    CHECK(d.beyond == 1);
    CHECK(d.decisions == 0);
    CHECK(d.worstX == 3);
    CHECK(d.worstY == 2);
    CHECK(d.worstChannel == 1);
    CHECK(d.worstReference == 0.25f);
    CHECK(d.worstValue == 0.5f);
    CHECK(d.maximumAbsolute == doctest::Approx(0.25));
    CHECK(d.maximumRelative == doctest::Approx(1.0));
    CHECK(d.maximumUlp == doctest::Approx(1024.0));
}

TEST_CASE("a number against no number is beyond any tolerance") {
    const lab::Image a(extent, 3, 0.25f);
    for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        lab::Image b = a;
        b.at(4, 3)[0] = bad;
        CHECK(single("combined 0", Format::rgba16f, a, b).beyond == 1);
        CHECK(single("combined 0", Format::rgba16f, b, a).beyond == 1);
    }
}

TEST_CASE("another choice of four texels is a decision; another area is not") {
    ImageTolerance surface = toleranceOfNamed("surface 1", Format::rgba32f);
    const ImageTolerance light = toleranceOfNamed("light 1", Format::rgba16f);
    lab::Image s(extent, 4), l(extent, 4, 0.5f);
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            const float texel[] = {0.0f, 0.3f, 0.4f, 7.0f};
            std::copy_n(texel, 4, s.at(x, y));
        }
    lab::Image otherPlace = s, otherLight = l, otherArea = s;
    otherPlace.at(2, 2)[3] = 7.1f;
    otherPlace.at(2, 2)[1] = 0.4f;
    otherPlace.at(2, 2)[2] = 0.3f;
    otherLight.at(2, 2)[3] = 0.6f; // follows from the other depth
    const auto decided =
        compare({{Format::rgba32f, &surface, &s, &otherPlace}, {Format::rgba16f, &light, &l, &otherLight}});
    for (const Difference& d : decided) {
        CHECK(d.decisions == 1);
        CHECK(d.beyond == 0);
        CHECK(d.agrees());
    }
    otherArea.at(2, 2)[2] = 0.5f;
    CHECK(single("surface 1", Format::rgba32f, s, otherArea).beyond == 1);
    // Only where a texel stands for finer ones is there a choice.
    surface.isChosen = false;
    CHECK(compare({{Format::rgba32f, &surface, &s, &otherPlace}})[0].beyond == 1);
}

TEST_CASE("surfaces at the frame's own resolution are no choice, and those of coarser levels are") {
    Plan plan{"test", {}, {}};
    plan.add({"depth", ResourceKind::input, Format::r32f, 1, extent, {}, 0});
    plan.add({"surface 0", ResourceKind::transient, Format::rgba32f, 4, extent, {}, 0});
    plan.add({"surface 1", ResourceKind::transient, Format::rgba32f, 4, {3, 2}, {}, 0});
    const auto tolerances = techniqueTolerances(plan, 1.0f);
    CHECK_FALSE(tolerances[1].isChosen);
    CHECK(tolerances[2].isChosen);
}

TEST_CASE("many decisions are a disagreement") {
    lab::Image a(extent, 4, 1.0f), b = a;
    for (int x = 0; x < extent.width; ++x) b.at(x, 0)[3] = 2.0f;
    const Difference d = single("surface 1", Format::rgba32f, a, b);
    CHECK(d.decisions == 5);
    CHECK_FALSE(d.agrees());
}
