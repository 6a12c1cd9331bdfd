// SPDX-License-Identifier: MIT
#include "pass_timer.hpp"

namespace rebound::opengl {
namespace {

constexpr int framesUnderWay = 4;
constexpr GLenum gpuDisjoint = 0x8FBB; // GL_GPU_DISJOINT_EXT

} // namespace

PassTimer::PassTimer(std::shared_ptr<const Gl> functions, const Plan& plan) : gl(std::move(functions)) {
    for (const Pass& pass : plan.passes) labels.push_back(pass.label);
    for (int i = 0; i < framesUnderWay; ++i) {
        Frame& frame = idle.emplace_back();
        for (size_t q = 0; q < labels.size() + 1; ++q) frame.emplace_back(gl, ObjectKind::query);
    }
}

void PassTimer::beginFrame() {
    timings(); // frees the queries of frames that are done
    current = nullptr;
    if (idle.empty()) return;
    underWay.push_back(std::move(idle.front()));
    idle.pop_front();
    current = &underWay.back();
    nextQuery = 0;
    endPass();
}

void PassTimer::endPass() {
    if (current) gl->QueryCounter((*current)[nextQuery++].name(), GL_TIMESTAMP);
}

void PassTimer::endFrame() { current = nullptr; }

const std::vector<PassTiming>& PassTimer::timings() {
    if (!gl->loss.check()) return latest;
    while (!underWay.empty() && &underWay.front() != current) {
        const Frame& frame = underWay.front();
        GLuint available = 0;
        gl->GetQueryObjectuiv(frame.back().name(), GL_QUERY_RESULT_AVAILABLE, &available);
        if (!available) break;
        // On ES the clock may jump, when the GPU changes its frequency for example, which this tells.
        const bool jumped = gl->es && gl->integer(gpuDisjoint) != 0;
        const std::vector<double> times = milliseconds(frame);
        // Of a lost context, every query is available and none has a result.
        if (!gl->checkPresent("reading timestamps")) break;
        if (!jumped) {
            latest.clear();
            for (size_t i = 0; i < labels.size(); ++i) latest.push_back({labels[i], times[i]});
        }
        idle.push_back(std::move(underWay.front()));
        underWay.pop_front();
    }
    return latest;
}

std::vector<double> PassTimer::milliseconds(const Frame& frame) const {
    std::vector<double> times;
    GLuint64 before = 0;
    for (size_t i = 0; i < frame.size(); ++i) {
        GLuint64 nanoseconds = 0;
        gl->GetQueryObjectui64v(frame[i].name(), GL_QUERY_RESULT, &nanoseconds);
        if (i > 0) times.push_back(double(nanoseconds - before) * 1e-6);
        before = nanoseconds;
    }
    return times;
}

} // namespace rebound::opengl
