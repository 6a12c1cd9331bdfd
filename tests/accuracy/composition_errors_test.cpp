// SPDX-License-Identifier: MIT
// Composition at the moderate setting, in two rooms that are baked within seconds: a record that has to be kept.
#include "composition_views.hpp"

TEST_CASE("caches light two rooms as accurately as stated, no less and no more") {
    rebound::accuracy::checkComposition("moderate", [](const std::string& view) {
        return view == "cornell_box/front" || view == "fox_room/front";
    });
}
