// SPDX-License-Identifier: MIT
#include "lab/sequences/motion_path.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace rebound::lab {

namespace {

template <class Key, class Value>
glm::dvec3 slopeAt(const std::vector<Key>& keys, size_t i, const Value& valueOf) {
    if (keys.size() < 2) return glm::dvec3(0.0);
    const size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, keys.size() - 1);
    return (valueOf(keys[after]) - valueOf(keys[before])) / (keys[after].time - keys[before].time);
}

// Precondition: there is a key.
template <class Key, class Value>
glm::dvec3 between(const std::vector<Key>& keys, double time, Interpolation how, const Value& valueOf) {
    if (time <= keys.front().time) return valueOf(keys.front());
    if (time >= keys.back().time) return valueOf(keys.back());
    const auto next = std::upper_bound(keys.begin(), keys.end(), time,
                                       [](double t, const Key& key) { return t < key.time; });
    const size_t j = size_t(next - keys.begin()), i = j - 1;
    const double length = keys[j].time - keys[i].time, t = (time - keys[i].time) / length;
    const glm::dvec3 from = valueOf(keys[i]), to = valueOf(keys[j]);
    if (how == Interpolation::linear) return glm::mix(from, to, t);
    const glm::dvec3 fromSlope = length * slopeAt(keys, i, valueOf),
                     toSlope = length * slopeAt(keys, j, valueOf);
    const double s = 1.0 - t;
    return s * s * ((1.0 + 2.0 * t) * from + t * fromSlope) + t * t * ((1.0 + 2.0 * s) * to - s * toSlope);
}

} // namespace

CameraView cameraAt(const MotionPath& path, const CameraView& base, double time) {
    CameraView camera = base;
    if (path.camera.empty()) return camera;
    const auto at = [&](const auto& valueOf) {
        return between(path.camera, time, path.interpolation, valueOf);
    };
    camera.position = glm::vec3(at([](const CameraKey& key) { return glm::dvec3(key.position); }));
    camera.target = glm::vec3(at([](const CameraKey& key) { return glm::dvec3(key.target); }));
    camera.verticalFieldOfView =
        float(at([&](const CameraKey& key) {
                  return glm::dvec3(double(key.fieldOfView.value_or(base.verticalFieldOfView)));
              }).x);
    return camera;
}

glm::mat4 placeAt(const MotionPath& path, const ObjectPath& object, double time) {
    const auto at = [&](const auto& valueOf) {
        return between(object.keys, time, path.interpolation, valueOf);
    };
    const glm::dvec3 translation = at([](const ObjectKey& key) { return glm::dvec3(key.translation); });
    const double degrees = at([](const ObjectKey& key) { return glm::dvec3(double(key.degrees)); }).x;
    const glm::dvec3 pivot(object.pivot);
    glm::dmat4 place = glm::translate(glm::dmat4(1.0), translation + pivot);
    place = glm::rotate(place, glm::radians(degrees), glm::normalize(glm::dvec3(object.axis)));
    return glm::mat4(glm::translate(place, -pivot));
}

} // namespace rebound::lab
