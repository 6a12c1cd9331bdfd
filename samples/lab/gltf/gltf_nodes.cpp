// SPDX-License-Identifier: MIT
#include "lab/gltf/gltf_nodes.hpp"

#include "lab/files/input_error.hpp"
#include "lab/gltf/gltf_accessors.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace rebound::lab {
namespace {

// Lists of a wrong length are refused; an absent one is empty and keeps the default.
bool hasNumbers(const std::vector<double>& numbers, size_t expected, const char* key,
                const std::string& node) {
    if (numbers.empty()) return false;
    if (numbers.size() != expected ||
        !std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); }))
        refuse(node + " has a '" + key + "' that is not " + std::to_string(expected) + " finite numbers");
    return true;
}

NodePose restPose(const tinygltf::Node& node, const std::string& name) {
    NodePose pose;
    if (hasNumbers(node.matrix, 16, "matrix", name)) {
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
        pose.matrix = matrix;
    }
    if (hasNumbers(node.translation, 3, "translation", name))
        pose.translation = {node.translation[0], node.translation[1], node.translation[2]};
    if (hasNumbers(node.scale, 3, "scale", name)) pose.scale = {node.scale[0], node.scale[1], node.scale[2]};
    if (hasNumbers(node.rotation, 4, "rotation", name)) {
        pose.rotation = glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        const double length = glm::length(pose.rotation);
        if (!(length > 0.0) || !std::isfinite(length))
            refuse(name + " has a 'rotation' that is not a quaternion of positive length");
        pose.rotation /= length;
    }
    pose.morphWeights = node.weights;
    return pose;
}

glm::dmat4 localMatrix(const NodePose& pose) {
    if (pose.matrix) return *pose.matrix;
    return glm::scale(glm::translate(glm::dmat4(1.0), pose.translation) * glm::mat4_cast(pose.rotation),
                      pose.scale);
}

// Each node's parent, or none; a node has at most one.
std::vector<int> findParents(const tinygltf::Model& model) {
    std::vector<int> parents(model.nodes.size(), none);
    for (size_t i = 0; i < model.nodes.size(); ++i)
        for (const int child : model.nodes[i].children) {
            itemAt(model.nodes, child, "node");
            int& parent = parents[static_cast<size_t>(child)];
            if (parent != none)
                refuse(nodeName(model, static_cast<size_t>(child)) + " is a child twice, of nodes " +
                       std::to_string(parent) + " and " + std::to_string(i));
            parent = static_cast<int>(i);
        }
    return parents;
}

// Roots and all below them, parents first. As no node has two parents, nodes on a cycle are below no root.
std::vector<int> withDescendants(const tinygltf::Model& model, std::vector<int> roots) {
    std::vector<int> order;
    std::vector<int> open(roots.rbegin(), roots.rend());
    while (!open.empty()) {
        const int node = open.back();
        open.pop_back();
        order.push_back(node);
        const std::vector<int>& children = model.nodes[static_cast<size_t>(node)].children;
        open.insert(open.end(), children.rbegin(), children.rend());
    }
    return order;
}

std::vector<int> rootNodes(const std::vector<int>& parents) {
    std::vector<int> roots;
    for (size_t i = 0; i < parents.size(); ++i)
        if (parents[i] == none) roots.push_back(static_cast<int>(i));
    return roots;
}

bool isFinite(const glm::dmat4& matrix) {
    for (int i = 0; i < 16; ++i)
        if (!std::isfinite(matrix[i / 4][i % 4])) return false;
    return true;
}

} // namespace

std::string nodeName(const tinygltf::Model& model, size_t node) {
    return "node " + std::to_string(node) + " ('" + model.nodes[node].name + "')";
}

std::vector<NodePose> restPose(const tinygltf::Model& model) {
    std::vector<NodePose> poses;
    poses.reserve(model.nodes.size());
    for (size_t i = 0; i < model.nodes.size(); ++i)
        poses.push_back(restPose(model.nodes[i], nodeName(model, i)));
    return poses;
}

std::vector<glm::dmat4> worldMatrices(const tinygltf::Model& model, const std::vector<NodePose>& poses) {
    const std::vector<int> parents = findParents(model);
    const std::vector<int> order = withDescendants(model, rootNodes(parents));
    if (order.size() != model.nodes.size()) refuse("its nodes form a cycle");
    std::vector<glm::dmat4> world(model.nodes.size());
    for (const int node : order) {
        const auto i = static_cast<size_t>(node);
        world[i] = localMatrix(poses[i]);
        if (parents[i] != none) world[i] = world[static_cast<size_t>(parents[i])] * world[i];
        if (!isFinite(world[i])) refuse(nodeName(model, i) + " has a transform that is not finite");
    }
    return world;
}

void moveNodes(const tinygltf::Model& model, const std::map<std::string, glm::mat4>& moved,
               std::vector<glm::dmat4>& world) {
    for (const auto& [name, place] : moved) {
        std::vector<int> roots;
        std::string known;
        for (size_t i = 0; i < model.nodes.size(); ++i) {
            if (model.nodes[i].name == name) roots.push_back(static_cast<int>(i));
            known += (known.empty() ? "'" : ", '") + model.nodes[i].name + "'";
        }
        if (roots.empty())
            refuse("it has no node '" + name + "' to move; its nodes are " + known, ErrorCode::notFound);
        for (const int node : withDescendants(model, roots))
            world[static_cast<size_t>(node)] = glm::dmat4(place) * world[static_cast<size_t>(node)];
    }
}

std::vector<int> sceneNodes(const tinygltf::Model& model) {
    const std::vector<int> parents = findParents(model);
    if (model.scenes.empty()) return withDescendants(model, rootNodes(parents));
    const int number = model.defaultScene == none ? 0 : model.defaultScene;
    const tinygltf::Scene& scene = itemAt(model.scenes, number, "scene");
    std::vector<bool> listed(model.nodes.size(), false);
    for (const int node : scene.nodes) {
        itemAt(model.nodes, node, "node");
        const auto i = static_cast<size_t>(node);
        if (parents[i] != none || listed[i])
            refuse("scene " + std::to_string(number) + " lists " + nodeName(model, i) +
                   (listed[i] ? " twice" : ", which is another node's child"));
        listed[i] = true;
    }
    return withDescendants(model, scene.nodes);
}

} // namespace rebound::lab
