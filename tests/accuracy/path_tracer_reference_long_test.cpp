// SPDX-License-Identifier: MIT
#include "path_tracer_agreement.hpp"

#include <doctest/doctest.h>

#include <cstdlib>

using namespace rebound::accuracy;

TEST_CASE("path-traced light agrees with an independent renderer on all published views") {
    const char* shared = std::getenv("REBOUND_SHARED");
    checkPathTracer(shared ? shared : "", {});
}
