// SPDX-License-Identifier: MIT
// Every backend of this machine against the scalar CPU.
#pragma once

#include "lab/conformance/conformance.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace rebound::test {

// Of whole frames of scenes. Every backend rounds to the same halves between passes, so that on pictures of some ten
// thousand lit pixels little is left: halves that a last place of a float tips over, and few decisions. Measured: 2e-4.
inline constexpr double allowedSceneDifference = 1e-3;

inline std::vector<conformance::Contender> presentContenders() {
    std::vector<conformance::Contender> contenders;
    for (cpu::Isa isa : cpu::availableIsas()) {
        if (isa == cpu::Isa::scalar) continue;
        runner::BackendChoice choice;
        choice.isa = isa;
        auto backend = runner::createBackend(choice);
        REQUIRE(backend);
        contenders.push_back({cpu::name(isa), *std::move(backend)});
    }
    for (const std::string& name : runner::backendNames()) {
        if (name == "cpu") continue;
        runner::BackendChoice choice;
        choice.backend = name;
        choice.validation = true;
        auto backend = runner::createBackend(choice);
        if (backend) contenders.push_back({name, *std::move(backend)});
        else MESSAGE("skipped: " << backend.error().message);
    }
    return contenders;
}

inline void checkAgreement(const std::vector<conformance::NamedCase>& cases,
                           double allowed = conformance::allowedFrameDifference) {
    std::vector<conformance::Contender> contenders = presentContenders();
    const auto report = conformance::run(cases, contenders);
    REQUIRE_MESSAGE(report, (report ? "" : report.error().message));
    CHECK(report->cases == int(cases.size()));
    for (const conformance::Report::Row& row : report->rows) {
        CAPTURE(row.contender);
        CAPTURE(row.kernel);
        CAPTURE(row.worstCase);
        CAPTURE(row.worstPass);
        CAPTURE(row.difference.worstExcess);
        CHECK(row.disagreements == 0);
    }
    for (const conformance::FrameRow& row : report->frames) {
        CAPTURE(row.contender);
        CAPTURE(row.worstCase);
        CAPTURE(row.maximum);
        CHECK(row.disagreements == 0);
        CHECK(row.maximum <= allowed);
    }
    for (const std::string& complaint : report->complaints) FAIL_CHECK(complaint);
}

} // namespace rebound::test
