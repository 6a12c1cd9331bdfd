// SPDX-License-Identifier: MIT
// The class that the README shows.
#pragma once

// [indirect light]
#include <rebound/cpu/device.hpp>
#include <rebound/techniques/screen_indirect.hpp>

#include <utility>

// The engine's images of one frame: interleaved 32-bit floats, row 0 on top.
struct Pictures {
    float* depth;    // along the viewing axis, in metres; 0: nothing there
    float* normal;   // world space
    float* radiance; // diffuse: albedo * E / pi, and emission that E does not hold
    float* albedo;
    float* lit;      // the picture so far
    float* composed; // lit + albedo * indirect
};

// Adds indirect light to pictures of one size. Made once, and again after a resize; the device,
// rebound::cpu::Device::create(), is made once.
class IndirectLight {
public:
    static rebound::Result<IndirectLight> create(const rebound::cpu::Device& device, rebound::Extent2D size) {
        auto settings = rebound::screenIndirectPreset("quarter-64", size);
        if (!settings) return settings.error();
        settings->writeIndirect = false;                    // the composed picture alone
        auto plan = rebound::planScreenIndirect(*settings); // what will run, as a value
        if (!plan) return plan.error();
        auto program = device.compile(*plan); // allocates; frames do not
        if (!program) return program.error();
        return IndirectLight(*settings, std::move(*program));
    }

    // Once a frame.
    rebound::Result<> add(const rebound::Camera& camera, const Pictures& pictures) {
        const auto image = [&](float* data, int channels) {
            return rebound::cpu::interleavedImage(data, settings.resolution, channels);
        };
        rebound::ScreenIndirectFrame<rebound::cpu::Image> frame;
        frame.camera = camera;
        frame.depth = image(pictures.depth, 1);
        frame.normal = image(pictures.normal, 3);
        frame.radiance = image(pictures.radiance, 3);
        frame.albedo = image(pictures.albedo, 3);
        frame.lit = image(pictures.lit, 3);
        frame.composed = image(pictures.composed, 3);
        auto inputs = rebound::screenIndirectInputs(settings, frame);
        if (!inputs) return inputs.error();
        return program.record(*inputs);
    }

private:
    IndirectLight(const rebound::ScreenIndirectSettings& s, rebound::cpu::Program p)
        : settings(s), program(std::move(p)) {}

    rebound::ScreenIndirectSettings settings;
    rebound::cpu::Program program;
};
// [/indirect light]
