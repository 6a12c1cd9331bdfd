// SPDX-License-Identifier: MIT
#include "lab/rays/frame.hpp"

#include <string>

namespace rebound::lab {

namespace {

std::string sizeText(const Image& image) {
    return std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels of " +
           std::to_string(image.channels) + " channels";
}

Result<> checkImage(const Frame& frame, const char* name, const Image& image, int channels) {
    const bool complete = image.width > 0 && image.height > 0 && image.channels == channels &&
                          image.data.size() == size_t(image.width) * size_t(image.height) * size_t(channels);
    if (!complete)
        return Error{ErrorCode::invalidData, std::string("the frame's ") + name + " has " + sizeText(image) +
                                                 " and " + std::to_string(image.data.size()) +
                                                 " values; expected " + std::to_string(channels) +
                                                 " channels and at least one pixel"};
    if (image.extent() != frame.depth.extent())
        return Error{ErrorCode::invalidData, std::string("the frame's ") + name + " has " + sizeText(image) +
                                                 ", but its depth has " + sizeText(frame.depth) +
                                                 "; expected one size"};
    return {};
}

// Direct light that surfaces reflect, and what is added to it; empty: nothing.
Image reflectedAnd(const Image& emission, const Frame& frame) {
    if (!validate(frame)) return {};
    Image radiance = emission.empty() ? Image(frame.direct.extent(), 3) : emission;
    for (size_t i = 0; i < radiance.data.size(); ++i)
        radiance.data[i] += frame.albedo.data[i] * frame.direct.data[i];
    return radiance;
}

} // namespace

Image outgoingRadiance(const Frame& frame) { return reflectedAnd(frame.emission, frame); }

Image gatheredRadiance(const Frame& frame) {
    return reflectedAnd(frame.emissionIsDirectLight ? Image() : frame.emission, frame);
}

Result<> validate(const Frame& frame) {
    if (auto checked = checkImage(frame, "depth", frame.depth, 1); !checked) return checked;
    if (auto checked = checkImage(frame, "normal", frame.normal, 3); !checked) return checked;
    if (auto checked = checkImage(frame, "albedo", frame.albedo, 3); !checked) return checked;
    if (auto checked = checkImage(frame, "direct", frame.direct, 3); !checked) return checked;
    return frame.emission.empty() ? Result<>() : checkImage(frame, "emission", frame.emission, 3);
}

} // namespace rebound::lab
