// SPDX-License-Identifier: MIT
#include "lab/charts/source_hashes.hpp"
#include "lab/charts/workshop.hpp"
#include "rebound/techniques/screen_indirect.hpp"

#include <doctest/doctest.h>

#include <set>

namespace rebound::charts {
namespace {

Plan usualPlan() { return *planScreenIndirect(*screenIndirectPreset("quarter-64", {64, 36})); }

TEST_CASE("backends have sources of their own, and what runs carries its backend's") {
    CHECK(std::set<std::string>{sourceHash("cpu"), sourceHash("vulkan"), sourceHash("opengl")}.size() == 3);
    const auto backends = createBackends("backends", {"scalar"}, "", 1);
    REQUIRE(backends);
    CHECK((*backends)[0].source == sourceHash("cpu"));
}

TEST_CASE("a plan's hash knows its passes, and every bit of what it holds") {
    CHECK(planHash(usualPlan()) == planHash(usualPlan()));
    Plan otherLabel = usualPlan();
    otherLabel.passes[0].label += "!";
    CHECK(planHash(otherLabel) != planHash(usualPlan()));
    Plan otherData = usualPlan();
    for (Resource& resource : otherData.resources)
        if (resource.data) {
            std::vector<std::byte> bytes = *resource.data;
            bytes.back() ^= std::byte{1};
            resource.data = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
            break;
        }
    CHECK(toText(otherData) == toText(usualPlan()));
    CHECK(planHash(otherData) != planHash(usualPlan()));
}

} // namespace
} // namespace rebound::charts
