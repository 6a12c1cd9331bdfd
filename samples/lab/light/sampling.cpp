// SPDX-License-Identifier: MIT
#include "lab/light/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rebound::lab {

namespace {

// Its third column is the normal.
glm::mat3 basisAbout(glm::vec3 n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return {glm::vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x),
            glm::vec3(b, sign + n.y * n.y * a, -n.y), n};
}

} // namespace

float receivedCosine(const SurfacePoint& point, glm::vec3 direction) {
    if (!(glm::dot(point.geometricNormal, direction) > 0.0f)) return 0.0f;
    return std::max(0.0f, glm::dot(point.shadingNormal, direction));
}

glm::vec3 fromTangentSpace(glm::vec3 normal, glm::vec3 vector) { return basisAbout(normal) * vector; }

glm::vec3 toTangentSpace(glm::vec3 normal, glm::vec3 vector) { return vector * basisAbout(normal); }

glm::vec3 cosineDirection(glm::vec3 normal, glm::vec2 square) {
    const float radius = std::sqrt(square.x);
    const float angle = 2.0f * std::numbers::pi_v<float> * square.y;
    return fromTangentSpace(normal, {radius * std::cos(angle), radius * std::sin(angle),
                                     std::sqrt(std::max(0.0f, 1.0f - square.x))});
}

} // namespace rebound::lab
