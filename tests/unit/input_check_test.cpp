// SPDX-License-Identifier: MIT
// The input check says nothing of right frames.
#include "input_check_frame.hpp"

namespace rebound::test {
namespace {

constexpr Extent2D extent{61, 37};

} // namespace

TEST_CASE("right frames of every convention leave nothing to say") {
    const cpu::Device device = deviceFor(cpu::Isa::automatic);
    for (const GBufferConventions& c : everyConvention()) {
        CheckFrame f = correctFrame(c, extent);
        const auto findings = findingsOf(f, device);
        CHECK_MESSAGE(findings.empty(), sentences(findings));
    }
}

TEST_CASE("pixels are counted once each, in pictures of every shape") {
    const cpu::Device device = deviceFor(cpu::Isa::automatic);
    for (Extent2D e : {Extent2D{1, 1}, Extent2D{1, 9}, Extent2D{13, 1}, Extent2D{256, 64}, Extent2D{257, 65},
                       Extent2D{517, 131}, Extent2D{7, 4096}}) {
        CheckFrame f = correctFrame({}, e);
        int surfaces = 0;
        for (float d : f.depth.values)
            surfaces += d > 0.0f ? 1 : 0;
        const InputStatistics s = measure(f, device);
        CHECK(s[0] == float(e.width * e.height));
        CHECK(s[5] == float(surfaces));
        CHECK(s[4] == float(e.width * e.height - surfaces));
    }
}

} // namespace rebound::test
