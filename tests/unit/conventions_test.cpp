// SPDX-License-Identifier: MIT
// One scene, written under every convention, gives the same indirect light.
#include "test_scene.hpp"

namespace rebound::test {
namespace {

constexpr Extent2D extent{61, 37};

// Rotates the world, so that world and view space differ.
const glm::mat4 world =
    glm::translate(glm::rotate(glm::mat4(1.0f), 0.7f, glm::vec3(0.3f, 1.0f, -0.2f)), glm::vec3(1, -2, 3));

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
            if (c.projection != projection)
                continue;
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
            if (c.projection != projection)
                continue;
            const Outputs other = render(frameOf(c, StartResolution::half, 3), device);
            // Reduction chooses among texels: where two are as good as each other but for the last bits, a
            // few texels of the coarser levels lie elsewhere.
            CHECK(difference(reference.indirect, other.indirect).average < 5e-3);
        }
    }
}

} // namespace rebound::test
