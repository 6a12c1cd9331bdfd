// SPDX-License-Identifier: MIT
// A walk through each scene made in code, five seconds long, with something that moves.
#include "lab/sequences/motion_path.hpp"

#include <utility>

namespace rebound::lab {

namespace {

MotionPath atriumPath() {
    MotionPath path;
    path.camera = {{0.0, {-10.2f, 1.8f, -0.5f}, {6.0f, 3.6f, 0.3f}, {}},
                   {1.7, {-7.4f, 1.75f, -1.2f}, {4.0f, 3.4f, 1.2f}, {}},
                   {3.4, {-4.6f, 1.7f, -0.6f}, {4.0f, 2.8f, 3.0f}, {}},
                   {5.0, {-2.6f, 1.75f, 0.6f}, {3.0f, 2.4f, 5.0f}, {}}};
    path.objects = {
        {"green cloth", {0, 0, 0}, {0, 1, 0}, {{0.0, {0, 0, 0}, 0.0f}, {5.0, {0.5f, 0, 0}, 0.0f}}}};
    return path;
}

MotionPath cornellPath() {
    MotionPath path;
    path.camera = {{0.0, {0.0f, 2.74f, 10.8f}, {0.0f, 2.74f, 0.0f}, {}},
                   {2.5, {1.2f, 2.4f, 9.6f}, {0.0f, 2.6f, 0.0f}, {}},
                   {5.0, {-0.8f, 3.0f, 8.8f}, {0.2f, 2.2f, 0.0f}, {}}};
    path.objects = {{"short block",
                     {1.0f, 0.0f, 0.9f},
                     {0, 1, 0},
                     {{0.0, {0, 0, 0}, 0.0f}, {5.0, {0.35f, 0, 0.4f}, 120.0f}}}};
    return path;
}

MotionPath studyPath() {
    MotionPath path;
    path.camera = {{0.0, {-1.3f, 1.5f, 1.3f}, {0.6f, 0.75f, -0.8f}, {}},
                   {2.0, {-0.5f, 1.4f, 0.9f}, {0.2f, 0.75f, -1.3f}, {}},
                   {3.6, {0.15f, 1.28f, 0.2f}, {-0.1f, 0.72f, -1.45f}, {}},
                   {5.0, {0.1f, 1.12f, -0.3f}, {-0.05f, 0.74f, -1.5f}, {}}};
    path.objects = {
        {"globe", {0.42f, 0.93f, -1.32f}, {0, 1, 0}, {{0.0, {0, 0, 0}, 0.0f}, {5.0, {0, 0, 0}, 300.0f}}},
        {"chair",
         {-0.05f, 0.0f, -0.32f},
         {0, 1, 0},
         {{0.0, {0, 0, 0}, 0.0f},
          {1.0, {0, 0, 0}, 0.0f},
          {3.0, {0.55f, 0, 0.45f}, -35.0f},
          {5.0, {0.75f, 0, 0.55f}, -45.0f}}}};
    return path;
}

MotionPath streetPath() {
    MotionPath path;
    path.camera = {{0.0, {1.1f, 1.65f, 5.5f}, {-0.6f, 2.9f, -20.0f}, {}},
                   {2.5, {0.6f, 1.65f, 1.0f}, {-0.2f, 2.6f, -20.0f}, {}},
                   {5.0, {-0.4f, 1.65f, -3.5f}, {1.0f, 2.4f, -22.0f}, {}}};
    path.objects = {
        {"van", {1.45f, 0.0f, -24.0f}, {0, 1, 0}, {{0.0, {0, 0, -4.0f}, 0.0f}, {5.0, {0, 0, 14.0f}, 0.0f}}}};
    return path;
}

MotionPath tunnelPath() {
    MotionPath path;
    path.camera = {{0.0, {1.3f, 1.45f, 1.2f}, {-0.2f, 0.9f, -9.0f}, {}},
                   {2.5, {1.45f, 1.4f, -2.2f}, {0.2f, 0.8f, -12.0f}, {}},
                   {5.0, {1.4f, 1.45f, -5.8f}, {0.6f, 0.9f, -16.0f}, {}}};
    path.objects = {
        {"valve", {-1.78f, 1.02f, -2.6f}, {1, 0, 0}, {{0.0, {0, 0, 0}, 0.0f}, {5.0, {0, 0, 0}, 540.0f}}}};
    return path;
}

} // namespace

std::optional<MotionPath> builtinPath(const std::string& scene) {
    constexpr std::pair<const char*, MotionPath (*)()> paths[] = {{"builtin:atrium", atriumPath},
                                                                  {"builtin:cornell", cornellPath},
                                                                  {"builtin:study", studyPath},
                                                                  {"builtin:street", streetPath},
                                                                  {"builtin:tunnel", tunnelPath}};
    for (const auto& [name, path] : paths)
        if (scene == name) return path();
    return std::nullopt;
}

} // namespace rebound::lab
