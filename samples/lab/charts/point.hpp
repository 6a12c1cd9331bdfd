// SPDX-License-Identifier: MIT
// One setting on one backend in one view: what it took, and how far it was from the truth.
#pragma once

#include "lab/metrics/metrics.hpp"
#include "lab/techniques/technique.hpp"
#include "rebound/extent.hpp"

#include <string>
#include <vector>

namespace rebound::charts {

using techniques::Json;

// Of a frame [ms].
struct Times {
    double median = 0.0;
    double minimum = 0.0;
    double percentile10 = 0.0;
    double percentile90 = 0.0;
    int frames = 0; // 0: not told
};

struct Point {
    std::string technique;
    std::string name; // of the setting
    Json settings;
    std::string view;    // its label: scene and camera
    std::string backend; // cpu avx2, vulkan; of a peer: its name
    std::string device;  // what the backend runs on
    std::string machine; // processor and cores
    bool isPeer = false; // a result from elsewhere
    Times times;
    metrics::ErrorMetrics metrics;
    std::string
        picture; // file name of its pictures in points/, without what follows: .png, -error.png and others

    // Points of one group compete: the same device of the same machine.
    std::string group() const { return backend + " (" + (isPeer ? machine : device) + ")"; }
};

// What the charts know of a view.
struct ViewRecord {
    std::string label;
    std::string scene; // as given
    std::string camera;
    int samples = 0;             // paths a pixel of its reference
    double referenceError = 0.0; // relative
    double errorScale = 0.0;     // where its error pictures' colours end [W m^-2 sr^-1]
    std::string picture;         // as of points: .png and -direct.png
};

struct Results {
    std::string version;
    std::string machine;
    Json sweep; // what was asked for
    Extent2D size;
    int bounces = 1; // in the references
    std::vector<ViewRecord> views;
    std::vector<Point> points;
};

inline constexpr int resultsFormat = 2; // of results.json and of points

Json toJson(const Times&);
Json toJson(const metrics::ErrorMetrics&);
Json toJson(const Point&);
Json toJson(const Results&);

// Throws lab::InputError or the JSON library's exception where something is missing or impossible.
Point pointFromJson(const nlohmann::json&);
Times timesFromJson(const nlohmann::json&, const std::string& where);

} // namespace rebound::charts
