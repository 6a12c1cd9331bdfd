// SPDX-License-Identifier: MIT
#include "lab/runner/host_image.hpp"

#include "lab/runner/texels.hpp"

#include <glm/gtc/packing.hpp>

#include <cstring>

namespace rebound::runner {
namespace {

size_t sizeOf(cpu::Scalar scalar) { return scalar == cpu::Scalar::float16 ? 2 : 4; }
size_t pixelCount(Extent2D extent) { return size_t(extent.width) * size_t(extent.height); }

// Not a multiple of 4096 bytes, as cpu::Image asks for.
size_t planeSizeOf(Extent2D extent, cpu::Scalar scalar) {
    constexpr size_t page = 4096, apart = 320;
    return (pixelCount(extent) * sizeOf(scalar) + page - 1) / page * page + apart;
}

} // namespace

HostImage::HostImage(Extent2D size, int channelCount, cpu::Scalar precision)
    : extent(size), channels(channelCount), scalar(precision), planeSize(planeSizeOf(size, precision)),
      bytes(planeSize * size_t(channelCount)) {}

HostImage::HostImage(const lab::Image& image, cpu::Scalar precision)
    : HostImage(image.extent(), image.channels, precision) {
    assign(image);
}

void HostImage::assign(const lab::Image& image) {
    for (size_t c = 0; c < size_t(channels); ++c) {
        std::byte* next = bytes.data() + c * planeSize;
        for (size_t pixel = 0; pixel < pixelCount(extent); ++pixel, next += sizeOf(scalar)) {
            const float value = image.data[pixel * size_t(channels) + c];
            const uint16_t half = halfOf(value);
            std::memcpy(next, scalar == cpu::Scalar::float16 ? &half : static_cast<const void*>(&value),
                        sizeOf(scalar));
        }
    }
}

cpu::Image HostImage::view() {
    cpu::Image image = cpu::planarImage(bytes.data(), extent, channels, scalar);
    image.channelStride = ptrdiff_t(planeSize);
    return image;
}

lab::Image HostImage::toLabImage() const {
    lab::Image image(extent, channels);
    for (size_t c = 0; c < size_t(channels); ++c) {
        const std::byte* next = bytes.data() + c * planeSize;
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
    }
    return image;
}

} // namespace rebound::runner
