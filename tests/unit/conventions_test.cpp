// SPDX-License-Identifier: MIT
// One scene, written under every convention, gives the same indirect light.
#include "test_scene.hpp"

namespace rebound::test {
namespace {

constexpr Extent2D extent{61, 37};

// Rotates the world, so that world and view space differ.
const glm::mat4 world =
    glm::translate(glm::rotate(glm::mat4(1.0f), 0.7f, glm::vec3(0.3f, 1.0f, -0.2f)), glm::vec3(1, -2, 3));

std::string describe(const GBufferConventions& c) {
    std::string text = c.depthEncoding == DepthEncoding::planar ? "planar depth" : "device depth";
    if (c.depthRange == DepthRange::minusOneToOne) text += ", minus one to one";
    if (c.depthDirection == DepthDirection::reversed) text += ", reversed";
    if (c.farPlane == FarPlane::infinite) text += ", infinite";
    if (c.projection == Projection::orthographic) text += ", orthographic";
    if (c.handedness == Handedness::left) text += ", left-handed";
    if (c.firstRow == FirstRow::bottom) text += ", first row at the bottom";
    text += c.normalSpace == NormalSpace::view ? ", view-space normals" : ", world-space normals";
    return text + (c.normalEncoding == NormalEncoding::unsignedUnit ? ", unsigned" : ", signed");
}

Frame frameOf(const GBufferConventions& c, StartResolution start, int levels) {
    Frame f = sceneFrame(c, extent, world);
    f.settings.start = start;
    f.settings.levels = levels;
    f.settings.compose = false;
    f.settings.smooth = levels > 1;
    return f;
}

} // namespace

TEST_CASE("every convention gives the same light: the G-buffer's own resolution, one level") {
    const cpu::Device device = deviceFor(cpu::Isa::automatic);
    for (Projection projection : {Projection::perspective, Projection::orthographic}) {
        GBufferConventions plain;
        plain.projection = projection;
        const Outputs reference = render(frameOf(plain, StartResolution::full, 1), device);
        CHECK(mean(reference.indirect) > 0.01);
        for (const GBufferConventions& c : everyConvention()) {
            if (c.projection != projection) continue;
            INFO(describe(c));
            const Outputs other = render(frameOf(c, StartResolution::full, 1), device);
            // Stored depth of 24 bits moves points by up to 1e-5 of their distance, a receiver's neighbours
            // at a hundredth of it: where two surfaces meet, their directions by a thousandth.
            const Difference d = difference(reference.indirect, other.indirect);
            CHECK(d.average < 1e-4);
            CHECK(d.largest < 1e-2);
        }
    }
}

TEST_CASE("every convention gives the same light: reduced and upsampled") {
    const cpu::Device device = deviceFor(cpu::Isa::automatic);
    for (Projection projection : {Projection::perspective, Projection::orthographic}) {
        GBufferConventions plain;
        plain.projection = projection;
        const Outputs reference = render(frameOf(plain, StartResolution::half, 3), device);
        CHECK(mean(reference.indirect) > 0.01);
        for (const GBufferConventions& c : everyConvention()) {
            if (c.projection != projection) continue;
            INFO(describe(c));
            const Outputs other = render(frameOf(c, StartResolution::half, 3), device);
            // Reduction chooses among texels. On a flat wall one is as good as the other but for the last
            // bits of depth and normal, and the choice moves a coarse texel's place by its half: a few
            // percent at 61x37 pixels.
            CHECK(difference(reference.indirect, other.indirect).average < 8e-2);
        }
    }
}

} // namespace rebound::test
