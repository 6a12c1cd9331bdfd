// SPDX-License-Identifier: MIT
// What a sweep's names stand for on this machine.
#include "lab/charts/source_hashes.hpp"
#include "lab/charts/workshop.hpp"
#include "lab/light/path_tracer.hpp"
#include "lab/scenes/scene_files.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <thread>

namespace rebound::charts {

namespace {

namespace fs = std::filesystem;

// builtin:atrium is atrium, scenes/hall.gltf is hall, scenes/hall/scene.gltf is hall.
std::string shortName(const std::string& scene) {
    constexpr std::string_view builtin = "builtin:";
    if (scene.starts_with(builtin)) return scene.substr(builtin.size());
    const fs::path path(scene);
    const std::string stem = path.stem().string();
    const std::string folder = path.parent_path().filename().string();
    return stem == "scene" && !folder.empty() ? folder : stem;
}

std::string uniqueLabel(std::string label, std::set<std::string>& taken) {
    const std::string base = label;
    for (int i = 2; !taken.insert(label).second; ++i) label = base + " " + std::to_string(i);
    return label;
}

Result<std::vector<lab::CameraView>> camerasOf(const lab::Scene& scene, const SceneChoice& choice) {
    if (choice.cameras.empty()) return scene.cameras;
    std::vector<lab::CameraView> cameras;
    for (const std::string& name : choice.cameras) {
        auto camera = lab::findCamera(scene, name);
        if (!camera) return Error{camera.error().code, "'" + choice.scene + "': " + camera.error().message};
        cameras.push_back(*std::move(camera));
    }
    return cameras;
}

std::vector<std::string> knownBackends() {
    std::vector<std::string> known = runner::backendNames();
    for (const cpu::Isa isa : cpu::availableIsas()) known.push_back(cpu::name(isa));
    return known;
}

} // namespace

Result<std::vector<View>> loadViews(const Sweep& sweep) {
    std::vector<View> views;
    std::set<std::string> labels;
    for (const SceneChoice& choice : sweep.scenes) {
        auto scene = lab::loadScene(choice.scene, choice.viewFile);
        if (!scene) return scene.error();
        const auto world = std::make_shared<const lab::Scene>(*std::move(scene));
        const auto cameras = camerasOf(*world, choice);
        if (!cameras) return cameras.error();
        lab::PathTracerOptions options;
        options.extent = sweep.size;
        options.bounces = sweep.reference.bounces;
        for (const lab::CameraView& camera : *cameras) {
            const std::string name = shortName(choice.scene) + (camera.name.empty() ? "" : " " + camera.name);
            views.push_back({uniqueLabel(name, labels), choice.scene, world, camera,
                             lab::pathTracerKey(*world, camera, options)});
        }
    }
    return views;
}

Result<std::vector<ChartBackend>> createBackends(const std::string& what,
                                                 const std::vector<std::string>& names,
                                                 const std::string& device, int threads) {
    const std::vector<std::string> known = knownBackends();
    std::vector<ChartBackend> backends;
    std::set<std::string> taken;
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            std::string list;
            for (const std::string& k : known) list += (list.empty() ? "" : ", ") + k;
            return invalidArgument(what + " holds \"" + name + "\"; some of " + list + " were expected");
        }
        if (!taken.insert(name).second) continue;
        runner::BackendChoice choice;
        choice.threads = threads;
        if (const auto isa = cpu::isaFromName(name)) choice.isa = *isa;
        else choice.backend = name;
        if (choice.backend != "cpu") choice.device = device;
        auto backend = runner::createBackend(choice);
        if (!backend) return backend.error();
        const runner::BackendInfo info = (*backend)->info();
        backends.push_back({name, info.backend == "cpu" ? runner::toText(info) : info.device,
                            sourceHash(info.backend), *std::move(backend)});
    }
    if (backends.empty())
        return invalidArgument(what + " is empty; some of cpu, vulkan and opengl were expected");
    return backends;
}

std::string describeMachine() {
    std::string name = "unknown processor";
    std::ifstream information("/proc/cpuinfo");
    for (std::string line; std::getline(information, line);)
        if (const size_t colon = line.find(": ");
            line.starts_with("model name") && colon != std::string::npos) {
            name = line.substr(colon + 2);
            break;
        }
    const unsigned cores = std::thread::hardware_concurrency();
    return name + ", " + std::to_string(cores) + (cores == 1 ? " core" : " cores");
}

} // namespace rebound::charts
