// SPDX-License-Identifier: MIT
#include "link_cut.hpp"

#include "sequence.hpp"

#include "rebound/math/spherical_harmonics.hpp"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rebound::detail {

namespace {

// How much more readily a node is split of which nothing is seen but one ray's worth.
constexpr float hiddenWeight = 4.0f;
// Of rays in all directions, as many would have to meet a lamp's surfel, or all that emits together, to tell how large it looks.
constexpr double fewestRays = 4.0, fewestRaysOfAll = 64.0;
constexpr size_t mostLampRays = 256; // of a cache; of more lamps, every n-th stands for n

// Any rotation is as likely: neighbouring caches, of which receivers take a mean, do not err alike.
// Shoemake: Uniform Random Rotations, Graphics Gems III.
glm::mat3 rotationOf(uint32_t index) {
    const uint64_t bits = hash(index);
    constexpr double turn = 2.0 * std::numbers::pi;
    const double x = unit(bits), first = turn * unit(hash(bits)), second = turn * unit(hash(hash(bits)));
    const double r1 = std::sqrt(1.0 - x), r2 = std::sqrt(x);
    return glm::mat3(glm::mat3_cast(glm::dquat(r2 * std::cos(second), r1 * std::sin(first),
                                               r1 * std::cos(first), r2 * std::sin(second))));
}

std::vector<uint32_t> emittersOf(const SurfelTree& tree) {
    std::vector<uint32_t> leaves;
    for (uint32_t leaf = 0; leaf < tree.order.size(); ++leaf)
        if (tree.nodes[leaf].emission > 0.0f) leaves.push_back(leaf);
    return leaves;
}

} // namespace

LinkCutter::LinkCutter(const Surroundings& surroundings, const SurfelTree& surfelTree,
                       const SurfelLookup& surfelLookup, const BakeSettings& settings)
    : around(surroundings), tree(surfelTree), lookup(surfelLookup), emitters(emittersOf(surfelTree)),
      links(settings.links), evenDirections(sphereDirections(settings.links * settings.raysPerLink)) {}

const std::vector<SeenSender>& LinkCutter::cut(glm::vec3 cache, glm::vec3 normal, uint32_t index) {
    castRays(cache, normal, index);
    lookAtSurfels(cache);
    lookAtSmallLamps(cache);
    choosePieces();
    measure();
    return senders;
}

void LinkCutter::castRays(glm::vec3 cache, glm::vec3 surfaceNormal, uint32_t index) {
    const glm::mat3 rotation = rotationOf(index);
    rays.assign(evenDirections.size(), {});
    met.resize(rays.size());
    for (size_t i = 0; i < rays.size(); ++i) {
        rays[i].origin = cache;
        rays[i].direction = glm::normalize(rotation * evenDirections[i]);
        // Mirrored at the surface, those below it are between those above.
        if (const float below = glm::dot(rays[i].direction, surfaceNormal); below < 0.0f)
            rays[i].direction = glm::normalize(rays[i].direction - 2.0f * below * surfaceNormal);
    }
    around.rays.intersect(rays, met);
    hits.clear();
    const double sphereShare = surfaceNormal == glm::vec3(0.0f) ? 1.0 : 0.5;
    solidAngle = float(sphereShare * 4.0 * std::numbers::pi / double(rays.size()));
    for (uint32_t i = 0; i < rays.size(); ++i) {
        if (met[i].triangle == noTriangle) continue;
        glm::vec3 normal = around.normalOf(met[i].triangle);
        if (glm::dot(normal, rays[i].direction) > 0.0f) normal = -normal;
        const uint32_t leaf = lookup.nearest(cache + rays[i].direction * met[i].distance, normal);
        if (leaf != noLeaf) hits.push_back({leaf, i, rays[i].direction, solidAngle});
    }
}

LinkCutter::Piece LinkCutter::hitsOf(uint32_t number, const Piece& parent) const {
    const SurfelNode& node = tree.nodes[number];
    const auto before = [](const Hit& hit, uint32_t leaf) { return hit.leaf < leaf; };
    const auto end = hits.begin() + parent.last;
    const auto first = std::lower_bound(hits.begin() + parent.first, end, node.firstLeaf, before);
    const auto last = std::lower_bound(first, end, node.firstLeaf + node.leaves, before);
    return {number, uint32_t(first - hits.begin()), uint32_t(last - hits.begin()), 0.0f};
}

void LinkCutter::lookAtSurfels(glm::vec3 cache) {
    const size_t count = tree.order.size();
    facingArea.assign(count + 1, 0.0);
    openAngle.assign(count + 1, 0.0);
    for (size_t i = 0; i < count; ++i) {
        const SurfelNode& leaf = tree.nodes[i];
        const glm::vec3 towards = leaf.position - cache;
        const float distance2 = glm::dot(towards, towards), across = -glm::dot(towards, leaf.normal);
        facingArea[i + 1] = facingArea[i];
        openAngle[i + 1] = openAngle[i];
        if (across <= 0.0f) continue;
        facingArea[i + 1] += double(leaf.area);
        // Of a disc, bounded where the cache is near.
        const float disc = leaf.area * across / std::sqrt(distance2);
        openAngle[i + 1] += double(disc / (distance2 + disc * std::numbers::inv_pi_v<float>));
    }
}

// The solid angle from which what emits would light a cache as evenly as it does: (sum L w)^2 / sum L^2 w of surfels that send
// L from w [sr].
double LinkCutter::emittingAngle() const {
    double first = 0.0, second = 0.0;
    for (const uint32_t leaf : emitters) {
        const double open = openAngle[leaf + 1] - openAngle[leaf], sent = double(tree.nodes[leaf].emission);
        first += sent * open;
        second += sent * sent * open;
    }
    return second > 0.0 ? first * first / second : 0.0;
}

// Where few rays met most of what emits, its surfels are met by one each instead, but for those that look large.
void LinkCutter::lookAtSmallLamps(glm::vec3 cache) {
    lamps.clear();
    if (emittingAngle() < fewestRaysOfAll * double(solidAngle))
        for (const uint32_t leaf : emitters) {
            const double open = openAngle[leaf + 1] - openAngle[leaf];
            if (open > 0.0 && open < fewestRays * double(solidAngle)) lamps.push_back(leaf);
        }
    if (!lamps.empty()) {
        std::erase_if(
            hits, [&](const Hit& hit) { return std::binary_search(lamps.begin(), lamps.end(), hit.leaf); });
        const size_t step = (lamps.size() + mostLampRays - 1) / mostLampRays;
        rays.clear();
        for (size_t i = step / 2; i < lamps.size(); i += step) {
            const SurfelNode& lamp = tree.nodes[lamps[i]];
            const glm::vec3 towards = lamp.position + lamp.normal * around.clearance - cache;
            const float distance = glm::length(towards);
            rays.push_back({cache, 0.0f, towards / distance, distance});
        }
        hidden.resize(rays.size());
        around.rays.occluded(rays, hidden);
        for (size_t i = 0; i < rays.size(); ++i) {
            const uint32_t leaf = lamps[step / 2 + i * step];
            const double open = double(step) * (openAngle[leaf + 1] - openAngle[leaf]);
            if (!hidden[i])
                hits.push_back({leaf, uint32_t(evenDirections.size() + i), rays[i].direction, float(open)});
        }
    }
    std::sort(hits.begin(), hits.end(),
              [](const Hit& a, const Hit& b) { return a.leaf != b.leaf ? a.leaf < b.leaf : a.ray < b.ray; });
    angleSeen.assign(1, 0.0);
    for (const Hit& hit : hits) angleSeen.push_back(angleSeen.back() + double(hit.solidAngle));
}

double LinkCutter::seenAngle(const Piece& piece) const {
    return angleSeen[piece.last] - angleSeen[piece.first];
}

// Of a node's area, what the cache does not see: it faces away, or something is before it.
float LinkCutter::hiddenShare(const Piece& piece) const {
    const SurfelNode& node = tree.nodes[piece.node];
    const size_t first = node.firstLeaf, last = first + node.leaves;
    const double facing = (facingArea[last] - facingArea[first]) / double(node.area);
    const double open = openAngle[last] - openAngle[first];
    return 1.0f - float(std::min(facing, 1.0) * std::min(seenAngle(piece) / std::max(open, 1e-30), 1.0));
}

// Down to where both children are seen: so much of what is hidden, behind a wall perhaps, is left out at no cost.
LinkCutter::Piece LinkCutter::narrow(Piece piece) const {
    while (!tree.nodes[piece.node].isLeaf()) {
        const auto& children = tree.nodes[piece.node].children;
        const Piece a = hitsOf(children[0], piece), b = hitsOf(children[1], piece);
        if (a.isSeen() && b.isSeen()) break;
        piece = a.isSeen() ? a : b;
    }
    return piece;
}

// The one that looks largest is split, until there are as many as wanted; those before others of which a cache sees a part
// alone, as it would take the light of all for that of the part.
void LinkCutter::choosePieces() {
    const auto smaller = [](const Piece& a, const Piece& b) {
        return a.priority != b.priority ? a.priority < b.priority : a.node < b.node;
    };
    const auto ranked = [&](Piece piece) {
        piece = narrow(piece);
        piece.priority = float(seenAngle(piece)) * (1.0f + hiddenWeight * hiddenShare(piece));
        return piece;
    };
    pieces.clear();
    if (hits.empty()) return;
    std::vector<Piece> leaves;
    pieces.push_back(ranked({tree.root(), 0, uint32_t(hits.size()), 0.0f}));
    while (!pieces.empty() && pieces.size() + leaves.size() < links) {
        std::pop_heap(pieces.begin(), pieces.end(), smaller);
        const Piece largest = pieces.back();
        pieces.pop_back();
        if (tree.nodes[largest.node].isLeaf()) {
            leaves.push_back(largest);
            continue;
        }
        for (const uint32_t child : tree.nodes[largest.node].children) {
            pieces.push_back(ranked(hitsOf(child, largest)));
            std::push_heap(pieces.begin(), pieces.end(), smaller);
        }
    }
    pieces.insert(pieces.end(), leaves.begin(), leaves.end());
    std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.node < b.node; });
}

void LinkCutter::measure() {
    senders.assign(pieces.size(), {});
    for (size_t p = 0; p < pieces.size(); ++p) {
        senders[p].node = pieces[p].node;
        for (uint32_t h = pieces[p].first; h < pieces[p].last; ++h) {
            const host::Harmonics y = host::sphericalHarmonics(hits[h].direction);
            for (size_t i = 0; i < senders[p].coefficients.size(); ++i)
                senders[p].coefficients[i] += hits[h].solidAngle * y.value[i];
        }
    }
}

} // namespace rebound::detail
