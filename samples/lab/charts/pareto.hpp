// SPDX-License-Identifier: MIT
// Which settings are worth their time: none other is both faster and nearer to the truth.
#pragma once

#include <cstddef>
#include <vector>

namespace rebound::charts {

struct SpeedAndError {
    double milliseconds = 0.0;
    double error = 0.0;
};

// Better in one and no worse in the other.
bool dominates(const SpeedAndError& better, const SpeedAndError& worse);

// Indices of those that none dominates, from the fastest; of equal ones, all. What is not finite is left out.
std::vector<size_t> paretoFront(const std::vector<SpeedAndError>&);

// exp of the mean logarithm. Precondition: not empty, all above 0.
double geometricMean(const std::vector<double>&);

} // namespace rebound::charts
