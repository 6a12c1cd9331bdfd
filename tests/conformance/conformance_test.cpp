// SPDX-License-Identifier: MIT
// Every backend of this machine against the scalar CPU, and a faulty one, which has to be found out.
#include "agreement.hpp"

using namespace rebound;
using namespace rebound::conformance;
using rebound::test::allowedSceneDifference;
using rebound::test::checkAgreement;

namespace {

// Runs plans on the CPU and spoils one value of one pass.
class FaultyPlan : public runner::PreparedPlan {
public:
    explicit FaultyPlan(std::unique_ptr<runner::PreparedPlan> p) : plan(std::move(p)) {}
    Result<> setInputs(const runner::PlanInputs& inputs) override { return plan->setInputs(inputs); }
    Result<double> run() override { return plan->run(); }
    void reset() override { plan->reset(); }
    const std::vector<PassTiming>& timings() const override { return plan->timings(); }
    MemoryUse memoryUse() const override { return plan->memoryUse(); }
    Result<lab::Image> read(const std::string& output) override { return plan->read(output); }
    Result<runner::Record> inspect(const runner::Record* replacement) override {
        auto record = plan->inspect(replacement);
        if (record && replacement) record->at(1).at(0).image.at(3, 1)[0] += 1.0f;
        return record;
    }

private:
    std::unique_ptr<runner::PreparedPlan> plan;
};

class FaultyBackend : public runner::Backend {
public:
    runner::BackendInfo info() const override { return {"cpu", "", "faulty", 1}; }
    Result<MemoryUse> memoryUse(const Plan& plan) const override { return backend->memoryUse(plan); }
    Result<std::unique_ptr<runner::PreparedPlan>> prepare(const Plan& plan, const runner::PlanInputs& inputs,
                                                          const runner::PrepareOptions& options) override {
        auto prepared = backend->prepare(plan, inputs, options);
        if (!prepared) return prepared.error();
        return std::unique_ptr<runner::PreparedPlan>(std::make_unique<FaultyPlan>(*std::move(prepared)));
    }

private:
    std::unique_ptr<runner::Backend> backend = *runner::createBackend({});
};

} // namespace

TEST_CASE("backends agree on the hard cases") { checkAgreement(hardCases()); }
TEST_CASE("backends agree on 40 random G-buffers and settings") { checkAgreement(randomCases(40, 1)); }
TEST_CASE("backends agree on the lab's scenes, of 0.1 m to 10 km") {
    checkAgreement(sceneCases({.scenes = {"builtin:atrium", "builtin:cornell"}}), allowedSceneDifference);
}

TEST_CASE("a fault is found, and named by case, pass, image and texel") {
    std::vector<Contender> contenders;
    contenders.push_back({"faulty", std::make_unique<FaultyBackend>()});
    std::vector<NamedCase> cases = hardCases();
    std::erase_if(cases, [](const NamedCase& c) { return c.name != "black"; });
    REQUIRE(cases.size() == 1);
    const auto report = run(cases, contenders);
    REQUIRE(report);
    CHECK_FALSE(report->agrees());
    REQUIRE(report->disagreements.size() == 1);
    const Finding& f = report->disagreements[0];
    CHECK(f.contender == "faulty");
    CHECK(f.caseName == "black");
    CHECK(f.pass == "reduce to level 1");
    CHECK(f.resource == "surface 1");
    CHECK(f.difference.worstX == 3);
    CHECK(f.difference.worstY == 1);
    CHECK(f.difference.worstChannel == 0);
}

TEST_CASE("cases are the same for the same seed, and others for another") {
    const auto a = randomCases(3, 1), b = randomCases(3, 1), c = randomCases(3, 2);
    for (size_t i = 0; i < 3; ++i) {
        const auto first = a[i].make(), same = b[i].make(), other = c[i].make();
        REQUIRE(first);
        REQUIRE(same);
        REQUIRE(other);
        CHECK(toText(first->plan) == toText(same->plan));
        CHECK(first->inputs.images[0].image.data == same->inputs.images[0].image.data);
        CHECK(toText(first->plan) != toText(other->plan));
    }
}
