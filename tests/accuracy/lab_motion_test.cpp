// SPDX-License-Identifier: MIT
// The lab's motion as an engine's would be checked: by the input check, against depth and both cameras.
#include "take.hpp"

#include "lab/examine/frame_examination.hpp"
#include "lab/sequences/sequence.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace rebound;
using rebound::accuracy::take;

namespace {

// The second frame of the built-in camera path.
lab::Frame frameInMotion(const std::string& scene) {
    lab::SequenceOptions options;
    options.scene = scene;
    auto path = lab::builtinPath(scene);
    REQUIRE(path);
    options.path = *std::move(path);
    options.path.objects.clear(); // the check takes the scene to stand still
    options.framesPerSecond = 5.0;
    lab::Sequence sequence = take(lab::Sequence::open(options));
    const lab::FrameOptions frameOptions{.extent = {256, 144}, .lightSamples = 1};
    for (int i = 0; i < 3; ++i) take(sequence.next(frameOptions));
    return take(sequence.next(frameOptions));
}

std::vector<std::string> problemsOf(const lab::Frame& frame) {
    std::vector<std::string> problems;
    for (const InputFinding& finding : take(examine::examineFrame(frame, 0)))
        problems.push_back(name(finding.problem));
    return problems;
}

lab::Frame withMotion(lab::Frame frame, float factorX, float factorY) {
    for (size_t i = 0; i < frame.motion.data.size(); i += 2) {
        frame.motion.data[i] *= factorX;
        frame.motion.data[i + 1] *= factorY;
    }
    return frame;
}

} // namespace

TEST_CASE("the input check agrees with the lab's motion, and names it where it is spoiled") {
    for (const char* scene : {"builtin:atrium", "builtin:street"}) {
        CAPTURE(scene);
        const lab::Frame frame = frameInMotion(scene);
        REQUIRE_FALSE(frame.motion.empty());
        CHECK(*std::max_element(frame.motion.data.begin(), frame.motion.data.end()) > 0.5f); // it does move
        CHECK(problemsOf(frame) == std::vector<std::string>{});
        CHECK(problemsOf(withMotion(frame, -1.0f, -1.0f)) == std::vector<std::string>{"motionDirection"});
        CHECK(problemsOf(withMotion(frame, 1.0f / 256.0f, 1.0f / 144.0f)) ==
              std::vector<std::string>{"motionUnit"});
        CHECK(problemsOf(withMotion(frame, 7.0f, -3.0f)) ==
              std::vector<std::string>{"motionContradictsScene"});
    }
}
