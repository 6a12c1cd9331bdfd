// SPDX-License-Identifier: MIT
// Times of passes by the GPU's clock, without waiting for it.
#pragma once

#include "objects.hpp"

#include <deque>
#include <vector>

namespace rebound::opengl {

// Timestamps, since a GL_TIME_ELAPSED query of the host's may be active. A few frames are under way at once;
// where the GPU is further behind, frames go by untimed.
class PassTimer {
public:
    PassTimer(std::shared_ptr<const Gl>, const Plan&);

    void beginFrame();
    void endPass();
    void endFrame();
    // Of the latest frame whose results have arrived.
    const std::vector<PassTiming>& timings();

private:
    using Frame = std::vector<Object>; // a query before the first pass, and one after each
    std::vector<double> milliseconds(const Frame&) const;

    std::shared_ptr<const Gl> gl;
    std::vector<std::string> labels;
    std::deque<Frame> underWay, idle;
    Frame* current = nullptr; // the frame that is being issued; null: it is not timed
    size_t nextQuery = 0;
    std::vector<PassTiming> latest;
};

} // namespace rebound::opengl
