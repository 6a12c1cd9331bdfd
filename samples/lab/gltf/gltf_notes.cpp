// SPDX-License-Identifier: MIT
#include "lab/gltf/gltf_notes.hpp"

namespace rebound::lab {
namespace {

const char* meaning(GltfNotes::Kind kind) {
    using Kind = GltfNotes::Kind;
    switch (kind) {
    case Kind::blend:
        return "blends with what lies behind (alphaMode BLEND): it is cut out where its opacity is below "
               "0.5, and opaque "
               "elsewhere";
    case Kind::normalTexture:
        return "has a normal texture, which is left out: its normals are those of its vertices";
    case Kind::metallicRoughnessTexture:
        return "has a metallic-roughness texture, which is left out: its two factors count alone";
    case Kind::occlusionTexture:
        return "has an occlusion texture, which is left out: occlusion follows from geometry";
    case Kind::nearestFilter:
        return "asks for its nearest texel (magFilter NEAREST): it is filtered bilinearly";
    case Kind::lightRange:
        return "has a range, which is left out: light falls off with the square of the distance alone";
    case Kind::noTriangles:
        return "has no triangles, but points, lines or no positions, and is left out";
    case Kind::animationPointer:
        return "animates something else than nodes (KHR_animation_pointer), which is left out";
    }
    return "";
}

} // namespace

void GltfNotes::add(Kind kind, const std::string& subject) {
    Occurrences& occurrences = kinds[kind];
    if (occurrences.count++ == 0) occurrences.first = subject;
}

void GltfNotes::add(const GltfNotes& others) {
    for (const auto& [kind, more] : others.kinds) {
        Occurrences& occurrences = kinds[kind];
        if (occurrences.count == 0) occurrences.first = more.first;
        occurrences.count += more.count;
    }
    sentences.insert(sentences.end(), others.sentences.begin(), others.sentences.end());
}

std::vector<std::string> GltfNotes::take(const std::string& file) const {
    const std::string prefix = "'" + file + "': ";
    std::vector<std::string> notes;
    for (const auto& [kind, occurrences] : kinds)
        notes.push_back(prefix + occurrences.first + " " + meaning(kind) +
                        (occurrences.count > 1
                             ? " (and so it is with " + std::to_string(occurrences.count - 1) + " more)"
                             : ""));
    for (const std::string& sentence : sentences) notes.push_back(prefix + sentence);
    return notes;
}

} // namespace rebound::lab
