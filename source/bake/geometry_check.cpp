// SPDX-License-Identifier: MIT
#include "rebound/bake/geometry.hpp"

#include "triangle.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace rebound {

namespace {

bool isFinite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.6g", value);
    return buffer;
}

std::string text(glm::vec3 v) {
    char buffer[96];
    std::snprintf(buffer, sizeof buffer, "(%.6g, %.6g, %.6g)", double(v.x), double(v.y), double(v.z));
    return buffer;
}

Result<> checkNumbers(const BakeGeometry& geometry) {
    const auto wrong = [](const std::string& sentence) { return Error{ErrorCode::invalidData, sentence}; };
    const size_t indices = geometry.indices.size();
    if (indices == 0 || indices % 3 != 0)
        return wrong("geometry.indices has " + std::to_string(indices) +
                     " numbers; three a triangle, and at least one triangle, were expected");
    if (indices / 3 >= std::numeric_limits<uint32_t>::max())
        return wrong("geometry.indices has " + std::to_string(indices / 3) +
                     " triangles; fewer than 4294967295 were expected");
    for (size_t i = 0; i < geometry.positions.size(); ++i)
        if (!isFinite(geometry.positions[i]))
            return wrong("geometry.positions[" + std::to_string(i) + "] is " + text(geometry.positions[i]) +
                         "; finite coordinates were expected");
    for (size_t i = 0; i < indices; ++i)
        if (geometry.indices[i] >= geometry.positions.size())
            return wrong("geometry.indices[" + std::to_string(i) + "] is " +
                         std::to_string(geometry.indices[i]) + "; less than " +
                         std::to_string(geometry.positions.size()) +
                         ", the number of positions, was expected");
    return {};
}

} // namespace

Result<> validate(const BakeGeometry& geometry) {
    if (auto numbers = checkNumbers(geometry); !numbers) return numbers;
    double area = 0.0;
    glm::dvec3 lower(std::numeric_limits<double>::infinity()), upper = -lower;
    for (uint32_t i = 0; i < geometry.triangles(); ++i) {
        const detail::Triangle triangle(geometry, i);
        area += triangle.area();
        for (const glm::dvec3& corner : triangle.corner) {
            lower = glm::min(lower, corner);
            upper = glm::max(upper, corner);
        }
    }
    const auto wrong = [](const std::string& sentence) { return Error{ErrorCode::invalidData, sentence}; };
    if (!(area > 0.0))
        return wrong("geometry has " + std::to_string(geometry.triangles()) +
                     " triangles of no area; at least one that has an area was expected");
    constexpr double shortest = 1e-3, longest = 1e5, rounding = 1e-5;
    const double diagonal = glm::length(upper - lower);
    if (diagonal < shortest * (1.0 - rounding) || diagonal > longest * (1.0 + rounding))
        return wrong("geometry is " + text(diagonal) +
                     " m from corner to corner; 0.001 to 100000 m were expected");
    // Single precision has to tell apart places that are a small part of the scene away from each other.
    const double furthest = std::max(glm::length(lower), glm::length(upper));
    constexpr double mostOffset = 1000.0; // diagonals: leaves 1/8000 of a diagonal between two numbers
    if (furthest > mostOffset * diagonal)
        return wrong("geometry of " + text(diagonal) + " m lies " + text(furthest) +
                     " m from the origin; at most 1000 times its size was expected");
    return {};
}

} // namespace rebound
