// SPDX-License-Identifier: MIT
// One frame's input to screen-space techniques: a G-buffer and the direct light on it.
#pragma once

#include "lab/images/image.hpp"
#include "lab/scenes/scene.hpp"

#include <filesystem>
#include <functional>
#include <vector>

namespace rebound::lab {

// All images have the same size, row 0 on top, sampled at pixel centres; pixels that see nothing are zero everywhere.
struct Frame {
    CameraView camera;
    Image depth;    // 1 channel: distance along the viewing axis, not along the ray [m]; 0: nothing there
    Image normal;   // 3 channels: interpolated vertex normal, unit, world space, turned towards the camera
    Image albedo;   // 3 channels: diffuse reflectance
    Image direct;   // 3 channels: E_direct / pi, albedo not in it [W m^-2 sr^-1]
    Image emission; // 3 channels: radiance the surface itself emits [W m^-2 sr^-1]; empty: nothing emits
    // 2 channels: where what a pixel shows was in the frame before, less where it is [pixels, x to the right, y with the
    // rows]; behindCamera where that was behind its camera; 0 where nothing is shown. Empty: there was no frame before.
    Image motion;
    CameraView previousCamera; // of the frame before, where there was one
};

// Of a point that was behind the camera: beyond every picture [pixels].
inline constexpr float behindCamera = 65504.0f;

// What a frame goes on from.
struct PreviousFrame {
    CameraView camera;
    std::vector<std::vector<glm::vec3>> positions; // by mesh of the scene: where its vertices were [m]
};

// Called now and then with the share that is done, 0 to 1; from any thread, one call at a time.
using Progress = std::function<void(double)>;

struct FrameOptions {
    Extent2D extent{1280, 720};
    int lightSamples =
        16; // shadow rays a pixel for each area light, for all emissive surfaces, and for the environment
    int threads = 0; // 0: one a core
    Progress progress = {};
    const PreviousFrame* previous = nullptr; // of a scene of the same meshes; null: the frame has no motion
};

// Casts primary rays, and shadow rays to every light, emissive surface and the environment. The same scene, camera and
// options give the same bits, whatever the thread count.
Result<Frame> renderFrame(const Scene&, const CameraView&, const FrameOptions&);

// Outgoing diffuse radiance, albedo * direct + emission: what a surface sends to others. Empty for an invalid frame.
Image outgoingRadiance(const Frame&);

// Reads depth.exr, normal.exr, albedo.exr, direct.exr, emission.exr (optional) and the camera from meta.json.
// A view file and a camera's name replace meta.json's camera.
Result<Frame> readFrame(const std::filesystem::path& folder, const std::filesystem::path& viewFile = {},
                        const std::string& cameraName = {});

// Checks that the images are there, not empty, and of one size.
Result<> validate(const Frame&);

} // namespace rebound::lab
