// SPDX-License-Identifier: MIT
// A scene in motion: its frames one after the other, each with how it goes on from the one before.
#pragma once

#include "lab/rays/frame.hpp"
#include "lab/scenes/scene_files.hpp"
#include "lab/sequences/motion_path.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace rebound::lab {

struct SequenceOptions {
    std::string scene;              // as loadScene() takes it
    std::filesystem::path viewFile; // likewise
    std::string camera;             // a camera's name; empty: the first
    SceneMoment moment;             // of frame 0; an animation goes on with the frames' times
    MotionPath path;
    double framesPerSecond = 30.0;
};

class Sequence {
public:
    // Loads the scene as it is at 0 s. Fails where it, its camera or an object of the path does not exist, or a camera
    // of the path is invalid.
    static Result<Sequence> open(const SequenceOptions&);

    // The next frame, number 0 first: at number / framesPerSecond seconds. All but the first have motion.
    Result<Frame> next(const FrameOptions&);

    // As it is in the last frame, or at 0 s before there was one.
    const Scene& current() const { return scene; }

    // What the scene's file holds that the lab leaves out or takes for something else: sentences.
    const std::vector<std::string>& notes() const { return scene.notes; }

private:
    Sequence(MovingScene scene, const SequenceOptions&);
    Result<> moveTo(double time);
    SceneMoment momentAt(double time) const;

    MovingScene source;
    SequenceOptions options;
    Scene scene;
    CameraView camera;
    std::optional<PreviousFrame> previous;
    int number = 0;
};

} // namespace rebound::lab
