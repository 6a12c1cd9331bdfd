// SPDX-License-Identifier: MIT
#include "lab/baking/bake_pictures.hpp"

#include "lab/baking/surfel_lookup.hpp"
#include "lab/light/low_discrepancy.hpp"
#include "lab/rays/camera_rays.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace rebound::lab {

namespace {

constexpr uint32_t noSurfel = 0xffffffffu;
constexpr glm::vec3 background(0.12f), unknown(0.5f);

// Bright colours that tell neighbours apart.
glm::vec3 colorOf(uint32_t number) {
    const uint32_t bits = hashBits(number, 1u);
    const auto part = [&](int shift) { return 0.25f + 0.75f * float((bits >> shift) & 255u) / 255.0f; };
    return {part(0), part(8), part(16)};
}

class BakeDrawing {
public:
    BakeDrawing(const Bake& b, const Frame& f)
        : bake(b), frame(f), rays(f.camera, f.depth.extent()), lookup(b), ranges(leafRanges(b)) {
        const Extent2D extent = frame.depth.extent();
        surfelOfPixel.assign(size_t(extent.width) * size_t(extent.height), noSurfel);
        for (int y = 0; y < extent.height; ++y)
            for (int x = 0; x < extent.width; ++x)
                if (*frame.depth.at(x, y) > 0.0f)
                    surfelOfPixel[index(x, y)] =
                        lookup.nearest(pointAt(x, y), vectorAt(frame.normal, x, y)).value_or(noSurfel);
    }

    Picture surfels() const {
        return drawn([this](int x, int y, uint32_t surfel) {
            const Surfel& s = lookup.all()[surfel];
            const float radius = std::sqrt(s.area / std::numbers::pi_v<float>);
            const float away = glm::length(pointAt(x, y) - s.position) / radius;
            const glm::vec3 color = 0.5f * (colorOf(surfel) + s.albedo);
            return away < 0.2f ? glm::vec3(1.0f) : away > 0.95f ? 0.3f * color : color;
        });
    }

    Picture patches(uint32_t count) const {
        const std::vector<uint32_t> patchOf = patchesOf(bake, ranges, count);
        return drawn([&](int, int, uint32_t surfel) { return colorOf(patchOf[surfel]); });
    }

    Picture caches() const {
        Image image = shaded(0.5f);
        const auto cells = bake.section(BakeSection::cells);
        for (size_t c = 0; c < bake.layout.cells; ++c)
            for (uint32_t corner = 0; corner < 8; ++corner) {
                const uint32_t packed = cells[c * 12 + 8], cache = cells[c * 12 + corner];
                const glm::uvec3 lattice = glm::uvec3(packed & 1023u, (packed >> 10) & 1023u, packed >> 20) +
                                           glm::uvec3(corner & 1u, (corner >> 1) & 1u, corner >> 2);
                const glm::vec3 usual = bake.layout.origin + bake.layout.spacing * glm::vec3(lattice);
                if (cache >= bake.layout.caches) {
                    drawBall(image, usual, {0.9f, 0.1f, 0.1f});
                    continue;
                }
                const glm::vec3 place = placeOf(cache);
                const bool moved = glm::length(place - usual) > 1e-3f * bake.layout.spacing;
                drawBall(image, place, moved ? glm::vec3(1.0f, 0.6f, 0.0f) : glm::vec3(0.2f, 0.9f, 0.3f));
            }
        return displayed(image);
    }

    Picture links() const {
        const uint32_t cache = middleCache();
        std::vector<float> share(bake.layout.surfels, 0.0f);
        float largest = 0.0f;
        for (uint32_t link = 0; link < bake.layout.links; ++link) {
            const size_t at = BakeLayout::ofCache(cache, link, bake.layout.links);
            const uint32_t node = bake.section(BakeSection::linkNodes)[at];
            if (node >= bake.layout.nodes) continue;
            const float factor = std::bit_cast<float>(bake.section(BakeSection::linkFactors)[at]);
            largest = std::max(largest, factor);
            for (uint32_t i = ranges[node].first; i <= ranges[node].last; ++i) share[i] = factor;
        }
        Image image = drawnImage([&](int, int, uint32_t surfel) {
            // From a thousandth of the largest factor on.
            const float shown = largest > 0.0f ? std::log10(share[surfel] / largest) / 3.0f + 1.0f : 0.0f;
            return glm::mix(glm::vec3(0.15f), glm::vec3(1.0f, 0.85f, 0.3f), std::clamp(shown, 0.0f, 1.0f));
        });
        drawBall(image, placeOf(cache), glm::vec3(0.2f, 0.6f, 1.0f));
        return displayed(image);
    }

    // Every other texel a little darker.
    Picture mapTexels(const Image& places) const {
        constexpr std::array<glm::vec3, 5> colors{{{0.2f, 0.8f, 0.3f},
                                                   {1.0f, 0.6f, 0.0f},
                                                   {0.2f, 0.5f, 1.0f},
                                                   {0.5f, 0.5f, 0.5f},
                                                   {0.0f, 0.0f, 0.0f}}};
        return drawn([&](int x, int y, uint32_t) {
            const float* place = places.at(x, y);
            if (!(place[0] >= 0.0f)) return glm::vec3(1.0f);
            const glm::uvec2 texel{uint32_t(place[0]), uint32_t(place[1])};
            const uint32_t number =
                bake.section(BakeSection::mapTexels)[size_t(texel.y) * bake.layout.mapSize.x + texel.x];
            const glm::vec3 color = colors[std::min<size_t>(number >> 24, colors.size() - 1)];
            return (texel.x + texel.y) % 2 == 0 ? color : 0.75f * color;
        });
    }

private:
    size_t index(int x, int y) const { return size_t(y) * size_t(frame.depth.width) + size_t(x); }

    static glm::vec3 vectorAt(const Image& image, int x, int y) {
        const float* v = image.at(x, y);
        return {v[0], v[1], v[2]};
    }

    glm::vec3 pointAt(int x, int y) const {
        const CameraRay ray = rays.throughPixel(x, y);
        return glm::vec3(ray.origin + double(*frame.depth.at(x, y)) * ray.direction);
    }

    glm::vec3 placeOf(uint32_t cache) const {
        const uint32_t* place = &bake.section(BakeSection::places)[size_t(cache) * 4];
        return {std::bit_cast<float>(place[0]), std::bit_cast<float>(place[1]),
                std::bit_cast<float>(place[2])};
    }

    uint32_t middleCache() const {
        const glm::vec3 middle = pointAt(frame.depth.width / 2, frame.depth.height / 2);
        uint32_t nearest = 0;
        for (uint32_t i = 1; i < bake.layout.gridCaches(); ++i)
            if (glm::length(placeOf(i) - middle) < glm::length(placeOf(nearest) - middle)) nearest = i;
        return nearest;
    }

    // The view in grey, by how much surfaces face it.
    Image shaded(float brightness) const {
        return drawnImage([&](int, int, uint32_t) { return glm::vec3(brightness); });
    }

    template <class Color>
    Image drawnImage(Color colorAt) const {
        const Extent2D extent = frame.depth.extent();
        Image image(extent, 3);
        for (int y = 0; y < extent.height; ++y)
            for (int x = 0; x < extent.width; ++x) {
                glm::vec3 color = background;
                if (*frame.depth.at(x, y) > 0.0f) {
                    const uint32_t surfel = surfelOfPixel[index(x, y)];
                    const glm::vec3 gaze = glm::normalize(glm::vec3(rays.throughPixel(x, y).direction));
                    const float facing = std::abs(glm::dot(gaze, vectorAt(frame.normal, x, y)));
                    color = (surfel == noSurfel ? unknown : glm::vec3(colorAt(x, y, surfel))) *
                            (0.4f + 0.6f * facing);
                }
                for (int c = 0; c < 3; ++c) image.at(x, y)[c] = color[c];
            }
        return image;
    }

    template <class Color>
    Picture drawn(Color colorAt) const {
        return displayed(drawnImage(colorAt));
    }

    // A ball of a twentieth of the grid's spacing, where nothing hides its centre.
    void drawBall(Image& image, glm::vec3 center, glm::vec3 color) const {
        const auto pixel = rays.pixelOf(glm::dvec3(center));
        const auto projected = rays.project(glm::dvec3(center));
        if (!pixel || !projected) return;
        const auto beside = rays.pixelOf(glm::dvec3(center) +
                                         glm::dvec3(frame.camera.up) * 0.05 * double(bake.layout.spacing));
        const int radius = beside ? int(std::clamp(glm::length(*beside - *pixel), 1.0, 40.0)) : 1;
        for (int dy = -radius; dy <= radius; ++dy)
            for (int dx = -radius; dx <= radius; ++dx) {
                const int x = int(pixel->x) + dx, y = int(pixel->y) + dy;
                if (dx * dx + dy * dy > radius * radius || x < 0 || y < 0 || x >= image.width ||
                    y >= image.height)
                    continue;
                const float depth = *frame.depth.at(x, y);
                if (depth > 0.0f && double(depth) < projected->depth) continue;
                const float light = 1.0f - 0.5f * float(dx * dx + dy * dy) / float(radius * radius + 1);
                for (int c = 0; c < 3; ++c) image.at(x, y)[c] = color[c] * light;
            }
    }

    static Picture displayed(const Image& image) {
        Picture picture{image.width, image.height, {}};
        for (const float value : image.data)
            picture.rgb.push_back(
                static_cast<unsigned char>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f))));
        return picture;
    }

    const Bake& bake;
    const Frame& frame;
    CameraRays rays;
    SurfelLookup lookup;
    std::vector<LeafRange> ranges;
    std::vector<uint32_t> surfelOfPixel;
};

} // namespace

std::vector<NamedPicture> picturesOf(const Bake& bake, const Frame& frame, const Image& mapPlaces) {
    const BakeDrawing drawing(bake, frame);
    std::vector<NamedPicture> pictures;
    pictures.push_back({"surfels", "surfels, by number and albedo", drawing.surfels()});
    for (const uint32_t count : {16u, 128u, 1024u})
        pictures.push_back({"patches_" + std::to_string(count),
                            std::to_string(count) + " patches of the tree", drawing.patches(count)});
    pictures.push_back({"caches", "caches: green, moved orange, none red", drawing.caches()});
    pictures.push_back({"links", "links of the blue cache, by factor", drawing.links()});
    if (!mapPlaces.empty())
        pictures.push_back(
            {"light_map",
             "texels: in their middle green, moved orange, of a seam blue, borrowed grey, dark "
             "black; grid's white",
             drawing.mapTexels(mapPlaces)});
    return pictures;
}

} // namespace rebound::lab
