// SPDX-License-Identifier: MIT
#include "lab/charts/fronts.hpp"
#include "lab/charts/report.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::charts {

namespace {

template <class... Values>
std::string formatted(const char* format, Values... values) {
    char text[256];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

std::string plural(size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

using Row = std::vector<std::string>;

// The first column to the left, the others to the right, so that the source reads as a table too.
std::string markdownTable(const std::vector<Row>& rows) {
    std::vector<size_t> widths(rows[0].size(), 3);
    for (const Row& row : rows)
        for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    std::string text;
    for (size_t r = 0; r < rows.size(); ++r) {
        for (size_t i = 0; i < widths.size(); ++i) {
            const size_t blanks = widths[i] - rows[r][i].size();
            text += "| ";
            text.append(i == 0 ? 0 : blanks, ' ').append(rows[r][i]).append(i == 0 ? blanks : 0, ' ') += ' ';
        }
        text += "|\n";
        if (r > 0) continue;
        for (size_t i = 0; i < widths.size(); ++i)
            (text += '|').append(widths[i] + 1, '-') += i == 0 ? '-' : ':';
        text += "|\n";
    }
    return text;
}

std::string frontTable(const Chart& chart, const std::string& group) {
    std::vector<const ChartPoint*> front;
    for (const ChartPoint& point : chart.points)
        if (point.isOnFront && point.group == group) front.push_back(&point);
    std::sort(front.begin(), front.end(),
              [](const ChartPoint* a, const ChartPoint* b) { return a->times.median < b->times.median; });
    std::vector<Row> rows = {
        {"setting", "median [ms]", "10 % to 90 % [ms]", "relative RMSE", "its standard error"}};
    for (const ChartPoint* p : front)
        rows.push_back({p->name, formatted("%.3g", p->times.median),
                        formatted("%.3g to %.3g", p->times.percentile10, p->times.percentile90),
                        formatted("%.4f", p->error),
                        std::isnan(p->standardError) ? "-" : formatted("%.4f", p->standardError)});
    return markdownTable(rows);
}

std::string frontsText(const Results& results) {
    std::string text =
        "## Pareto fronts\n\nSettings than which no other of the same device is both faster and nearer "
        "to the truth.\n";
    for (const Chart& chart : chartsOf(results))
        for (const std::string& group : groupsOf(chart.points))
            text += "\n### " + chart.title + ", " + group + "\n\n" + frontTable(chart, group);
    return text;
}

std::string dominatedText(const Results& results) {
    const std::vector<Dominated> all = dominatedEverywhere(results);
    std::string text = "\n## Never worth their time\n\n";
    if (all.empty()) return text + "Every setting is on its front in some view.\n";
    text += "In every view, another setting of the same device is faster and no worse, or as fast and "
            "better.\n\n";
    std::vector<Row> rows = {{"setting", "on", "beaten by", "in views"}};
    for (const Dominated& one : all)
        rows.push_back({one.name, one.group, one.by,
                        std::to_string(one.viewsOfThat) + " of " + std::to_string(one.views)});
    return text + markdownTable(rows);
}

std::string notFiniteText(const Results& results) {
    std::string text;
    for (const Point& point : results.points)
        if (point.metrics.notFinite > 0)
            text += "- " + point.view + ", " + point.name + ", " + point.group() + ": " +
                    plural(point.metrics.notFinite, "pixel") + " left out\n";
    return text.empty() ? "" : "\n## Pixels that are not finite\n\nThey are in no mean.\n\n" + text;
}

std::string bouncesText(int bounces) {
    return bounces == 1 ? "light that met one other surface, which is what a technique of one bounce computes"
                        : "light that met 1 to " + std::to_string(bounces) + " other surfaces";
}

} // namespace

std::string summaryText(const Results& results) {
    std::string text = "# Speed against accuracy\n\nRebound " + results.version + " on " + results.machine +
                       ", " + std::to_string(results.size.width) + "x" + std::to_string(results.size.height) +
                       ", " + plural(results.points.size(), "point") + " in " +
                       plural(results.views.size(), "view") + ". The truth is " +
                       bouncesText(results.bounces) + ", path traced:\n\n";
    for (const ViewRecord& view : results.views)
        text += "- " + view.label + ": " + plural(size_t(view.samples), "path") +
                " a pixel, relative error " + formatted("%.3f", view.referenceError) + "\n";
    return text + "\n" + frontsText(results) + dominatedText(results) + notFiniteText(results);
}

} // namespace rebound::charts
