// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <algorithm>

namespace rebound::cli {

namespace {

std::string megabytes(size_t bytes) { return formatted("%.2f MB", double(bytes) / 1e6); }

} // namespace

std::string toText(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string describeRun(const SourcedFrame& source, const techniques::Configured& technique,
                        const runner::BackendInfo& backend, runner::Precision precision) {
    std::string text = source.name;
    if (!source.frame.camera.name.empty()) text += ", camera " + source.frame.camera.name;
    const Extent2D size = source.frame.depth.extent();
    return text + ", " + std::to_string(size.width) + "x" + std::to_string(size.height) + ", " +
           runner::toText(backend) + ", images in " + nameOf(precision) + "\n" + technique.description + "\n";
}

Json runToJson(const SourcedFrame& source, const techniques::Configured& technique,
               const runner::BackendInfo& backend, runner::Precision precision, const MemoryUse& memory) {
    Json json;
    json[source.isStored ? "frame_folder" : "scene"] = source.name;
    json["camera"] = source.frame.camera.name;
    json["resolution"] = {source.frame.depth.width, source.frame.depth.height};
    json["technique"] = technique.plan.technique;
    json["settings"] = technique.settings;
    json["backend"] = backend.backend;
    if (backend.backend == "cpu") {
        json["isa"] = backend.isa;
        json["threads"] = backend.threads;
    } else {
        json["device"] = backend.device;
    }
    json["precision"] = nameOf(precision);
    json["memory"] = {{"transient_bytes", memory.transient},
                      {"transient_unshared_bytes", memory.transientUnshared},
                      {"buffer_bytes", memory.buffers},
                      {"total_bytes", memory.total()}};
    return json;
}

std::string toTable(const std::vector<std::string>& headings, const std::vector<TableRow>& rows,
                    LastRow last) {
    size_t nameWidth = headings[0].size();
    for (const TableRow& row : rows) nameWidth = std::max(nameWidth, row.first.size());
    const auto widthOf = [](const std::string& heading) { return int(std::max<size_t>(heading.size(), 12)); };
    const auto padded = [&](const std::string& name) {
        return name + std::string(nameWidth - name.size(), ' ');
    };
    std::string text = padded(headings[0]);
    for (size_t i = 1; i < headings.size(); ++i)
        text += formatted("  %*s", widthOf(headings[i]), headings[i].c_str());
    text += "\n";
    const std::string rule(text.size() - 1, '-');
    for (const TableRow& row : rows) {
        if (last == LastRow::apart && &row == &rows.back()) text += rule + "\n";
        text += padded(row.first);
        for (size_t i = 0; i < row.second.size(); ++i)
            text += formatted("  %*.2f", widthOf(headings[i + 1]), row.second[i]);
        text += "\n";
    }
    return text;
}

std::string toText(const MemoryUse& memory) {
    return megabytes(memory.total()) + ": " + megabytes(memory.transient) +
           " for images that live within a frame (" + megabytes(memory.transientUnshared) +
           " if they shared nothing), " + megabytes(memory.buffers) + " for constants and patterns";
}

} // namespace rebound::cli
