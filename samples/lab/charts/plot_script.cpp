// SPDX-License-Identifier: MIT
#include "lab/charts/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rebound::charts {

namespace {

// Okabe and Ito, Color Universal Design: told apart with any colour vision.
constexpr std::array<const char*, 7> colours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                "#E69F00", "#56B4E9", "#000000"};
constexpr std::array<int, 7> markers = {7, 5, 9, 11, 13, 15, 4}; // discs, squares, triangles, ...
// Of an axis, as shares of its length: at its low end, names of the front's points need room.
constexpr double lowMargin = 0.12, highMargin = 0.04;
constexpr double leastLength = 0.05; // of an axis, in powers of ten

// gnuplot's single quotes know one escape: two of them are one.
std::string quotedText(const std::string& text) {
    std::string result = "'";
    for (const char c : text)
        if (c == '\'') result += "''";
        else result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    return result + "'";
}

// In double quotes, as data needs it.
std::string quotedLabel(const std::string& text) {
    std::string result = "\"";
    for (const char c : text)
        result += c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    return result + "\"";
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = 0.0;

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void widen() {
        const double length = std::max(std::log10(high / low), leastLength);
        low *= std::pow(10.0, -lowMargin * length);
        high *= std::pow(10.0, highMargin * length);
    }
};

// Ticks that people would choose: the denser, the shorter the axis.
std::string ticks(const Range& range) {
    std::vector<double> steps = {1, 2, 5};
    if (range.high / range.low < 40.0) steps = {1, 1.5, 2, 3, 4, 5, 7};
    if (range.high / range.low < 3.0) {
        steps.clear();
        for (int tenth = 10; tenth < 100; tenth += tenth < 20 ? 1 : tenth < 50 ? 2 : 5)
            steps.push_back(double(tenth) / 10.0);
    }
    std::string text;
    for (int decade = int(std::floor(std::log10(range.low)));
         decade <= int(std::ceil(std::log10(range.high))); ++decade)
        for (const double step : steps)
            if (const double value = step * std::pow(10.0, decade); value >= range.low && value <= range.high)
                text += (text.empty() ? "" : ", ") + std::string("'") + number(value) + "' " + number(value);
    return "(" + text + ")";
}

std::vector<std::string> techniquesOf(const std::vector<ChartPoint>& points) {
    std::vector<std::string> techniques;
    for (const ChartPoint& point : points)
        if (std::find(techniques.begin(), techniques.end(), point.technique) == techniques.end())
            techniques.push_back(point.technique);
    return techniques;
}

template <class Keep>
std::string dataBlock(const std::string& name, const std::vector<ChartPoint>& points, Keep keep) {
    std::vector<const ChartPoint*> kept;
    for (const ChartPoint& point : points)
        if (keep(point)) kept.push_back(&point);
    if (kept.empty()) return {};
    std::stable_sort(kept.begin(), kept.end(), [](const ChartPoint* a, const ChartPoint* b) {
        return a->times.median < b->times.median;
    });
    std::string text = "$" + name + " << EOD\n";
    for (const ChartPoint* p : kept)
        text += number(p->times.median) + " " + number(p->error) + " " + number(p->times.percentile10) + " " +
                number(p->times.percentile90) + " " + quotedLabel(p->name) + "\n";
    return text + "EOD\n";
}

// Data blocks and the plot command's parts that draw them.
struct Layers {
    std::string data;
    std::vector<std::string> parts;
};

void addGroup(Layers& layers, const Chart& chart, const std::string& group, size_t index) {
    const std::string colour = quotedText(colours[index % colours.size()]);
    const std::string id = std::to_string(index);
    const auto inGroup = [&](const ChartPoint& p) { return p.group == group; };
    layers.data +=
        dataBlock("front" + id, chart.points, [&](const auto& p) { return inGroup(p) && p.isOnFront; });
    layers.parts.push_back("$front" + id + " using 1:2 with steps lw 1.5 lc rgb " + colour + " notitle");
    const std::vector<std::string> techniques = techniquesOf(chart.points);
    for (size_t t = 0; t < techniques.size(); ++t) {
        const std::string name = "points" + id + "_" + std::to_string(t);
        const std::string block = dataBlock(
            name, chart.points, [&](const auto& p) { return inGroup(p) && p.technique == techniques[t]; });
        if (block.empty()) continue;
        layers.data += block;
        const std::string marker = std::to_string(markers[t % markers.size()]);
        layers.parts.push_back("$" + name + " using 1:2:3:4 with xerrorbars pt " + marker +
                               " ps 0.9 lw 1 lc rgb " + colour + " title " +
                               quotedText(techniques[t] + " on " + group));
    }
    layers.parts.push_back(
        "$front" + id +
        " using 1:2:5 with labels right rotate by 30 offset -0.6,-0.3 font ',9' noenhanced tc rgb " + colour +
        " notitle");
}

std::string plotOf(const Chart& chart, const PlotTexts& texts) {
    Range x, y;
    for (const ChartPoint& point : chart.points) {
        x.add(point.times.percentile10);
        x.add(point.times.percentile90);
        x.add(point.times.median);
        y.add(point.error);
    }
    x.widen();
    y.widen();
    Layers layers;
    const std::vector<std::string> groups = groupsOf(chart.points);
    for (size_t i = 0; i < groups.size(); ++i) addGroup(layers, chart, groups[i], i);
    std::string text =
        "set title " + quotedText(chart.title) + ".\"\\n\"." + quotedText(texts.subtitle) + "\n";
    text += "set xrange [" + number(x.low) + ":" + number(x.high) + "]\n";
    text += "set yrange [" + number(y.low) + ":" + number(y.high) + "]\n";
    text += "set xtics " + ticks(x) + "\nset ytics " + ticks(y) + "\n" + layers.data + "plot ";
    for (size_t i = 0; i < layers.parts.size(); ++i) text += (i == 0 ? "" : ", \\\n    ") + layers.parts[i];
    return text + "\n";
}

} // namespace

std::string plotScript(const std::vector<Chart>& charts, const PlotTexts& texts,
                       const std::filesystem::path& folder) {
    std::string script =
        "set encoding utf8\nset logscale xy\nset grid lc rgb '#d0d0d0' lt 1 lw 0.5\n"
        "set border 3 lc rgb '#404040'\nset tics nomirror\nset bars 0.4\n"
        "set key below center vertical maxrows 4 height 1 spacing 1.2 noenhanced\nset title noenhanced\n"
        "set xlabel " +
        quotedText(texts.xLabel) + " noenhanced\nset ylabel " + quotedText(texts.yLabel) + " noenhanced\n";
    const std::pair<const char*, const char*> terminals[] = {
        {".svg", "svg size 960,640 dynamic background rgb 'white' font 'DejaVu Sans,12'"},
        {".png",
         "pngcairo size 1440,960 background rgb 'white' font 'DejaVu Sans,12' fontscale 1.3 linewidth 1.5 "
         "pointscale 1.4"}};
    for (const auto& [end, terminal] : terminals) {
        script += std::string("set terminal ") + terminal + "\n";
        for (const Chart& chart : charts)
            if (!chart.points.empty())
                script += "set output " + quotedText((folder / (chart.fileName + end)).string()) + "\n" +
                          plotOf(chart, texts) + "set output\n";
    }
    return script;
}

} // namespace rebound::charts
