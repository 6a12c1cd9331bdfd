// SPDX-License-Identifier: MIT
#include "conform_report.hpp"

#include "lab/images/image_files.hpp"
#include "output_folder.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::cli {

namespace {

using conformance::Contender;
using conformance::Difference;
using conformance::Finding;
using conformance::Report;

// "screen_indirect/gather" as "gather": one technique's kernels share a table.
std::string shortName(const std::string& kernel) { return kernel.substr(kernel.find('/') + 1); }

std::string whereOf(const Difference& d) {
    return formatted("pixel (%d, %d), channel %d: %.8g where the scalar CPU has %.8g", d.worstX, d.worstY,
                     d.worstChannel, double(d.worstValue), double(d.worstReference));
}

lab::Image magnified(const Finding& f, float factor) {
    lab::Image image = f.reference;
    for (size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = factor * std::abs(f.value.data[i] - f.reference.data[i]);
    return image;
}

// Small pictures with each pixel several times, so that texels can be seen and captions read.
lab::Picture enlarged(const lab::Picture& picture) {
    constexpr int leastWidth = 280;
    const int factor = (leastWidth + picture.width - 1) / picture.width;
    lab::Picture result{picture.width * factor, picture.height * factor, {}};
    result.rgb.reserve(size_t(result.width) * size_t(result.height) * 3);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            const size_t from = (size_t(y / factor) * size_t(picture.width) + size_t(x / factor)) * 3;
            result.rgb.insert(result.rgb.end(), &picture.rgb[from], &picture.rgb[from] + 3);
        }
    return result;
}

Json differenceToJson(const Difference& d) {
    Json json;
    // Not a number in JSON: an infinite difference is one of a number and no number.
    const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json("infinite"); };
    json["maximum_absolute"] = number(d.maximumAbsolute);
    json["maximum_relative"] = number(d.maximumRelative);
    json["maximum_ulp"] = number(d.maximumUlp);
    json["texels"] = d.texels;
    json["beyond_tolerance"] = d.beyond;
    json["other_decisions"] = d.decisions;
    if (d.worstX >= 0)
        json["worst"] = {{"x", d.worstX},
                         {"y", d.worstY},
                         {"channel", d.worstChannel},
                         {"reference", number(double(d.worstReference))},
                         {"value", number(double(d.worstValue))},
                         {"share_of_tolerance", number(d.worstExcess)}};
    return json;
}

} // namespace

std::string conformText(const Report& report, const std::vector<Contender>& contenders,
                        const std::vector<std::string>& skipped) {
    std::string text = std::to_string(report.cases) + " cases against the scalar CPU";
    for (const Contender& c : contenders) text += "\n  " + c.name + ": " + runner::toText(c.backend->info());
    for (const std::string& s : skipped) text += "\n  skipped " + s;
    text += formatted("\n\n%-9s %-18s %10s %10s %9s %10s %10s %9s\n", "backend", "pass", "max abs", "max rel",
                      "max ulp", "beyond", "decisions", "of tol.");
    for (const Report::Row& row : report.rows) {
        const Difference& d = row.difference;
        text += formatted("%-9s %-18s %10.2e %10.2e %9.3g %9.4f%% %9.4f%% %9.2f%s\n", row.contender.c_str(),
                          shortName(row.kernel).c_str(), d.maximumAbsolute, d.maximumRelative, d.maximumUlp,
                          100.0 * double(d.beyond) / double(d.texels),
                          100.0 * double(d.decisions) / double(d.texels), d.worstExcess,
                          row.disagreements ? "  DISAGREES" : "");
    }
    text += formatted("\n%-9s %12s %12s  worst case\n", "backend", "frame median", "frame max");
    for (const conformance::FrameRow& row : report.frames)
        text += formatted("%-9s %12.2e %12.2e  %s%s\n", row.contender.c_str(), row.median, row.maximum,
                          row.worstCase.c_str(), row.disagreements ? "  DISAGREES" : "");
    for (const Finding& f : report.disagreements)
        text += "\n" + f.contender + " disagrees in " + f.caseName + ", pass " + f.pass + ", " + f.resource +
                ": " + std::to_string(f.difference.beyond) + " texels beyond tolerance, " +
                std::to_string(f.difference.decisions) + " other decisions; worst at " +
                whereOf(f.difference);
    for (const std::string& complaint : report.complaints) text += "\n" + complaint;
    return text + (report.agrees() ? "\nall agree\n" : "\n");
}

Json conformJson(const Report& report, const std::vector<Contender>& contenders,
                 const std::vector<std::string>& skipped) {
    Json json;
    json["agrees"] = report.agrees();
    json["cases"] = report.cases;
    json["backends"] = Json::array();
    for (const Contender& c : contenders)
        json["backends"].push_back({{"name", c.name}, {"on", runner::toText(c.backend->info())}});
    json["skipped"] = skipped;
    json["passes"] = Json::array();
    for (const Report::Row& row : report.rows) {
        Json entry = {{"backend", row.contender},    {"kernel", row.kernel},
                      {"images", row.images},        {"worst_case", row.worstCase},
                      {"worst_pass", row.worstPass}, {"disagreements", row.disagreements}};
        entry.update(differenceToJson(row.difference));
        json["passes"].push_back(entry);
    }
    json["frames"] = Json::array();
    for (const conformance::FrameRow& row : report.frames)
        json["frames"].push_back(
            {{"backend", row.contender},
             {"median_relative_rms", row.median},
             {"maximum_relative_rms", std::isfinite(row.maximum) ? Json(row.maximum) : Json("infinite")},
             {"worst_case", row.worstCase},
             {"disagreements", row.disagreements}});
    json["disagreements"] = Json::array();
    for (const Finding& f : report.disagreements) {
        Json entry = {
            {"backend", f.contender}, {"case", f.caseName}, {"pass", f.pass}, {"resource", f.resource}};
        entry.update(differenceToJson(f.difference));
        json["disagreements"].push_back(entry);
    }
    json["complaints"] = report.complaints;
    return json;
}

Result<> writeConformPictures(const std::string& folder, const Report& report) {
    std::vector<OutputFile> files;
    for (const Finding& f : report.disagreements) {
        std::string name = f.contender + " " + shortName(f.kernel) + " " + f.resource + ".png";
        std::replace(name.begin(), name.end(), ' ', '_');
        files.push_back({name, [&f](const std::filesystem::path& path) {
                             const lab::ToneCurve curve = lab::automaticToneCurve(f.reference);
                             const auto shown = [&](const lab::Image& image) {
                                 return enlarged(lab::toneMap(image, curve));
                             };
                             return lab::writePng(
                                 path, lab::contactSheet({{"scalar CPU", shown(f.reference)},
                                                          {f.contender, shown(f.value)},
                                                          {"difference", shown(magnified(f, 1.0f))},
                                                          {"difference x 16", shown(magnified(f, 16.0f))}},
                                                         2));
                         }});
    }
    return files.empty() ? Result<>() : writeOutputFolder(folder, files);
}

} // namespace rebound::cli
