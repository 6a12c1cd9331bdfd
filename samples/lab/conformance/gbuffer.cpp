// SPDX-License-Identifier: MIT
#include "lab/conformance/gbuffer.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <limits>

namespace rebound::conformance {
namespace {

// In a right-handed view space.
struct Patch {
    glm::dvec2 site; // 0 to 1 on the screen: pixels belong to the nearest
    glm::dvec3 point, normal;
    glm::dvec3 radiance;
    bool sky;
};

struct View {
    lab::Lens lens;
    bool perspective;
    double scale;

    glm::dvec2 plane(glm::dvec2 screen) const {
        return {(2.0 * screen.x - 1.0 - lens.shiftX) * lens.halfWidth,
                (1.0 - 2.0 * screen.y - lens.shiftY) * lens.halfHeight};
    }
    // Distance along the viewing axis at which the ray through a point of the screen meets a patch's plane.
    double meet(glm::dvec2 screen, const Patch& patch) const {
        const glm::dvec2 at = plane(screen);
        const glm::dvec3 origin = perspective ? glm::dvec3(0.0) : glm::dvec3(at, 0.0);
        const glm::dvec3 ray = perspective ? glm::dvec3(at, -1.0) : glm::dvec3(0.0, 0.0, -1.0);
        return glm::dot(patch.normal, patch.point - origin) / glm::dot(patch.normal, ray);
    }
};

glm::dvec3 unitVector(Random& random) {
    const double z = random.between(-1.0, 1.0), phi = random.between(0.0, 6.283185307179586);
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {r * std::cos(phi), r * std::sin(phi), z};
}

Patch makePatch(const View& view, const GBufferOptions& options, Random& random) {
    Patch patch;
    patch.site = {random.unit(), random.unit()};
    const glm::dvec2 at = view.plane(patch.site);
    const double distance = random.between(1.0, 20.0) * view.scale;
    const glm::dvec3 toEye =
        view.perspective ? -glm::normalize(glm::dvec3(at, -1.0)) : glm::dvec3(0.0, 0.0, 1.0);
    patch.point = view.perspective ? glm::dvec3(at, -1.0) * distance : glm::dvec3(at, -distance);
    patch.normal = unitVector(random);
    if (glm::dot(patch.normal, toEye) < 0.0) patch.normal = -patch.normal;
    if (options.grazing) // 0.1 to 3 degrees to the rays
        patch.normal = glm::normalize(patch.normal - glm::dot(patch.normal, toEye) * toEye +
                                      random.betweenDecades(0.002, 0.05) * toEye);
    for (int c = 0; c < 3; ++c)
        patch.radiance[c] = std::pow(10.0, random.between(-options.radianceDecades, options.radianceDecades));
    patch.sky = random.chance(options.skyShare);
    return patch;
}

// Two walls and a floor that meet before the eye, wherever the planes of a view lie.
std::vector<Patch> makeCorner(const View& view) {
    std::vector<Patch> walls;
    for (const glm::dvec3 normal :
         {glm::dvec3(0.8, 0.0, 0.6), glm::dvec3(-0.6, 0.0, 0.8), glm::dvec3(0.0, 0.8, 0.6)})
        walls.push_back({{}, glm::dvec3(0.0, -0.1, -4.0) * view.scale, normal, glm::dvec3(1e3), false});
    return walls;
}

const Patch& nearestWall(const View& view, const std::vector<Patch>& walls, glm::dvec2 screen) {
    const auto distance = [&](const Patch& wall) {
        const double d = view.meet(screen, wall);
        return d > 0.0 ? d : std::numeric_limits<double>::infinity();
    };
    return *std::min_element(walls.begin(), walls.end(),
                             [&](const Patch& a, const Patch& b) { return distance(a) < distance(b); });
}

const Patch& nearestPatch(const std::vector<Patch>& patches, glm::dvec2 screen) {
    return *std::min_element(patches.begin(), patches.end(), [&](const Patch& a, const Patch& b) {
        return glm::distance(a.site, screen) < glm::distance(b.site, screen);
    });
}

void store(lab::Image& image, int x, int y, glm::dvec3 value) {
    for (int c = 0; c < 3; ++c) image.at(x, y)[c] = float(value[c]);
}

View viewOf(const GBufferConventions& c, double scale) {
    View view{{}, c.projection == Projection::perspective, scale};
    view.lens.nearDistance *= scale;
    view.lens.farDistance *= scale;
    if (!view.perspective) {
        view.lens.halfWidth *= 10.0 * scale;
        view.lens.halfHeight *= 10.0 * scale;
    }
    view.lens.flipY = c.firstRow == FirstRow::bottom; // the same picture in memory
    return view;
}

float emptyDepth(const GBufferConventions& c) {
    return c.depthEncoding == DepthEncoding::device && c.depthDirection == DepthDirection::forward ? 1.0f
                                                                                                   : 0.0f;
}

} // namespace

GBuffer makeGBuffer(const ScreenIndirectSettings& settings, const GBufferOptions& options, Random& random) {
    const GBufferConventions& c = settings.conventions;
    const Extent2D extent = settings.resolution;
    View view = viewOf(c, options.scale);
    view.lens.farDistance *= options.farRatio;
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), random.between(0.0, 6.0), unitVector(random));
    ScreenIndirectFrame<lab::Image> g;
    g.depth = lab::Image(extent, 1, emptyDepth(c));
    g.normal = g.radiance = g.albedo = g.lit = lab::Image(extent, 3);
    g.camera = {lab::viewOf(c, glm::mat4(turn)), lab::projectionOf(c, view.lens)};
    const glm::dmat3 toWorld = glm::inverse(glm::dmat3(turn));
    std::vector<Patch> patches;
    for (int i = 0; i < options.patches; ++i) {
        patches.push_back(makePatch(view, options, random));
        if (i % 2 == 1) patches.back().point *= options.farRatio;
    }
    if (options.corner) patches = makeCorner(view);
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            store(g.albedo, x, y, {random.unit(), random.unit(), random.unit()});
            store(g.lit, x, y, glm::dvec3(random.betweenDecades(1e-3, 1e2)));
            const glm::dvec2 screen((x + 0.5) / extent.width, (y + 0.5) / extent.height);
            const Patch& patch =
                options.corner ? nearestWall(view, patches, screen) : nearestPatch(patches, screen);
            const double distance = view.meet(screen, patch);
            if (patch.sky || !(distance > view.lens.nearDistance && distance < view.lens.farDistance))
                continue;
            g.depth.at(x, y)[0] = lab::storedDepth(c, view.lens, distance);
            store(g.normal, x, y, lab::storedNormal(c, g.camera.view, glm::vec3(toWorld * patch.normal)));
            store(g.radiance, x, y, patch.radiance * random.between(0.5, 1.5));
        }
    return {settings, std::move(g)};
}

Result<Case> caseOf(const GBuffer& g, runner::Precision precision) {
    auto inputs = screenIndirectInputs(g.settings, g.frame);
    if (!inputs) return inputs.error();
    auto plan = planScreenIndirect(g.settings);
    if (!plan) return plan.error();
    float largestRadiance = 0;
    for (float value : g.frame.radiance.data)
        if (std::isfinite(value)) largestRadiance = std::max(largestRadiance, value);
    auto tolerances = techniqueTolerances(*plan, largestRadiance);
    return Case{*std::move(plan), *std::move(inputs), precision, std::move(tolerances)};
}

} // namespace rebound::conformance
