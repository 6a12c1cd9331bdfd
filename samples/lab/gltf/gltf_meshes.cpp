// SPDX-License-Identifier: MIT
#include "lab/gltf/gltf_meshes.hpp"

#include "lab/files/input_error.hpp"
#include "lab/gltf/gltf_accessors.hpp"
#include "lab/gltf/gltf_primitive.hpp"
#include "lab/gltf/gltf_skinning.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace rebound::lab {
namespace {

// Of a triangle; up where it has no area.
glm::vec3 faceNormal(const Mesh& mesh, size_t triangle) {
    const auto corner = [&](size_t i) { return glm::dvec3(mesh.positions[mesh.indices[triangle * 3 + i]]); };
    const glm::dvec3 normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    const double length = glm::length(normal);
    return length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0, 1, 0);
}

// Directions of normals under a matrix: its cofactors, which exist for flat matrices too. A mirroring matrix
// changes their sign, and the triangles' winding with it.
glm::dmat3 normalMatrix(const glm::dmat4& matrix) {
    const glm::dmat3 m(matrix);
    const double sign = glm::determinant(m) < 0.0 ? -1.0 : 1.0;
    return sign * glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
}

// Matrices to world space: one for all vertices, or one each.
class Placement {
public:
    explicit Placement(std::vector<glm::dmat4> toWorld) : matrices(std::move(toWorld)) {}
    const glm::dmat4& of(size_t vertex) const { return matrices[matrices.size() == 1 ? 0 : vertex]; }
    bool isShared() const { return matrices.size() == 1; }

private:
    std::vector<glm::dmat4> matrices;
};

// Normals of no length get zero, and a face's normal later.
std::vector<glm::vec3> placeNormals(const std::vector<glm::vec3>& normals, const Placement& placement) {
    std::vector<glm::vec3> placed;
    placed.reserve(normals.size());
    glm::dmat3 matrix = normals.empty() ? glm::dmat3(1.0) : normalMatrix(placement.of(0));
    for (size_t i = 0; i < normals.size(); ++i) {
        if (!placement.isShared()) matrix = normalMatrix(placement.of(i));
        const glm::dvec3 normal = matrix * glm::dvec3(normals[i]);
        const double length = glm::length(normal);
        placed.push_back(length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0f));
    }
    return placed;
}

void repairNormals(Mesh& mesh) {
    for (size_t i = 0; i < mesh.indices.size(); ++i)
        if (glm::vec3& normal = mesh.normals[mesh.indices[i]]; normal == glm::vec3(0.0f))
            normal = faceNormal(mesh, i / 3);
    for (glm::vec3& normal : mesh.normals) // of vertices without triangles
        if (normal == glm::vec3(0.0f)) normal = {0, 1, 0};
}

template <class T>
void unshare(std::vector<T>& values, const std::vector<uint32_t>& indices) {
    if (values.empty()) return;
    std::vector<T> expanded;
    expanded.reserve(indices.size());
    for (const uint32_t index : indices) expanded.push_back(values[index]);
    values = std::move(expanded);
}

// glTF has triangles without normals shaded flat, so that they cannot share vertices.
void makeFlat(Mesh& mesh) {
    unshare(mesh.positions, mesh.indices);
    unshare(mesh.colors, mesh.indices);
    unshare(mesh.textureCoordinates, mesh.indices);
    unshare(mesh.emissionCoordinates, mesh.indices);
    for (size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = static_cast<uint32_t>(i);
    mesh.normals.resize(mesh.indices.size());
    for (size_t i = 0; i < mesh.indices.size(); ++i) mesh.normals[i] = faceNormal(mesh, i / 3);
}

Mesh place(Primitive primitive, const Placement& placement) {
    Mesh mesh;
    mesh.positions.reserve(primitive.positions.size());
    for (size_t i = 0; i < primitive.positions.size(); ++i)
        mesh.positions.emplace_back(placement.of(i) * glm::dvec4(primitive.positions[i], 1.0));
    mesh.normals = placeNormals(primitive.normals, placement);
    mesh.colors = std::move(primitive.colors);
    mesh.textureCoordinates = std::move(primitive.textureCoordinates);
    mesh.emissionCoordinates = std::move(primitive.emissionCoordinates);
    mesh.indices = std::move(primitive.indices);
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        if (glm::determinant(glm::dmat3(placement.of(mesh.indices[i]))) < 0.0)
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    if (mesh.normals.empty()) makeFlat(mesh);
    else repairNormals(mesh);
    return mesh;
}

// Adds up before anything is read, so that a refusal costs nothing.
class GeometrySize {
public:
    void add(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
        const size_t count = vertexCount(model, primitive);
        const size_t indexCount = primitive.indices >= 0 ? accessorCount(model, primitive.indices) : count;
        // Strips and fans make a triangle of almost every index, and flat shading three vertices of every
        // triangle.
        const bool isList = primitive.mode == TINYGLTF_MODE_TRIANGLES;
        const size_t newTriangles = isList ? indexCount / 3 : indexCount;
        vertices += primitive.attributes.contains("NORMAL") ? count : std::max(count, newTriangles * 3);
        triangles += newTriangles;
        if (vertices > largestVertexCount || triangles > largestTriangleCount)
            refuse("it has more than " + std::to_string(largestVertexCount) + " vertices or " +
                   std::to_string(largestTriangleCount) + " triangles");
    }

private:
    size_t vertices = 0;
    size_t triangles = 0;
};

class GeometryReader {
public:
    GeometryReader(const tinygltf::Model& gltf, const std::vector<NodePose>& nodePoses,
                   const std::vector<glm::dmat4>& nodeToWorld, GltfMaterials& gltfMaterials,
                   GltfNotes& gltfNotes)
        : model(gltf), poses(nodePoses), world(nodeToWorld), materials(gltfMaterials), notes(gltfNotes) {}

    void addNodes(const std::vector<int>& nodes) {
        GeometrySize size;
        noteOtherPrimitives(nodes);
        forEachPrimitive(nodes, [&](size_t, const tinygltf::Mesh&, const tinygltf::Primitive& primitive) {
            size.add(model, primitive);
        });
        forEachPrimitive(nodes,
                         [&](size_t node, const tinygltf::Mesh& mesh, const tinygltf::Primitive& primitive) {
                             addPrimitive(node, mesh, primitive);
                         });
    }

    std::vector<Mesh> take() { return std::move(meshes); }

private:
    void forEachPrimitive(const std::vector<int>& nodes, const auto& visit) const {
        for (const int number : nodes) {
            const auto node = static_cast<size_t>(number);
            if (model.nodes[node].mesh < 0) continue;
            const tinygltf::Mesh& mesh = itemAt(model.meshes, model.nodes[node].mesh, "mesh");
            for (const tinygltf::Primitive& primitive : mesh.primitives)
                if (hasTriangles(primitive)) visit(node, mesh, primitive);
        }
    }

    void noteOtherPrimitives(const std::vector<int>& nodes) const {
        for (const int node : nodes) {
            const int index = model.nodes[static_cast<size_t>(node)].mesh;
            if (index < 0) continue;
            const tinygltf::Mesh& mesh = itemAt(model.meshes, index, "mesh");
            for (size_t i = 0; i < mesh.primitives.size(); ++i)
                if (!hasTriangles(mesh.primitives[i]))
                    notes.add(GltfNotes::Kind::noTriangles, "primitive " + std::to_string(i) + " of mesh " +
                                                                std::to_string(index) + " ('" + mesh.name +
                                                                "')");
        }
    }

    void addPrimitive(size_t node, const tinygltf::Mesh& source, const tinygltf::Primitive& primitive) {
        const auto& [number, material] = materials.use(primitive.material);
        const std::vector<double>& weights =
            poses[node].morphWeights.empty() ? source.weights : poses[node].morphWeights;
        const int skin = model.nodes[node].skin;
        const bool skinned = skin >= 0 && primitive.attributes.contains("JOINTS_0");
        Mesh mesh = place(
            readPrimitive(model, primitive, material, weights),
            Placement(skinned ? skinMatrices(model, skin, primitive, vertexCount(model, primitive), world)
                              : std::vector<glm::dmat4>{world[node]}));
        mesh.name = source.name;
        mesh.material = number;
        meshes.push_back(std::move(mesh));
    }

    const tinygltf::Model& model;
    const std::vector<NodePose>& poses;
    const std::vector<glm::dmat4>& world;
    GltfMaterials& materials;
    GltfNotes& notes;
    std::vector<Mesh> meshes;
};

} // namespace

std::vector<Mesh> readMeshes(const tinygltf::Model& model, const std::vector<int>& nodes,
                             const std::vector<NodePose>& poses, const std::vector<glm::dmat4>& world,
                             GltfMaterials& materials, GltfNotes& notes) {
    GeometryReader reader(model, poses, world, materials, notes);
    reader.addNodes(nodes);
    return reader.take();
}

} // namespace rebound::lab
