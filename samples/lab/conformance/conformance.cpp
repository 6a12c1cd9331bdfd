// SPDX-License-Identifier: MIT
#include "lab/conformance/conformance.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::conformance {
namespace {

using runner::Record;

Error during(const std::string& caseName, const std::string& contender, const Error& error) {
    return {error.code, caseName + " on " + contender + ": " + error.message};
}

struct CaseResult {
    Record record;
    std::vector<lab::Image> outputs; // of a whole frame
};

Result<CaseResult> resultOf(runner::Backend& backend, const Case& c, const Record* replacement) {
    auto prepared = backend.prepare(c.plan, c.inputs, {c.precision, true});
    if (!prepared) return prepared.error();
    if (auto done = (*prepared)->run(); !done) return done.error();
    CaseResult result;
    for (const Resource& r : c.plan.resources)
        if (r.kind == ResourceKind::output) {
            auto image = (*prepared)->read(r.name);
            if (!image) return image.error();
            result.outputs.push_back(*std::move(image));
        }
    auto record = (*prepared)->inspect(replacement);
    if (!record) return record.error();
    result.record = *std::move(record);
    return result;
}

// Pixels that are no numbers in both do not count; in one of them, they are beyond any bound.
double relativeDifference(const lab::Image& reference, const lab::Image& value) {
    double squared = 0, power = 0;
    for (size_t i = 0; i < reference.data.size(); ++i) {
        const double a = reference.data[i], b = value.data[i];
        if (!std::isfinite(a) && !std::isfinite(b)) continue;
        if (!std::isfinite(a) || !std::isfinite(b)) return INFINITY;
        squared += (a - b) * (a - b);
        power += a * a;
    }
    // What halves cannot hold is nothing.
    constexpr double nothing = 1e-7;
    return std::sqrt(squared) /
           std::max(std::sqrt(power), nothing * std::sqrt(double(reference.data.size())));
}

Report::Row& rowOf(Report& report, const std::string& contender, const std::string& kernel) {
    for (Report::Row& row : report.rows)
        if (row.contender == contender && row.kernel == kernel) return row;
    report.rows.push_back({contender, kernel, {}, 0, 0, "", ""});
    return report.rows.back();
}

void addFinding(Report& report, Finding finding) {
    Report::Row& row = rowOf(report, finding.contender, finding.kernel);
    if (finding.difference.worstExcess >= row.difference.worstExcess) {
        row.worstCase = finding.caseName;
        row.worstPass = finding.pass;
    }
    merge(row.difference, finding.difference);
    row.images += 1;
    if (finding.difference.agrees()) return;
    row.disagreements += 1;
    if (row.disagreements == 1) report.disagreements.push_back(std::move(finding));
}

void comparePass(const NamedCase& named, const Case& c, const std::string& contender, size_t passIndex,
                 const Record& reference, const Record& value, Report& report) {
    const Pass& pass = c.plan.passes[passIndex];
    std::vector<PassImages> images;
    std::vector<size_t> resources;
    for (size_t i = 0; i < reference[passIndex].size(); ++i) {
        resources.push_back(size_t(reference[passIndex][i].resource));
        images.push_back({c.plan.resources[resources[i]].format, &c.tolerances[resources[i]],
                          &reference[passIndex][i].image, &value[passIndex][i].image});
    }
    const std::vector<Difference> differences = compare(images);
    for (size_t i = 0; i < images.size(); ++i) {
        Finding finding{
            contender,      named.name, pass.label, pass.kernel, c.plan.resources[resources[i]].name,
            differences[i], {},         {}};
        if (!differences[i].agrees()) {
            finding.reference = *images[i].reference;
            finding.value = *images[i].value;
        }
        addFinding(report, std::move(finding));
    }
}

class FrameRows {
public:
    void add(const std::string& contender, const std::string& caseName, double difference) {
        Entry& entry = entryOf(contender);
        entry.differences.push_back(difference);
        entry.row.disagreements += !(difference <= allowedFrameDifference);
        if (entry.differences.size() > 1 && difference <= entry.row.maximum) return;
        entry.row.maximum = difference;
        entry.row.worstCase = caseName;
    }
    std::vector<FrameRow> summary() {
        std::vector<FrameRow> rows;
        for (Entry& entry : entries) {
            const auto middle = entry.differences.begin() + ptrdiff_t(entry.differences.size() / 2);
            std::nth_element(entry.differences.begin(), middle, entry.differences.end());
            entry.row.median = *middle;
            rows.push_back(entry.row);
        }
        return rows;
    }

private:
    struct Entry {
        FrameRow row;
        std::vector<double> differences;
    };
    std::vector<Entry> entries;

    Entry& entryOf(const std::string& contender) {
        for (Entry& entry : entries)
            if (entry.row.contender == contender) return entry;
        entries.push_back({{contender, 0, 0, "", 0}, {}});
        return entries.back();
    }
};

} // namespace

bool Report::agrees() const {
    const auto isClean = [](const auto& row) { return row.disagreements == 0; };
    return complaints.empty() && std::all_of(rows.begin(), rows.end(), isClean) &&
           std::all_of(frames.begin(), frames.end(), isClean);
}

Result<Report> run(const std::vector<NamedCase>& cases, std::vector<Contender>& contenders,
                   const std::function<void(double)>& progress) {
    runner::BackendChoice scalar;
    scalar.isa = cpu::Isa::scalar;
    auto yardstick = runner::createCpuBackend(scalar);
    if (!yardstick) return yardstick.error();
    Report report;
    FrameRows frames;
    for (const NamedCase& named : cases) {
        auto made = named.make();
        if (!made) return Error{made.error().code, named.name + ": " + made.error().message};
        auto reference = resultOf(**yardstick, *made, nullptr);
        if (!reference) return during(named.name, "scalar", reference.error());
        for (Contender& contender : contenders) {
            auto value = resultOf(*contender.backend, *made, &reference->record);
            if (!value) return during(named.name, contender.name, value.error());
            for (size_t pass = 0; pass < made->plan.passes.size(); ++pass)
                comparePass(named, *made, contender.name, pass, reference->record, value->record, report);
            for (size_t i = 0; i < value->outputs.size(); ++i)
                frames.add(contender.name, named.name,
                           relativeDifference(reference->outputs[i], value->outputs[i]));
        }
        report.cases += 1;
        if (progress) progress(double(report.cases) / double(cases.size()));
    }
    report.frames = frames.summary();
    const auto orderOf = [&](const Report::Row& row) {
        return std::find_if(contenders.begin(), contenders.end(),
                            [&](const Contender& c) { return c.name == row.contender; });
    };
    std::stable_sort(report.rows.begin(), report.rows.end(),
                     [&](const Report::Row& a, const Report::Row& b) { return orderOf(a) < orderOf(b); });
    for (Contender& contender : contenders)
        for (const std::string& complaint : contender.backend->complaints())
            report.complaints.push_back(contender.name + ": " + complaint);
    return report;
}

} // namespace rebound::conformance
