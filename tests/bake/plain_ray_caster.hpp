// SPDX-License-Identifier: MIT
// The yardstick of ray casters, and an example of one: every ray against every triangle, in double precision.
#pragma once

#include "rebound/bake/geometry.hpp"
#include "rebound/bake/rays.hpp"

#include "triangle.hpp"

class PlainRayCaster : public rebound::RayCaster {
public:
    // The geometry has to outlive it.
    explicit PlainRayCaster(const rebound::BakeGeometry& casted) : geometry(casted) {}

    void intersect(std::span<const rebound::BakeRay> rays, std::span<rebound::BakeHit> hits) const override {
        for (size_t i = 0; i < rays.size(); ++i) hits[i] = nearest(rays[i]);
    }
    void occluded(std::span<const rebound::BakeRay> rays, std::span<uint8_t> answers) const override {
        for (size_t i = 0; i < rays.size(); ++i)
            answers[i] = nearest(rays[i]).triangle != rebound::noTriangle;
    }

private:
    rebound::BakeHit nearest(const rebound::BakeRay& ray) const {
        rebound::BakeHit best;
        double furthest = double(ray.maximum);
        for (uint32_t i = 0; i < geometry.triangles(); ++i) {
            // Moller, Trumbore: Fast, Minimum Storage Ray/Triangle Intersection.
            const rebound::detail::Triangle triangle(geometry, i);
            const glm::dvec3 first = triangle.corner[1] - triangle.corner[0];
            const glm::dvec3 second = triangle.corner[2] - triangle.corner[0];
            const glm::dvec3 across = glm::cross(glm::dvec3(ray.direction), second);
            const double determinant = glm::dot(first, across);
            if (determinant == 0.0) continue;
            const glm::dvec3 from = glm::dvec3(ray.origin) - triangle.corner[0];
            const double u = glm::dot(from, across) / determinant;
            const glm::dvec3 turned = glm::cross(from, first);
            const double v = glm::dot(glm::dvec3(ray.direction), turned) / determinant;
            const double distance = glm::dot(second, turned) / determinant;
            if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance >= double(ray.minimum) &&
                  distance <= furthest))
                continue;
            const glm::vec2 place(static_cast<float>(u), static_cast<float>(v));
            if (geometry.surface && geometry.surface(i, place).hole) continue;
            best = {i, float(distance), place};
            furthest = distance;
        }
        return best;
    }

    const rebound::BakeGeometry& geometry;
};
