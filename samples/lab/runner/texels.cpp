// SPDX-License-Identifier: MIT
#include "lab/runner/texels.hpp"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rebound::runner {
namespace {

int channelsOf(Format format) { return format == Format::r32f || format == Format::r32ui ? 1 : 4; }

} // namespace

uint16_t halfOf(float value) {
    return glm::packHalf1x16(std::isnan(value) ? value : std::clamp(value, -largestHalf, largestHalf));
}

float roundToHalf(float value) { return glm::unpackHalf1x16(halfOf(value)); }

std::vector<std::byte> texelsOf(const lab::Image& image, Format format) {
    const size_t pixels = size_t(image.width) * size_t(image.height), channels = size_t(channelsOf(format));
    std::vector<std::byte> bytes(pixels * bytesPerTexel(format));
    std::byte* next = bytes.data();
    for (size_t pixel = 0; pixel < pixels; ++pixel)
        for (size_t c = 0; c < channels; ++c) {
            const float value =
                c < size_t(image.channels) ? image.data[pixel * size_t(image.channels) + c] : 0.0f;
            const uint16_t half = halfOf(value);
            const size_t size = format == Format::rgba16f ? sizeof half : sizeof value;
            std::memcpy(next, format == Format::rgba16f ? static_cast<const void*>(&half) : &value, size);
            next += size;
        }
    return bytes;
}

lab::Image imageOf(const std::byte* texels, Format format, Extent2D extent, int channels) {
    lab::Image image(extent, channels);
    const size_t size = format == Format::rgba16f ? sizeof(uint16_t) : sizeof(float);
    for (size_t i = 0; i < image.data.size(); ++i) {
        const size_t pixel = i / size_t(channels), c = i % size_t(channels);
        const std::byte* from = texels + pixel * bytesPerTexel(format) + c * size;
        if (format == Format::rgba16f) {
            uint16_t half = 0;
            std::memcpy(&half, from, sizeof half);
            image.data[i] = glm::unpackHalf1x16(half);
        } else {
            std::memcpy(&image.data[i], from, sizeof(float));
        }
    }
    return image;
}

void roundTo(Format format, lab::Image& image) {
    if (format != Format::rgba16f) return;
    for (float& value : image.data) value = roundToHalf(value);
}

} // namespace rebound::runner
