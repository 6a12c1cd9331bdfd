// SPDX-License-Identifier: MIT
// Results from elsewhere: a folder of folders, each with peer.json and indirect.exr.
#pragma once

#include "lab/charts/point.hpp"
#include "lab/charts/workshop.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rebound::charts {

struct Peer {
    std::filesystem::path folder;
    Point point;      // but for metrics
    lab::Image light; // E / pi of indirect light
};

// Every sub-folder is a peer, in the order of their names. Fails, naming the file, where one lacks a file, is of a view
// that is not among these, or is not of that size.
Result<std::vector<Peer>> readPeers(const std::filesystem::path&, const std::vector<View>&, Extent2D size);

} // namespace rebound::charts
