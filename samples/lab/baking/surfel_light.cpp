// SPDX-License-Identifier: MIT
#include "lab/baking/surfel_light.hpp"

#include "lab/light/direct_light.hpp"
#include "lab/light/low_discrepancy.hpp"
#include "lab/light/sampling.hpp"
#include "lab/rays/parallel_rows.hpp"
#include "rebound/bake/read_surfel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rebound::lab {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr uint32_t surfelsARow = 256; // of the loop over threads

// A point of a disc, the square's areas kept.
glm::vec2 discPoint(glm::vec2 square, float radius) {
    const float r = radius * std::sqrt(square.x), angle = 2.0f * pi * square.y;
    return {r * std::cos(angle), r * std::sin(angle)};
}

class SurfelLighting {
public:
    SurfelLighting(const Bake& b, const EmbreeScene& s, const SurfelLightOptions& o)
        : bake(b), scene(s), options(o), light(s, o.samples) {}

    glm::vec3 lightOn(uint32_t index) const {
        const Surfel surfel = surfelOf(bake, index);
        glm::vec3 sum(0.0f);
        int found = 0;
        for (int i = 0; i < options.places; ++i) {
            const auto place = placeOn(surfel, sobolPoint(uint32_t(i), index));
            if (!place) continue;
            sum += light.irradiance(*place, hashBits(index, uint32_t(i)));
            ++found;
        }
        return found ? sum / (pi * float(found)) : glm::vec3(0.0f);
    }

private:
    // The scene's surface at a point of the disc, which may stick out of it; nothing where none is near.
    std::optional<SurfacePoint> placeOn(const Surfel& surfel, glm::vec2 square) const {
        const float radius = std::sqrt(surfel.area / pi);
        const glm::vec2 offset = discPoint(square, radius);
        const glm::vec3 point =
            surfel.position + fromTangentSpace(surfel.normal, glm::vec3(offset.x, offset.y, 0.0f));
        // From above, down to as far below: a curved surface leaves its disc by less than the disc is wide.
        for (const float height : {0.1f, 1.0f}) {
            const Ray ray{point + surfel.normal * (height * radius), -surfel.normal, 0.0f,
                          2.0f * height * radius};
            const auto hit = scene.intersect(ray);
            if (hit && glm::dot(hit->point.shadingNormal, surfel.normal) > 0.5f) return hit->point;
        }
        return {};
    }

    const Bake& bake;
    const EmbreeScene& scene;
    const SurfelLightOptions& options;
    DirectLight light;
};

} // namespace

std::vector<float> directLightOnSurfels(const Bake& bake, const EmbreeScene& scene,
                                        const SurfelLightOptions& options) {
    const uint32_t count = bake.layout.surfels, stride = BakeLayout::stride(count);
    std::vector<float> planes(size_t(stride) * 3, 0.0f);
    const SurfelLighting lighting(bake, scene, options);
    parallelRows(int((count + surfelsARow - 1) / surfelsARow), options.threads, {}, [&](int row) {
        const uint32_t first = uint32_t(row) * surfelsARow, end = std::min(count, first + surfelsARow);
        for (uint32_t i = first; i < end; ++i) {
            const glm::vec3 value = lighting.lightOn(i);
            for (int c = 0; c < 3; ++c) planes[size_t(c) * stride + i] = value[c];
        }
    });
    return planes;
}

} // namespace rebound::lab
