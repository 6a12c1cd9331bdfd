// SPDX-License-Identifier: MIT
// The senders that one cache sees, as so many nodes of the tree.   [PIC, sec. 4.5]
#pragma once

#include "facing.hpp"
#include "surfel_lookup.hpp"

#include "rebound/bake/bake_scene.hpp"
#include "rebound/bake/hierarchy.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace rebound::detail {

// What a cache sees of a sender: the integral of y_i over the directions in which it does.
struct SeenSender {
    uint32_t node = 0;
    std::array<float, 16> coefficients{};
};

// Rays from the cache in all directions tell which surfels it sees, and how large. The paper sends N' rays to points of each
// sender instead; as many in all directions are N' a link as well, and each counts for exactly one sender: the whole sphere
// is accounted for, however near a sender is, and whatever hides how much of it. Lamps too small for these rays, which may
// be all the light of a scene, get rays of their own.
class LinkCutter {
public:
    LinkCutter(const Surroundings&, const SurfelTree&, const SurfelLookup&, const BakeSettings&);

    // At most settings.links, by ascending node. index: of the cache, which turns its rays.
    // normal: of the surface that it lies on, before which alone it sees anything; 0: it sees all around.
    const std::vector<SeenSender>& cut(glm::vec3 cache, glm::vec3 normal, uint32_t index);

private:
    struct Hit {
        uint32_t leaf, ray;
        glm::vec3 direction;
        float solidAngle; // that it stands for [sr]
    };
    struct Piece {
        uint32_t node, first, last; // its hits
        float priority;             // to be split
        bool isSeen() const { return last > first; }
    };

    void castRays(glm::vec3 cache, glm::vec3 normal, uint32_t index);
    Piece hitsOf(uint32_t node, const Piece& parent) const;
    Piece narrow(Piece) const;
    void lookAtSurfels(glm::vec3 cache);
    double emittingAngle() const;
    void lookAtSmallLamps(glm::vec3 cache);
    double seenAngle(const Piece&) const;
    float hiddenShare(const Piece&) const;
    void choosePieces();
    void measure();

    const Surroundings& around;
    const SurfelTree& tree;
    const SurfelLookup& lookup;
    const std::vector<uint32_t> emitters; // leaves, ascending
    const uint32_t links;
    const std::vector<glm::vec3> evenDirections;

    float solidAngle = 0.0f; // that each ray of a cache stands for [sr]
    std::vector<BakeRay> rays;
    std::vector<BakeHit> met;
    std::vector<uint8_t> hidden;
    std::vector<Hit> hits;         // by leaf
    std::vector<double> angleSeen; // of all hits before each [sr]
    std::vector<uint32_t> lamps;   // of the emitters, those that are small to the cache
    // Of all leaves before each: areas of those that face the cache, and what solid angles they would fill if nothing
    // were in the way.
    std::vector<double> facingArea, openAngle;
    std::vector<Piece> pieces;
    std::vector<SeenSender> senders;
};

} // namespace rebound::detail
