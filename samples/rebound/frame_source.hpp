// SPDX-License-Identifier: MIT
// The frame that a command works on, rendered from a scene or read from a folder.
#pragma once

#include "lab/rays/frame.hpp"
#include "options.hpp"

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace rebound::cli {

struct SourcedFrame {
    lab::Frame frame;
    std::string name; // the scene or the folder, as given
    bool isStored = false;
    std::shared_ptr<const lab::Scene> scene; // that was rendered; none of stored frames
    std::vector<std::string> notes; // what was converted, taken for something else or left out of its files
};

struct SourcedView {
    lab::Scene scene;
    lab::CameraView camera;
};

// What can be said about the scene's options before it is loaded.
Result<> checkSource(const SourceOptions&);

// The scene and camera that the options name; precondition: they name no stored frame.
Result<SourcedView> loadView(const SourceOptions&);

enum class WrongPixels { refuse, keep };

// Scenes are rendered at the given size, which frames in folders ignore. The result has passed checkPixels(), unless wrong
// pixels are kept.
Result<SourcedFrame> obtainFrame(const SourceOptions&, Extent2D, int threads,
                                 WrongPixels = WrongPixels::refuse);

// lab::checkFrame, with the frame's own names.
Result<> checkPixels(const SourcedFrame&);

// The frame's notes; of a stored one also what the input check finds.
Result<std::vector<std::string>> notesOf(const SourcedFrame&, int threads);

// The technique that was asked for, with its settings, in the frame's surroundings.
Result<techniques::Configured> configureFor(const SourcedFrame&, const TechniqueOptions&, int threads);

// "note: ", a line each.
void printNotes(const std::vector<std::string>&, std::ostream&);

} // namespace rebound::cli
