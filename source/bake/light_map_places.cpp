// SPDX-License-Identifier: MIT
#include "light_map_places.hpp"

#include "sequence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>

namespace rebound::detail {

namespace {

constexpr uint32_t raysOfPlace = 48;
constexpr size_t sidesLookedAt = 8;
// Of what is seen. Inside of a closed object it is all; from a floor the odd back face of an open mesh.
constexpr float mostInnerSides = 0.25f;
// A rock that has no bottom is closed by the ground, whose front its inside sees: it is told by backs alone.
constexpr float mostBacks = 0.75f;
// Of caches before the surface: more than facets of a curved surface stand out, less than what stands on it. [texels]
constexpr float lift = 0.02f;
// How far a surface may rise or fall beside a texel to be the same one that goes on. [texels]
constexpr float furthestStep = 0.75f;
// Of texels of a chart whose seams are worth caches of their own: small ones would be more seams than chart.
constexpr size_t fewestOfSeams = 4;
constexpr float leastSeamCosine = 0.6f; // between normals of such
constexpr float sightLift = 0.15f; // of the line of sight from one to the other, off bulges between [texels]
// Tried one after the other where a texel's middle is no good. [texels]
constexpr std::array<std::array<float, 2>, 12> otherPlaces{{{0.25f, 0},
                                                            {-0.25f, 0},
                                                            {0, 0.25f},
                                                            {0, -0.25f},
                                                            {0.25f, 0.25f},
                                                            {-0.25f, -0.25f},
                                                            {0.25f, -0.25f},
                                                            {-0.25f, 0.25f},
                                                            {0.45f, 0},
                                                            {-0.45f, 0},
                                                            {0, 0.45f},
                                                            {0, -0.45f}}};

enum class View { lit, dark, inside };

struct Look {
    View view = View::dark;
    bool isEnclosed = false; // by backs
};

class SidePlacer {
public:
    SidePlacer(const Surroundings& surroundings, const Chart& c, const ChartTexels& t, bool isFront,
               const MapRemedies& r)
        : around(surroundings), chart(c), chartTexels(t), front(isFront), remedies(r),
          texel(float(c.frame.texel)) {}

    ChartSide place() {
        const size_t count = size_t(chartTexels.size.x) * size_t(chartTexels.size.y);
        side.texels.assign(count, {});
        found.assign(count, std::nullopt);
        views.assign(count, View::inside);
        placeHeld();
        if (std::none_of(views.begin(), views.end(), [](View v) { return v == View::lit; })) {
            side.texels.assign(count, {});
            return std::move(side);
        }
        darken();
        if (remedies.seams && chartTexels.held.size() >= fewestOfSeams) placeSeams();
        numberCaches();
        lend();
        return std::move(side);
    }

private:
    size_t index(glm::ivec2 at) const { return size_t(at.y) * size_t(chartTexels.size.x) + size_t(at.x); }
    bool isTexel(glm::ivec2 at) const {
        return at.x >= 0 && at.y >= 0 && at.x < chartTexels.size.x && at.y < chartTexels.size.y;
    }
    glm::vec3 normalOf(const TexelPlace& held) const { return front ? held.normal : -held.normal; }
    SurfacePlace before(glm::vec3 position, glm::vec3 normal) const {
        return {position + normal * std::max(around.clearance, lift * texel), normal};
    }

    // Behind what has backs alone is no room, but where most of a chart is, it is right there: behind a curtain.
    void placeHeld() {
        std::vector<Look> looks;
        size_t enclosed = 0;
        for (const TexelPlace& held : chartTexels.held) {
            looks.push_back(look(before(held.position, normalOf(held))));
            enclosed += looks.back().isEnclosed;
        }
        enclosedIsInside = 2 * enclosed <= looks.size();
        for (size_t i = 0; i < looks.size(); ++i) keepOrMend(chartTexels.held[i], looks[i]);
    }

    void keepOrMend(const TexelPlace& held, const Look& seen) {
        const glm::vec3 normal = normalOf(held);
        const size_t at = index(held.at);
        SurfacePlace place = before(held.position, normal);
        View view = viewOf(seen);
        side.texels[at].state = TexelState::own;
        if (view == View::inside && remedies.mend) {
            const auto other = placeElsewhere(held, normal);
            if (!other) return;
            place = other->first;
            view = other->second;
            side.texels[at].state = TexelState::moved;
        }
        if (view == View::inside) view = View::lit; // as it stands: what a test asked for
        found[at] = place;
        views[at] = view;
    }

    std::optional<std::pair<SurfacePlace, View>> placeElsewhere(const TexelPlace& held, glm::vec3 normal) {
        for (const auto& offset : otherPlaces) {
            const glm::vec3 wanted = held.position + texel * (offset[0] * glm::vec3(chart.frame.right) +
                                                              offset[1] * glm::vec3(chart.frame.up));
            const auto place = surfaceNear(wanted, normal);
            if (!place) continue;
            if (const View view = viewOf(look(*place)); view != View::inside) return std::pair{*place, view};
        }
        return std::nullopt;
    }

    // Of the same side, above or below a place beside.
    std::optional<SurfacePlace> surfaceNear(glm::vec3 wanted, glm::vec3 normal) const {
        const float reach = furthestStep * texel;
        const BakeRay ray{wanted + normal * reach, 0.0f, -normal, 2.0f * reach};
        BakeHit hit;
        around.rays.intersect({&ray, 1}, {&hit, 1});
        if (hit.triangle == noTriangle) return std::nullopt;
        const glm::vec3 met = around.normalOf(hit.triangle) * (front ? 1.0f : -1.0f);
        if (glm::dot(met, normal) < leastSeamCosine) return std::nullopt;
        return before(ray.origin + ray.direction * hit.distance, met);
    }

    View viewOf(const Look& seen) const {
        return seen.view == View::lit && seen.isEnclosed && enclosedIsInside ? View::inside : seen.view;
    }

    Look look(const SurfacePlace& place) {
        rays.resize(raysOfPlace);
        hits.resize(raysOfPlace);
        for (uint32_t i = 0; i < raysOfPlace; ++i)
            rays[i] = {place.position, 0.0f,
                       cosineDirection(place.normal, {halton(i + 1, 2), halton(i + 1, 3)}),
                       std::numeric_limits<float>::infinity()};
        around.rays.intersect(rays, hits);
        backs.clear();
        size_t met = 0;
        for (size_t i = 0; i < raysOfPlace; ++i) {
            if (hits[i].triangle == noTriangle) continue;
            ++met;
            const glm::vec3 normal = around.normalOf(hits[i].triangle);
            if (glm::dot(normal, rays[i].direction) > 0.0f)
                backs.push_back({rays[i].origin + rays[i].direction * hits[i].distance, -normal});
        }
        const double inner = innerSides();
        Look seen;
        seen.isEnclosed = float(backs.size()) > mostBacks * float(met);
        if (inner > double(mostInnerSides) * double(met)) seen.view = View::inside;
        else seen.view = double(met) - inner > 0.0 ? View::lit : View::dark;
        return seen;
    }

    // Of the back sides that are seen, how many are no right ones to see; a curtain's are right.
    double innerSides() {
        if (backs.empty()) return 0.0;
        const size_t count = std::min(backs.size(), sidesLookedAt);
        chosen.clear();
        for (size_t i = 0; i < count; ++i) chosen.push_back(backs[i * backs.size() / count]);
        return double(countInnerSides(around, chosen)) / double(count) * double(backs.size());
    }

    template <class Body>
    void forNeighbours(glm::ivec2 at, const Body& body) const {
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                if ((x != 0 || y != 0) && isTexel(at + glm::ivec2(x, y))) body(at + glm::ivec2(x, y));
    }

    // What few rays have not met may be there all the same: only a place among its like is dark.
    void darken() {
        std::vector<size_t> dark;
        for (const TexelPlace& held : chartTexels.held) {
            if (views[index(held.at)] != View::dark) continue;
            bool isAlone = false;
            forNeighbours(held.at, [&](glm::ivec2 n) { isAlone = isAlone || views[index(n)] == View::lit; });
            if (!isAlone) dark.push_back(index(held.at));
        }
        for (const size_t i : dark) {
            found[i].reset();
            side.texels[i].state = TexelState::dark;
        }
        isDark.assign(found.size(), 0);
        for (const size_t i : dark) isDark[i] = 1;
    }

    // Beside texels that hold a piece of the chart, others may hold one of the surface that goes on: of a curved surface, or
    // of a floor in several meshes. Both charts then read the same light at their seam.
    void placeSeams() {
        std::vector<uint8_t> holds(found.size());
        for (const TexelPlace& held : chartTexels.held) holds[index(held.at)] = 1;
        std::vector<std::pair<size_t, SurfacePlace>> seams;
        for (int y = 0; y < chartTexels.size.y; ++y)
            for (int x = 0; x < chartTexels.size.x; ++x) {
                if (holds[index({x, y})]) continue;
                if (const auto place = placeBeyond({x, y})) seams.push_back({index({x, y}), *place});
            }
        for (const auto& [i, place] : seams) {
            found[i] = place;
            side.texels[i].state = TexelState::seam;
        }
    }

    std::optional<SurfacePlace> placeBeyond(glm::ivec2 at) {
        std::optional<SurfacePlace> result;
        // Those beside before those across a corner.
        for (const bool across : {false, true})
            forNeighbours(at, [&](glm::ivec2 neighbour) {
                const glm::ivec2 off = at - neighbour;
                if (result || (off.x != 0 && off.y != 0) != across) return;
                const size_t i = index(neighbour);
                if (!found[i] || side.texels[i].state != TexelState::own) return;
                result = continued(*found[i], at);
            });
        return result;
    }

    // From a cache to the middle of a texel beside, along the tangent plane.
    std::optional<SurfacePlace> continued(const SurfacePlace& from, glm::ivec2 at) {
        const ChartFrame& frame = chart.frame;
        const glm::dvec2 wanted = chartTexels.origin + glm::dvec2(at) + 0.5;
        const glm::dvec3 position(from.position), normal(from.normal);
        const glm::dvec2 off = (wanted - frame.flat(position)) * frame.texel;
        glm::dvec3 step = frame.right * off.x + frame.up * off.y;
        const double slope = glm::dot(frame.normal, normal);
        step -= frame.normal * (glm::dot(step, normal) / slope);
        const auto place = surfaceNear(glm::vec3(position + step), from.normal);
        if (!place || viewOf(look(*place)) != View::lit) return std::nullopt;
        const float rise = sightLift * texel;
        const glm::vec3 start = from.position + from.normal * rise,
                        end = place->position + place->normal * rise;
        const float distance = glm::distance(start, end);
        const BakeRay sight{start, 0.0f, (end - start) / std::max(distance, 1e-20f), distance};
        uint8_t hidden = 0;
        around.rays.occluded({&sight, 1}, {&hidden, 1});
        if (hidden) return std::nullopt;
        return place;
    }

    void numberCaches() {
        for (size_t i = 0; i < found.size(); ++i) {
            if (!found[i]) continue;
            side.texels[i].cache = uint32_t(side.caches.size());
            side.caches.push_back(*found[i]);
        }
    }

    // To texels without a cache, from the nearest that have one or are rightly dark.
    void lend() {
        std::deque<glm::ivec2> waiting;
        std::vector<uint8_t> done(found.size());
        for (int y = 0; y < chartTexels.size.y; ++y)
            for (int x = 0; x < chartTexels.size.x; ++x)
                if (const size_t i = index({x, y}); found[i] || isDark[i]) {
                    done[i] = 1;
                    waiting.push_back({x, y});
                }
        constexpr std::array<std::array<int, 2>, 8> steps{
            {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
        while (!waiting.empty()) {
            const glm::ivec2 from = waiting.front();
            waiting.pop_front();
            for (const auto& step : steps) {
                const glm::ivec2 to = from + glm::ivec2(step[0], step[1]);
                if (!isTexel(to) || done[index(to)]) continue;
                done[index(to)] = 1;
                MapTexel& texelThere = side.texels[index(to)];
                texelThere = side.texels[index(from)];
                if (texelThere.state != TexelState::dark) texelThere.state = TexelState::borrowed;
                waiting.push_back(to);
            }
        }
    }

    const Surroundings& around;
    const Chart& chart;
    const ChartTexels& chartTexels;
    const bool front;
    const MapRemedies& remedies;
    const float texel; // [m]
    ChartSide side;
    std::vector<std::optional<SurfacePlace>> found; // by texel
    std::vector<View> views;                        // by texel; inside where nothing is
    std::vector<uint8_t> isDark;
    bool enclosedIsInside = true;
    std::vector<BakeRay> rays;
    std::vector<BakeHit> hits;
    std::vector<SurfaceSide> backs, chosen;
};

} // namespace

ChartSide placeOnSide(const Surroundings& around, const Chart& chart, const ChartTexels& texels, bool front,
                      const MapRemedies& remedies) {
    return SidePlacer(around, chart, texels, front, remedies).place();
}

} // namespace rebound::detail
