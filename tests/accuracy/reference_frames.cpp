// SPDX-License-Identifier: MIT
#include "reference_frames.hpp"
#include "take.hpp"

#include "lab/images/image_files.hpp"
#include "lab/scenes/camera_matrices.hpp"
#include "rebound/cpu/device.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace rebound::accuracy {
namespace {

// By view: what screen space can reach there. An empty object where there is no such file.
nlohmann::ordered_json limitsOf(const std::filesystem::path& shared) {
    std::ifstream file(shared / "reference" / "limits.json");
    return file ? nlohmann::ordered_json::parse(file) : nlohmann::ordered_json::object();
}

} // namespace

std::vector<ReferenceView> loadReferenceViews(const std::filesystem::path& shared) {
    std::vector<ReferenceView> views;
    const nlohmann::ordered_json limits = limitsOf(shared);
    for (const auto& [name, presets] : limits.items()) {
        const std::filesystem::path folder = shared / "reference" / name;
        ReferenceView view{
            name, take(lab::readFrame(folder)), take(lab::readExr(folder / "indirect_1.exr")), {}, {}};
        view.bruteForce = {presets.at("brute").at(0).get<double>(), presets.at("brute").at(1).get<double>()};
        views.push_back(std::move(view));
    }
    return views;
}

lab::Image gather(const ReferenceView& view, ScreenIndirectSettings settings) {
    const lab::Frame& frame = view.frame;
    const Extent2D extent = frame.depth.extent();
    settings.compose = false;
    const cpu::Device device = take(cpu::Device::create());
    cpu::Program program = take(device.compile(take(planScreenIndirect(settings))));
    lab::Image radiance = lab::gatheredRadiance(frame), result(extent, 3);
    const auto image = [&](const lab::Image& i) {
        return cpu::interleavedImage(const_cast<float*>(i.data.data()), extent, i.channels);
    };
    ScreenIndirectFrame<cpu::Image> inputs;
    inputs.camera = lab::cameraMatrices(frame.camera, extent);
    inputs.depth = image(frame.depth);
    inputs.normal = image(frame.normal);
    inputs.radiance = image(radiance);
    inputs.indirect = image(result);
    take(program.record(take(screenIndirectInputs(settings, inputs))));
    return result;
}

lab::Image comparablePixels(const lab::Frame& frame, const lab::Image& indirect) {
    lab::Image mask(frame.depth.extent(), 1);
    for (size_t i = 0; i < mask.data.size(); ++i) {
        const bool isLit = frame.direct.data[3 * i] > 0.0f || indirect.data[3 * i] > 0.0f;
        mask.data[i] = frame.depth.data[i] > 0.0f && isLit ? 1.0f : 0.0f;
    }
    return mask;
}

ImageError errorOf(const lab::Image& result, const ReferenceView& view, const lab::Image& mask) {
    const bool hasHalves = !view.halves[0].empty();
    const lab::Image& first = hasHalves ? view.halves[0] : view.truth;
    const lab::Image& second = hasHalves ? view.halves[1] : view.truth;
    double squared = 0, truth = 0, sum = 0, count = 0;
    for (size_t pixel = 0; pixel < view.frame.depth.data.size(); ++pixel) {
        if (mask.data[pixel] <= 0.0f) continue;
        for (size_t c = 0; c < 3; ++c) {
            const double r = result.data[3 * pixel + c], t = view.truth.data[3 * pixel + c];
            squared += (r - double(first.data[3 * pixel + c])) * (r - double(second.data[3 * pixel + c]));
            truth += t;
            sum += r;
            count += 1;
        }
    }
    return {std::sqrt(squared / count) / (truth / count), sum / truth};
}

ImageError errorOf(const lab::Image& result, const ReferenceView& view) {
    return errorOf(result, view, view.frame.depth);
}

} // namespace rebound::accuracy
