// SPDX-License-Identifier: MIT
// A view for each kind of light: an area light, a spot light on a posed skin, emissive surfaces. All views:
// path_tracer_reference_long_test.cpp.
#include "path_tracer_agreement.hpp"

#include <doctest/doctest.h>

#include <cstdlib>

using namespace rebound::accuracy;

TEST_CASE("path-traced light agrees with an independent renderer") {
    const char* shared = std::getenv("REBOUND_SHARED");
    checkPathTracer(shared ? shared : "", {"cornell_box/front", "fox_room/front", "lava_room/high"});
}
