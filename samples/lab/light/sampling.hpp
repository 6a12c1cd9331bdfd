// SPDX-License-Identifier: MIT
// Random numbers along a path, and directions made of them.
#pragma once

#include "lab/light/low_discrepancy.hpp"
#include "lab/rays/embree_scene.hpp"

namespace rebound::lab {

// The points of one sample of an integral over many dimensions: pair by pair, each pair a low-discrepancy
// sequence over the samples, shuffled so that pairs know nothing of each other.
class SampleSequence {
public:
    // Sample `index` of the sequence that the seed chooses.
    SampleSequence(uint32_t index, uint32_t seed) : index_(index), seed_(seed) {}

    glm::vec2 next() { return shuffledSobolPoint(index_, hashBits(seed_, dimension++)); }

private:
    uint32_t index_;
    uint32_t seed_;
    uint32_t dimension = 0;
};

// Cosine of a unit direction with the shading normal; 0 for light that falls on the other side of the
// surface.
float receivedCosine(const SurfacePoint&, glm::vec3 direction);

// A vector given along two tangents and a unit normal, in world space. Duff et al.: Building an Orthonormal
// Basis, Revisited.
glm::vec3 fromTangentSpace(glm::vec3 normal, glm::vec3 vector);
glm::vec3 toTangentSpace(glm::vec3 normal, glm::vec3 vector);

// A unit direction about a unit normal, of density cosine / pi per solid angle, from a point of the unit
// square.
glm::vec3 cosineDirection(glm::vec3 normal, glm::vec2 square);

} // namespace rebound::lab
