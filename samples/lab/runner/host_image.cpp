// SPDX-License-Identifier: MIT
#include "lab/runner/host_image.hpp"

#include "lab/runner/texels.hpp"

#include <glm/gtc/packing.hpp>

#include <cstring>

namespace rebound::runner {
namespace {

size_t sizeOf(cpu::Scalar scalar) { return scalar == cpu::Scalar::float16 ? 2 : 4; }
size_t pixelCount(Extent2D extent) { return size_t(extent.width) * size_t(extent.height); }

} // namespace

HostImage::HostImage(Extent2D size, int channelCount, cpu::Scalar precision)
    : extent(size), channels(channelCount), scalar(precision),
      bytes(pixelCount(size) * size_t(channelCount) * sizeOf(precision)) {}

HostImage::HostImage(const lab::Image& image, cpu::Scalar precision)
    : HostImage(image.extent(), image.channels, precision) {
    assign(image);
}

void HostImage::assign(const lab::Image& image) {
    std::byte* next = bytes.data();
    for (size_t c = 0; c < size_t(channels); ++c)
        for (size_t pixel = 0; pixel < pixelCount(extent); ++pixel, next += sizeOf(scalar)) {
            const float value = image.data[pixel * size_t(channels) + c];
            const uint16_t half = halfOf(value);
            std::memcpy(next, scalar == cpu::Scalar::float16 ? &half : static_cast<const void*>(&value),
                        sizeOf(scalar));
        }
}

cpu::Image HostImage::view() { return cpu::planarImage(bytes.data(), extent, channels, scalar); }

lab::Image HostImage::toLabImage() const {
    lab::Image image(extent, channels);
    const std::byte* next = bytes.data();
    for (size_t c = 0; c < size_t(channels); ++c)
        for (size_t pixel = 0; pixel < pixelCount(extent); ++pixel, next += sizeOf(scalar)) {
            float& value = image.data[pixel * size_t(channels) + c];
            if (scalar != cpu::Scalar::float16) {
                std::memcpy(&value, next, sizeof value);
            } else {
                uint16_t half = 0;
                std::memcpy(&half, next, sizeof half);
                value = glm::unpackHalf1x16(half);
            }
        }
    return image;
}

} // namespace rebound::runner
