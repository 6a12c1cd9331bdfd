// SPDX-License-Identifier: MIT
#include "links.hpp"

#include "link_cut.hpp"

#include "rebound/bake/packing.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rebound::detail {

namespace {

// c_i over c_0 and its largest possible magnitude, as a signed number of so many bits.
uint32_t quantize(float c, float c0, int harmonic, uint32_t bits) {
    const float band = harmonic < 4 ? 1.0f : harmonic < 9 ? 2.0f : 3.0f;
    const float largest = float((1 << (bits - 1)) - 1);
    const float share = std::clamp(c / (c0 * std::sqrt(2.0f * band + 1.0f)), -1.0f, 1.0f);
    return uint32_t(int32_t(std::lround(share * largest))) & ((1u << bits) - 1u);
}

uint32_t shapeWord(const std::array<float, 16>& c, const BakeLayout& layout, uint32_t word) {
    if (layout.linkForm == LinkForm::direction) {
        const glm::vec3 mean(c[3], c[1], c[2]); // band 1: x, y and z
        const float length = glm::length(mean);
        return packOctahedral(length > 0.0f ? mean / length : glm::vec3(0, 0, 1));
    }
    const uint32_t bits = layout.bands == 2 ? 10 : 8, ofWord = 32 / bits;
    uint32_t packed = 0;
    for (uint32_t i = 0; i < ofWord; ++i)
        if (const uint32_t harmonic = 1 + word * ofWord + i; harmonic < layout.coefficients())
            packed |= quantize(c[harmonic], c[0], int(harmonic), bits) << (bits * i);
    return packed;
}

} // namespace

LinkSections linkCaches(const Surroundings& around, std::span<const glm::vec3> caches,
                        std::span<const glm::vec3> normals, uint32_t first, uint32_t last,
                        const SurfelTree& tree, const SurfelLookup& lookup, const BakeSettings& settings) {
    BakeLayout layout; // of these caches alone
    setTree(layout, tree);
    layout.caches = last - first;
    layout.links = settings.links;
    layout.bands = settings.bands;
    layout.linkForm = settings.linkForm;
    LinkSections sections;
    sections.nodes.assign(sizeOf(layout, BakeSection::linkNodes), tree.emptyNode());
    sections.factors.assign(sizeOf(layout, BakeSection::linkFactors), 0);
    sections.shapes.assign(sizeOf(layout, BakeSection::linkShapes), 0);

    LinkCutter cutter(around, tree, lookup, settings);
    const size_t words = layout.shapeWords();
    for (uint32_t cache = first; cache < last; ++cache) {
        const size_t onSurfaces = caches.size() - normals.size();
        const glm::vec3 normal = cache < onSurfaces ? glm::vec3(0.0f) : normals[cache - onSurfaces];
        // Texels beside each other look the same ways: what they err by changes slowly, and no texel stands out.
        const uint32_t rotation = cache < onSurfaces ? cache : 0u;
        const std::vector<SeenSender>& senders = cutter.cut(caches[cache], normal, rotation);
        for (size_t j = 0; j < senders.size(); ++j) {
            const SeenSender& sender = senders[j];
            const size_t at = BakeLayout::ofCache(cache - first, j, layout.links);
            sections.nodes[at] = sender.node;
            sections.factors[at] =
                std::bit_cast<uint32_t>(sender.coefficients[0] / tree.nodes[sender.node].area);
            for (uint32_t w = 0; w < words; ++w)
                sections.shapes[BakeLayout::ofCache(cache - first, j * words + w, layout.links * words)] =
                    shapeWord(sender.coefficients, layout, w);
        }
    }
    return sections;
}

} // namespace rebound::detail
