// SPDX-License-Identifier: MIT
// The frame that a command works on, rendered from a scene or read from a folder.
#pragma once

#include "lab/rays/frame.hpp"
#include "options.hpp"

namespace rebound::cli {

struct SourcedFrame {
    lab::Frame frame;
    std::string name; // the scene or the folder, as given
    bool isStored = false;
};

struct SourcedView {
    lab::Scene scene;
    lab::CameraView camera;
};

// What can be said about the scene's options before it is loaded.
Result<> checkSource(const SourceOptions&);

// The scene and camera that the options name; precondition: they name no stored frame.
Result<SourcedView> loadView(const SourceOptions&);

// Scenes are rendered at the given size, which frames in folders ignore. The result has passed lab::checkFrame.
Result<SourcedFrame> obtainFrame(const SourceOptions&, Extent2D, int threads);

} // namespace rebound::cli
