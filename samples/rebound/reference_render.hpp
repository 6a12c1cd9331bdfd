// SPDX-License-Identifier: MIT
// render --technique reference: path-traced light instead of a technique's.
#pragma once

#include "lab/light/path_tracer.hpp"
#include "options.hpp"

namespace rebound::cli {

// As they were written; those that are absent have the path tracer's defaults.
struct ReferenceOptions {
    std::optional<int> bounces, samples;
    std::optional<double> error;
    std::optional<std::string> glossy;
    std::optional<unsigned> seed;
};

void addReferenceOptions(CLI::App&, ReferenceOptions&);

// The options of the path tracer, with errors that name those of the command line.
Result<lab::PathTracerOptions> pathTracerOptionsOf(const ReferenceOptions&, Extent2D, int threads);

const char* nameOf(lab::GlossyModel);

// Writes a frame folder with the light, its error and pictures, and says so on standard output.
Result<> renderReference(const SourceOptions&, const std::string& size, int threads, const ReferenceOptions&,
                         const std::string& out);

} // namespace rebound::cli
