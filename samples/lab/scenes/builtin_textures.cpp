// SPDX-License-Identifier: MIT
#include "lab/scenes/builtin_textures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

namespace rebound::lab {
namespace {

constexpr int side = 512; // [texels]

// A fixed number from 0 to 1 for each lattice point.
float hash(int x, int y, int seed) {
    uint32_t h = static_cast<uint32_t>(x) * 0x8da6b343u ^ static_cast<uint32_t>(y) * 0xd8163841u ^
                 static_cast<uint32_t>(seed) * 0xcb1ab31fu;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return static_cast<float>((h ^ (h >> 16)) >> 8) / 16777216.0f;
}

// Value noise over [0, 1)^2 with `cells` lattice cells a side, seamless.
float noise(const glm::vec2& at, int cells, int seed) {
    const glm::vec2 p = at * static_cast<float>(cells);
    const glm::vec2 cell = glm::floor(p);
    const glm::vec2 f = glm::smoothstep(glm::vec2(0.0f), glm::vec2(1.0f), p - cell);
    const int x = static_cast<int>(cell.x), y = static_cast<int>(cell.y);
    const auto value = [&](int i, int j) { return hash((x + i) % cells, (y + j) % cells, seed); };
    return glm::mix(glm::mix(value(0, 0), value(1, 0), f.x), glm::mix(value(0, 1), value(1, 1), f.x), f.y);
}

// Five octaves, from 0 to 1.
float clouds(const glm::vec2& at, int cells, int seed) {
    float sum = 0.0f, weight = 0.5f;
    for (int octave = 0; octave < 5; ++octave, weight *= 0.5f)
        sum += weight * noise(at, cells << octave, seed + octave);
    return sum;
}

uint8_t toSrgb(float linear) {
    const float l = std::clamp(linear, 0.0f, 1.0f);
    const float encoded = l <= 0.0031308f ? 12.92f * l : 1.055f * std::pow(l, 1.0f / 2.4f) - 0.055f;
    return static_cast<uint8_t>(encoded * 255.0f + 0.5f);
}

Texture makeTexture(const std::string& name, const std::function<glm::vec3(const glm::vec2&)>& reflectance) {
    Texture texture;
    texture.name = name;
    texture.width = texture.height = side;
    texture.rgba.reserve(size_t(side) * side * 4);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const glm::vec3 c = reflectance((glm::vec2(x, y) + 0.5f) / static_cast<float>(side));
            texture.rgba.insert(texture.rgba.end(), {toSrgb(c.x), toSrgb(c.y), toSrgb(c.z), 255});
        }
    return texture;
}

glm::vec3 shade(const Stone& stone, float brightness) {
    return glm::mix(stone.dark, stone.light, std::clamp(brightness, 0.0f, 1.0f));
}

// 0 in a joint of this half width at a cell's border, 1 inside.
float inside(const glm::vec2& inCell, const glm::vec2& halfJoint) {
    const glm::vec2 border = glm::min(inCell, 1.0f - inCell);
    const glm::vec2 edge = glm::smoothstep(halfJoint * 0.6f, halfJoint * 1.4f, border);
    return edge.x * edge.y;
}

} // namespace

Texture makeStoneTexture(const std::string& name, const Stone& stone) {
    return makeTexture(name,
                       [&](const glm::vec2& at) { return shade(stone, 1.6f * clouds(at, 4, 1) - 0.3f); });
}

Texture makeMasonryTexture(const std::string& name, const Stone& stone, const glm::vec3& mortar) {
    return makeTexture(name, [&](const glm::vec2& at) {
        const int course = static_cast<int>(at.y * 4.0f);
        const float along = at.x * 2.0f + (course % 2 == 0 ? 0.0f : 0.5f);
        const int block = static_cast<int>(along) % 2;
        const glm::vec2 inCell(along - std::floor(along), at.y * 4.0f - static_cast<float>(course));
        const float own = hash(block, course, 7);
        const glm::vec3 face = shade(stone, 0.55f * own + 0.9f * clouds(at, 8, 11) - 0.2f);
        return glm::mix(mortar, face, inside(inCell, {0.012f, 0.024f}));
    });
}

Texture makeTileTexture(const std::string& name, const Stone& even, const Stone& odd,
                        const glm::vec3& joint) {
    return makeTexture(name, [&](const glm::vec2& at) {
        const glm::vec2 tile = glm::floor(at * 4.0f);
        const int x = static_cast<int>(tile.x), y = static_cast<int>(tile.y);
        const float own = hash(x, y, 23);
        const glm::vec3 face =
            shade((x + y) % 2 == 0 ? even : odd, 0.5f * own + 0.9f * clouds(at, 8, 31) - 0.15f);
        return glm::mix(joint, face, inside(at * 4.0f - tile, glm::vec2(0.012f)));
    });
}

Texture makePlankTexture(const std::string& name, const Stone& wood, const glm::vec3& joint) {
    return makeTexture(name, [&](const glm::vec2& at) {
        const int board = static_cast<int>(at.y * 6.0f);
        const float own = hash(board, 3, 41);
        const float grain = clouds({at.x, at.y * 16.0f - std::floor(at.y * 16.0f)}, 4, 43 + board);
        const float fine = noise({at.x, at.y}, 96, 47);
        const glm::vec3 face = shade(wood, 0.5f * own + 0.7f * grain + 0.15f * fine - 0.15f);
        const glm::vec2 inBoard(at.x, at.y * 6.0f - static_cast<float>(board));
        return glm::mix(joint, face, inside(inBoard, {0.002f, 0.02f}));
    });
}

Texture makeCarpetTexture(const std::string& name, const glm::vec3& ground, const glm::vec3& figure,
                          const glm::vec3& border) {
    return makeTexture(name, [&](const glm::vec2& at) {
        const glm::vec2 edge = glm::min(at, 1.0f - at);
        const float thread = 0.85f + 0.15f * noise(at, 128, 53);
        const float nearest = std::min(edge.x, edge.y);
        if (nearest < 0.1f && nearest > 0.03f) return border * thread;
        const glm::vec2 cell = glm::abs(glm::fract(at * 6.0f) - 0.5f);
        const float lozenge = cell.x + cell.y;
        const bool isFigure = (lozenge < 0.42f && lozenge > 0.28f) || lozenge < 0.12f;
        return (isFigure && nearest > 0.1f ? figure : ground) * thread;
    });
}

Texture makeStripeTexture(const std::string& name, const glm::vec3& even, const glm::vec3& odd) {
    return makeTexture(
        name, [&](const glm::vec2& at) { return static_cast<int>(at.x * 8.0f) % 2 == 0 ? even : odd; });
}

} // namespace rebound::lab
