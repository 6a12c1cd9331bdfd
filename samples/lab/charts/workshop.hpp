// SPDX-License-Identifier: MIT
// Where a chart's truth and measurements come from. Tests put their own in the place of the lab's.
#pragma once

#include "lab/charts/sweep.hpp"
#include "lab/rays/frame.hpp"
#include "lab/runner/runner.hpp"
#include "lab/scenes/scene.hpp"

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace rebound::charts {

struct View {
    std::string label; // such as "atrium nave", unique in a chart
    std::string scene; // as given
    std::shared_ptr<const lab::Scene> world;
    lab::CameraView camera;
    std::string contentKey; // a hash of all that its truth depends on
};

struct Truth {
    lab::Image light;                 // E / pi of indirect light, albedo not in it [W m^-2 sr^-1]
    std::array<lab::Image, 2> halves; // independent, of which it is the mean; empty where there are none
    lab::Image visible;               // 1 channel: above 0 where there is a surface
    lab::Image direct;                // emission + albedo * E / pi of direct light, for people
    int samples = 0;                  // paths a pixel
    double relativeError = 0.0;
};

struct Trial {
    std::vector<double> milliseconds; // of each measured frame
    lab::Image light;                 // as Truth::light
};

struct ChartBackend {
    std::string label;  // as it was asked for
    std::string device; // what it runs on
    std::string source; // a hash of the code that is measured
    std::unique_ptr<runner::Backend> backend;
};

class Workshop {
public:
    virtual ~Workshop() = default;
    virtual Result<Truth> truth(const View&, const lab::Progress&) = 0;
    virtual Result<Trial> measure(const View&, const techniques::Configured&, ChartBackend&,
                                  const lab::Progress&) = 0;
};

// Scenes are rendered and path traced; references are kept in a folder. One view's frame is held at a time.
class LabWorkshop : public Workshop {
public:
    LabWorkshop(const Sweep& what, runner::Precision hostPrecision, std::filesystem::path referenceFolder)
        : sweep(what), precision(hostPrecision), references(std::move(referenceFolder)) {}

    Result<Truth> truth(const View&, const lab::Progress&) override;
    Result<Trial> measure(const View&, const techniques::Configured&, ChartBackend&,
                          const lab::Progress&) override;

private:
    Result<> prepareFrame(const View&, const lab::Progress&);

    const Sweep& sweep;
    runner::Precision precision;
    std::filesystem::path references;
    std::string frameOf; // the label of the view whose frame is held
    lab::Frame frame;
};

// The views that a sweep asks for. Every scene is loaded, and every camera has to exist.
Result<std::vector<View>> loadViews(const Sweep&);

// cpu (its best instruction set), vulkan, opengl, or an instruction set of the CPU. `what` is what errors call the list;
// device: part of a GPU's name.
Result<std::vector<ChartBackend>> createBackends(const std::string& what,
                                                 const std::vector<std::string>& names,
                                                 const std::string& device, int threads);

// The processor's name and its cores.
std::string describeMachine();

} // namespace rebound::charts
