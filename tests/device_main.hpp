// SPDX-License-Identifier: MIT
// The main function of tests that need a device, without which there is nothing to test.
#pragma once

#include <doctest/doctest.h>

#include "rebound/result.hpp"

#include <cstdio>
#include <string>

namespace rebound::test {

// Why there is no such device; empty: there is one.
template <class Device>
std::string whyMissing(const Result<Device>& device) {
    return device ? "" : device.error().message;
}

// 77 tells CTest to count the test as skipped.
inline int runUnlessMissing(const std::string& why, int count, char** arguments) {
    if (why.empty()) return doctest::Context(count, arguments).run();
    std::printf("skipped: %s\n", why.c_str());
    return 77;
}

} // namespace rebound::test
