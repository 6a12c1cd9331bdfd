// SPDX-License-Identifier: MIT
#include "lab/conformance/conformance.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace rebound::conformance {
namespace {

using runner::Record;

Error during(const std::string& caseName, const std::string& contender, const Error& error) {
    return {error.code, caseName + " on " + contender + ": " + error.message};
}

struct CaseResult {
    std::vector<Record> records;                  // by frame
    std::vector<std::vector<lab::Image>> outputs; // by frame, of whole frames
};

bool isOutput(const Resource& r) {
    return r.kind == ResourceKind::output || r.kind == ResourceKind::outputBuffer;
}

std::vector<const runner::PlanInputs*> framesOf(const Case& c) {
    std::vector<const runner::PlanInputs*> frames{&c.inputs};
    for (const runner::PlanInputs& inputs : c.later) frames.push_back(&inputs);
    return frames;
}

Result<std::vector<lab::Image>> outputsOf(runner::PreparedPlan& prepared, const Plan& plan) {
    std::vector<lab::Image> outputs;
    for (const Resource& r : plan.resources) {
        if (!isOutput(r)) continue;
        auto image = prepared.read(r.name);
        if (!image) return image.error();
        outputs.push_back(*std::move(image));
    }
    return outputs;
}

// replacements: by frame.
Result<CaseResult> resultOf(runner::Backend& backend, const Case& c,
                            const std::vector<Record>* replacements) {
    auto prepared = backend.prepare(c.plan, c.inputs, {c.precision, true});
    if (!prepared) return prepared.error();
    CaseResult result;
    const auto frames = framesOf(c);
    for (const runner::PlanInputs* inputs : frames) {
        const auto done = inputs == &c.inputs ? (*prepared)->run() : (*prepared)->runFrame(*inputs);
        if (!done) return done.error();
        auto outputs = outputsOf(**prepared, c.plan);
        if (!outputs) return outputs.error();
        result.outputs.push_back(*std::move(outputs));
    }
    (*prepared)->reset();
    for (size_t frame = 0; frame < frames.size(); ++frame) {
        if (frames.size() > 1)
            if (auto set = (*prepared)->setInputs(*frames[frame]); !set) return set.error();
        auto record = (*prepared)->inspect(replacements ? &(*replacements)[frame] : nullptr);
        if (!record) return record.error();
        result.records.push_back(*std::move(record));
    }
    return result;
}

// Pixels that are no numbers in both do not count; in one of them, they are beyond any bound.
double relativeDifference(Format format, const lab::Image& reference, const lab::Image& value) {
    if (isInteger(format))
        return std::memcmp(reference.data.data(), value.data.data(), reference.data.size() * sizeof(float)) ==
                       0
                   ? 0.0
                   : INFINITY;
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

void comparePass(const std::string& caseName, const Case& c, const std::string& contender, size_t passIndex,
                 const Record& reference, const Record& value, Report& report) {
    const Pass& pass = c.plan.passes[passIndex];
    const auto compareSome = [&](const std::vector<size_t>& written) {
        std::vector<PassImages> images;
        for (size_t i : written) {
            const size_t r = size_t(reference[passIndex][i].resource);
            images.push_back({c.plan.resources[r].format, &c.tolerances[r], &reference[passIndex][i].image,
                              &value[passIndex][i].image});
        }
        const std::vector<Difference> differences = compare(images);
        for (size_t i = 0; i < images.size(); ++i) {
            const ResourceIndex r = reference[passIndex][written[i]].resource;
            Finding finding{
                contender,      caseName, pass.label, pass.kernel, c.plan.resources[size_t(r)].name,
                differences[i], {},       {}};
            if (!differences[i].agrees()) {
                finding.reference = *images[i].reference;
                finding.value = *images[i].value;
            }
            addFinding(report, std::move(finding));
        }
    };
    // Images of a pass have its grid's size, and buffers sizes of their own.
    std::vector<size_t> images;
    for (size_t i = 0; i < reference[passIndex].size(); ++i)
        if (isImage(c.plan.resources[size_t(reference[passIndex][i].resource)].kind)) images.push_back(i);
        else compareSome({i});
    compareSome(images);
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

namespace {

void compareFrames(const NamedCase& named, const Case& c, const std::string& contender,
                   const CaseResult& reference, const CaseResult& value, Report& report, FrameRows& frames) {
    for (size_t frame = 0; frame < reference.records.size(); ++frame) {
        const std::string name =
            c.later.empty() ? named.name : named.name + ", frame " + std::to_string(frame);
        for (size_t pass = 0; pass < c.plan.passes.size(); ++pass)
            comparePass(name, c, contender, pass, reference.records[frame], value.records[frame], report);
        size_t output = 0;
        for (const Resource& r : c.plan.resources) {
            if (!isOutput(r)) continue;
            frames.add(
                contender, name,
                relativeDifference(r.format, reference.outputs[frame][output], value.outputs[frame][output]));
            ++output;
        }
    }
}

} // namespace

Result<Report> run(const std::vector<NamedCase>& cases, std::vector<Contender>& contenders,
                   const std::function<void(double)>& progress, runner::BackendChoice yardstickChoice) {
    yardstickChoice.isa = cpu::Isa::scalar;
    auto yardstick = runner::createCpuBackend(yardstickChoice);
    if (!yardstick) return yardstick.error();
    Report report;
    FrameRows frames;
    for (const NamedCase& named : cases) {
        auto made = named.make();
        if (!made) return Error{made.error().code, named.name + ": " + made.error().message};
        auto reference = resultOf(**yardstick, *made, nullptr);
        if (!reference) return during(named.name, "scalar", reference.error());
        for (Contender& contender : contenders) {
            auto value = resultOf(*contender.backend, *made, &reference->records);
            if (!value) return during(named.name, contender.name, value.error());
            compareFrames(named, *made, contender.name, *reference, *value, report, frames);
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
