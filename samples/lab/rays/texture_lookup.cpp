// SPDX-License-Identifier: MIT
#include "lab/rays/texture_lookup.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rebound::lab {

namespace {

std::array<float, 256> makeSrgbTable() {
    std::array<float, 256> table{};
    for (size_t i = 0; i < table.size(); ++i) {
        const double encoded = double(i) / 255.0;
        table[i] = float(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
    }
    return table;
}

const std::array<float, 256>& srgbTable() {
    static const std::array<float, 256> table = makeSrgbTable();
    return table;
}

int wrapped(int texel, int size, Wrap wrap) {
    if (wrap == Wrap::clamp) return std::clamp(texel, 0, size - 1);
    const int period = wrap == Wrap::mirror ? 2 * size : size;
    const int phase = (texel % period + period) % period;
    return phase < size ? phase : period - 1 - phase;
}

// The two texels that a coordinate lies between, and the weight of the second.
struct Neighbours {
    int first;
    int second;
    float weight;
};

Neighbours neighbours(float coordinate, int size, Wrap wrap) {
    double turns = std::isfinite(coordinate) ? double(coordinate) : 0.0;
    // Two is a period of every mode but clamping, and keeps the texel within an int.
    turns = wrap == Wrap::clamp ? std::clamp(turns, -1.0, 2.0) : turns - 2.0 * std::floor(0.5 * turns);
    const double texel = turns * size - 0.5;
    const int first = int(std::floor(texel));
    return {wrapped(first, size, wrap), wrapped(first + 1, size, wrap), float(texel - first)};
}

template <class Value, class Fetch>
Value bilinear(const Texture& texture, glm::vec2 coordinate, const Fetch& fetch) {
    const Neighbours s = neighbours(coordinate.x, texture.width, texture.wrapS);
    const Neighbours t = neighbours(coordinate.y, texture.height, texture.wrapT);
    const auto at = [&](int x, int y) {
        return fetch(&texture.rgba[(size_t(y) * size_t(texture.width) + size_t(x)) * 4]);
    };
    const Value top = at(s.first, t.first) * (1.0f - s.weight) + at(s.second, t.first) * s.weight;
    const Value bottom = at(s.first, t.second) * (1.0f - s.weight) + at(s.second, t.second) * s.weight;
    return top * (1.0f - t.weight) + bottom * t.weight;
}

} // namespace

glm::vec4 sampleTexture(const Texture& texture, glm::vec2 coordinate) {
    const auto& table = srgbTable();
    return bilinear<glm::vec4>(texture, coordinate, [&](const uint8_t* rgba) {
        return glm::vec4(table[rgba[0]], table[rgba[1]], table[rgba[2]], float(rgba[3]) / 255.0f);
    });
}

float sampleOpacity(const Texture& texture, glm::vec2 coordinate) {
    return bilinear<float>(texture, coordinate, [](const uint8_t* rgba) { return float(rgba[3]) / 255.0f; });
}

glm::vec3 largestColor(const Texture& texture) {
    std::array<uint8_t, 3> largest{};
    for (size_t i = 0; i + 3 < texture.rgba.size(); i += 4)
        for (size_t c = 0; c < 3; ++c) largest[c] = std::max(largest[c], texture.rgba[i + c]);
    const auto& table = srgbTable();
    return {table[largest[0]], table[largest[1]], table[largest[2]]};
}

} // namespace rebound::lab
