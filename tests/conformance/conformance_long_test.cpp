// SPDX-License-Identifier: MIT
// More cases than conformance_test.cpp has time for.
#include "agreement.hpp"

using namespace rebound::conformance;
using namespace rebound::test;

TEST_CASE("backends agree on 1000 other random G-buffers and settings") {
    checkAgreement(randomCases(1000, 2));
}
TEST_CASE("backends agree on every built-in scene at 1280x720") {
    checkAgreement(sceneCases({.extent = {1280, 720}}), allowedSceneDifference);
}
