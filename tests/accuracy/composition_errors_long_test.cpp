// SPDX-License-Identifier: MIT
// Composition on the reference views: a record that has to be kept.
#include "composition_views.hpp"

namespace {

std::optional<double> checkAll(const std::string& quality) {
    const auto mean = rebound::accuracy::checkComposition(quality, [](const std::string&) { return true; });
    if (mean) std::printf("%-24s %6.3f\n", "mean", *mean);
    return mean;
}

} // namespace

TEST_CASE("caches light all reference views as accurately as stated, no less and no more") {
    if (const auto mean = checkAll("moderate")) CHECK(*mean < 0.28);
}

// Five of the nine: the others' bakes would take as long again.
TEST_CASE("light maps of the high setting are as accurate as stated, no less and no more") {
    if (const auto mean = checkAll("high")) CHECK(*mean < 0.20);
}
