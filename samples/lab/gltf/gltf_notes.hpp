// SPDX-License-Identifier: MIT
// What a glTF file holds that the lab leaves out or takes for something else: one sentence a kind, however often it
// occurs.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace rebound::lab {

class GltfNotes {
public:
    enum class Kind {
        blend,
        normalTexture,
        metallicRoughnessTexture,
        occlusionTexture,
        nearestFilter,
        lightRange,
        noTriangles,
        animationPointer,
    };

    // subject: what it was found at, such as "material 3 ('glass')".
    void add(Kind, const std::string& subject);

    void add(std::string sentence) { sentences.push_back(std::move(sentence)); }

    void add(const GltfNotes&);

    // All sentences, each with the file's name in front.
    std::vector<std::string> take(const std::string& file) const;

private:
    struct Occurrences {
        int count = 0;
        std::string first;
    };
    std::map<Kind, Occurrences> kinds;
    std::vector<std::string> sentences;
};

} // namespace rebound::lab
