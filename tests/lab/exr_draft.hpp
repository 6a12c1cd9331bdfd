// SPDX-License-Identifier: MIT
// OpenEXR files of other programs: any channels, windows and attributes.
#pragma once

#include "temporary_folder.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>

#include <map>
#include <string>
#include <vector>

namespace rebound::lab {

// Channels of single precision, each a value a pixel of the data window.
struct ExrDraft {
    Imath::Box2i displayWindow{{0, 0}, {3, 1}};
    Imath::Box2i dataWindow{{0, 0}, {3, 1}};
    std::map<std::string, std::vector<float>> channels;
    std::vector<float> primaries; // x and y of red, green, blue, white; empty: none are stated
    float pixelAspectRatio = 1.0f;

    // The same value in every pixel.
    ExrDraft& constant(const std::string& name, float value) {
        const int width = dataWindow.max.x - dataWindow.min.x + 1,
                  height = dataWindow.max.y - dataWindow.min.y + 1;
        channels[name].assign(size_t(width) * size_t(height), value);
        return *this;
    }

    void write(const std::filesystem::path& file) {
        Imf::Header header(displayWindow, dataWindow, pixelAspectRatio);
        if (!primaries.empty()) {
            const auto point = [&](size_t i) { return Imath::V2f(primaries[2 * i], primaries[2 * i + 1]); };
            Imf::addChromaticities(header, {point(0), point(1), point(2), point(3)});
        }
        Imf::FrameBuffer frame;
        const size_t row = sizeof(float) * size_t(dataWindow.max.x - dataWindow.min.x + 1);
        for (auto& [name, values] : channels) {
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            frame.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), dataWindow, sizeof(float), row));
        }
        Imf::OutputFile output(file.c_str(), header, 0);
        output.setFrameBuffer(frame);
        output.writePixels(dataWindow.max.y - dataWindow.min.y + 1);
    }
};

} // namespace rebound::lab
