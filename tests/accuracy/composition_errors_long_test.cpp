// SPDX-License-Identifier: MIT
// Composition at the moderate setting on all reference views: a record that has to be kept.
#include "composition_views.hpp"

TEST_CASE("caches light all reference views as accurately as stated, no less and no more") {
    const auto mean = rebound::accuracy::checkComposition([](const std::string&) { return true; });
    if (!mean) return;
    std::printf("%-24s %6.3f\n", "mean", *mean);
    CHECK(*mean < 0.28);
}
