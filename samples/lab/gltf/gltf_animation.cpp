// SPDX-License-Identifier: MIT
// Keyframe interpolation as in glTF 2.0, appendix C.
#include "lab/gltf/gltf_nodes.hpp"

#include "lab/files/input_error.hpp"
#include "lab/gltf/gltf_accessors.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::lab {
namespace {

enum class Interpolation { step, linear, cubicSpline };

// Values of one channel: `width` numbers a key, thrice that with tangents.
struct Track {
    std::vector<float> times; // [s], rising
    std::vector<float> values;
    size_t width = 0;
    Interpolation interpolation = Interpolation::linear;
    bool isRotation = false;

    enum Part { inTangent, value, outTangent };
    double at(size_t key, Part part, size_t i) const {
        if (interpolation == Interpolation::cubicSpline)
            return static_cast<double>(values[(key * 3 + static_cast<size_t>(part)) * width + i]);
        return static_cast<double>(values[key * width + i]);
    }
};

Interpolation interpolationNamed(const std::string& name) {
    if (name.empty() || name == "LINEAR") return Interpolation::linear;
    if (name == "STEP") return Interpolation::step;
    if (name == "CUBICSPLINE") return Interpolation::cubicSpline;
    refuse("an animation has the interpolation '" + name + "'; expected LINEAR, STEP or CUBICSPLINE");
}

Track readTrack(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler, size_t width,
                bool isRotation) {
    Track track;
    track.width = width;
    track.isRotation = isRotation;
    track.interpolation = interpolationNamed(sampler.interpolation);
    track.times = readFloats(model, sampler.input, 1);
    if (std::adjacent_find(track.times.begin(), track.times.end(), std::greater_equal<>()) !=
        track.times.end())
        refuse("accessor " + std::to_string(sampler.input) +
               " holds an animation's times, but they do not rise");
    // Morph weights are scalars, several of them a key.
    const bool scalars = itemAt(model.accessors, sampler.output, "accessor").type == TINYGLTF_TYPE_SCALAR;
    track.values = readFloats(model, sampler.output, scalars ? 1 : static_cast<int>(width));
    const size_t parts = track.interpolation == Interpolation::cubicSpline ? 3 : 1;
    if (track.values.size() != track.times.size() * width * parts)
        refuse("accessor " + std::to_string(sampler.output) + " holds " +
               std::to_string(track.values.size()) + " numbers for " + std::to_string(track.times.size()) +
               " keys; expected " + std::to_string(track.times.size() * width * parts));
    return track;
}

std::vector<double> keyValue(const Track& track, size_t key) {
    std::vector<double> result(track.width);
    for (size_t i = 0; i < track.width; ++i) result[i] = track.at(key, Track::value, i);
    return result;
}

std::vector<double> hermite(const Track& track, size_t key, double t, double duration) {
    const double t2 = t * t, t3 = t2 * t;
    std::vector<double> result(track.width);
    for (size_t i = 0; i < track.width; ++i)
        result[i] = (2 * t3 - 3 * t2 + 1) * track.at(key, Track::value, i) +
                    duration * (t3 - 2 * t2 + t) * track.at(key, Track::outTangent, i) +
                    (-2 * t3 + 3 * t2) * track.at(key + 1, Track::value, i) +
                    duration * (t3 - t2) * track.at(key + 1, Track::inTangent, i);
    return result;
}

glm::dquat quaternion(const std::vector<double>& v) {
    const glm::dquat q(v[3], v[0], v[1], v[2]);
    const double length = glm::length(q);
    if (!(length > 0.0) || !std::isfinite(length))
        refuse("an animation holds a rotation that is not a quaternion of positive length");
    return q / length;
}

std::vector<double> sample(const Track& track, double time) {
    const auto after = std::upper_bound(track.times.begin(), track.times.end(), time,
                                        [](double t, float key) { return t < static_cast<double>(key); });
    if (after == track.times.begin()) return keyValue(track, 0);
    const auto next = static_cast<size_t>(after - track.times.begin());
    const size_t key = next - 1;
    if (after == track.times.end() || track.interpolation == Interpolation::step) return keyValue(track, key);
    const double begin = static_cast<double>(track.times[key]);
    const double duration = static_cast<double>(track.times[next]) - begin;
    const double t = (time - begin) / duration;
    if (track.interpolation == Interpolation::cubicSpline) return hermite(track, key, t, duration);
    std::vector<double> from = keyValue(track, key);
    const std::vector<double> to = keyValue(track, next);
    if (track.isRotation) {
        const glm::dquat q = glm::slerp(quaternion(from), quaternion(to), t);
        return {q.x, q.y, q.z, q.w};
    }
    for (size_t i = 0; i < track.width; ++i) from[i] += t * (to[i] - from[i]);
    return from;
}

size_t morphTargetCount(const tinygltf::Model& model, const tinygltf::Node& node) {
    const tinygltf::Mesh& mesh = itemAt(model.meshes, node.mesh, "mesh");
    return mesh.primitives.empty() ? 0 : mesh.primitives.front().targets.size();
}

void applyChannel(const tinygltf::Model& model, const tinygltf::Animation& animation,
                  const tinygltf::AnimationChannel& channel, double time, std::vector<NodePose>& poses,
                  GltfNotes& notes) {
    // glTF has readers skip a channel without a node: an extension animates something else.
    if (channel.target_node < 0)
        return notes.add(GltfNotes::Kind::animationPointer, "animation '" + animation.name + "'");
    const tinygltf::Node& node = itemAt(model.nodes, channel.target_node, "node");
    NodePose& pose = poses[static_cast<size_t>(channel.target_node)];
    const std::string& path = channel.target_path;
    const bool isRotation = path == "rotation", isWeights = path == "weights";
    if (!isRotation && !isWeights && path != "translation" && path != "scale")
        refuse("animation '" + animation.name + "' animates '" + path +
               "'; expected translation, rotation, scale or weights");
    if (pose.matrix && !isWeights)
        refuse("animation '" + animation.name + "' animates " +
               nodeName(model, static_cast<size_t>(channel.target_node)) + ", which has a matrix");
    const size_t width = isRotation ? 4 : isWeights ? morphTargetCount(model, node) : 3;
    if (width == 0)
        refuse("animation '" + animation.name + "' animates weights of a mesh without morph targets");
    const tinygltf::AnimationSampler& sampler =
        itemAt(animation.samplers, channel.sampler, "animation sampler");
    std::vector<double> v = sample(readTrack(model, sampler, width, isRotation), time);
    if (isRotation) pose.rotation = quaternion(v);
    else if (isWeights) pose.morphWeights = std::move(v);
    else (path == "scale" ? pose.scale : pose.translation) = {v[0], v[1], v[2]};
}

const tinygltf::Animation& animationNamed(const tinygltf::Model& model, const std::string& name) {
    if (name.empty()) return model.animations.front();
    std::string known;
    for (const tinygltf::Animation& animation : model.animations) {
        if (animation.name == name) return animation;
        known += (known.empty() ? "'" : ", '") + animation.name + "'";
    }
    refuse("it has no animation '" + name + "'" + (known.empty() ? "" : "; its animations are " + known),
           ErrorCode::notFound);
}

} // namespace

void applyAnimation(const tinygltf::Model& model, const GltfOptions& options, std::vector<NodePose>& poses,
                    GltfNotes& notes) {
    if (!options.animate || (options.animation.empty() && model.animations.empty())) return;
    if (!std::isfinite(options.time))
        refuse("the time of animation '" + options.animation + "' is not finite", ErrorCode::invalidArgument);
    const tinygltf::Animation& animation = animationNamed(model, options.animation);
    for (const tinygltf::AnimationChannel& channel : animation.channels)
        applyChannel(model, animation, channel, static_cast<double>(options.time), poses, notes);
}

} // namespace rebound::lab
