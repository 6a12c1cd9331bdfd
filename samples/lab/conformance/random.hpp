// SPDX-License-Identifier: MIT
// Random numbers that are the same with every compiler and standard library.
#pragma once

#include <cmath>
#include <cstdint>

namespace rebound::conformance {

// SplitMix64.
class Random {
public:
    explicit Random(uint64_t seed) : state(seed) {}

    uint64_t bits() {
        state += 0x9e3779b97f4a7c15u;
        uint64_t z = state;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    double unit() { return double(bits() >> 11) * 0x1p-53; } // 0 to 1, without 1
    double between(double low, double high) { return low + (high - low) * unit(); }
    double betweenDecades(double low, double high) { return low * std::pow(high / low, unit()); }
    int integer(int low, int high) {
        return low + int(bits() % uint64_t(high - low + 1));
    } // both ends included
    bool chance(double probability) { return unit() < probability; }

private:
    uint64_t state;
};

} // namespace rebound::conformance
