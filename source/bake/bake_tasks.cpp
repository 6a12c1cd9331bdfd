// SPDX-License-Identifier: MIT
#include "bake_tasks.hpp"

#include "content_key.hpp"

#include "rebound/bake/packing.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::detail {

namespace {

constexpr size_t leastItems = 64, mostParts = 4096;

uint32_t packPlace(glm::vec3 position) {
    const glm::vec3 share = glm::clamp((position + 1.0f) / 3.0f, 0.0f, 1.0f);
    const glm::uvec3 steps(glm::round(share * 1023.0f));
    return steps.x | steps.y << 10 | steps.z << 20;
}

void packReceiver(const Receiver& receiver, std::vector<uint32_t>& words) {
    words.push_back(packPlace(receiver.position));
    words.push_back(packOctahedral(receiver.normal));
    for (size_t half = 0; half < 2; ++half) {
        uint32_t word = 0;
        for (size_t c = 0; c < 4; ++c)
            word |= uint32_t(std::lround(receiver.visibility[4 * half + c] * 255.0f)) << (8 * c);
        words.push_back(word);
    }
}

template <class T>
void addCounted(ContentKey& key, std::span<const T> values) {
    key.add(uint64_t(values.size()));
    key.addAll(values);
}

void append(std::vector<uint32_t>& to, std::span<const uint32_t> words) {
    to.insert(to.end(), words.begin(), words.end());
}

} // namespace

PartRanges::PartRanges(size_t items)
    : count(uint32_t(items)),
      size(uint32_t(std::max(leastItems, (items / mostParts / leastItems + 1) * leastItems))) {}

ReceiverTask::ReceiverTask(const Surroundings& surroundings, const Lattice& grid, const CellTable& cellTable,
                           const std::vector<SurfaceSide>& surfaceSides,
                           const std::array<uint32_t, 4>& fingerprint)
    : around(surroundings), lattice(grid), table(cellTable), sides(surfaceSides), geometry(fingerprint),
      members(samplesOfCells(grid, cellTable.cells, surfaceSides)), ranges(cellTable.cells.size()) {}

BakeTask ReceiverTask::task() const {
    ContentKey key;
    key.add(geometry);
    for (int axis = 0; axis < 3; ++axis) key.add(lattice.origin[axis]);
    key.add(lattice.spacing);
    addCounted(key, std::span(table.caches));
    addCounted(key, std::span(table.cells));
    addCounted(key, std::span(sides));
    return {"receivers", key.words(), ranges.parts(), [this](uint32_t part) { return run(part); }};
}

// How many receivers each cell has, then all of them.
std::vector<uint32_t> ReceiverTask::run(uint32_t part) const {
    const auto ofCells =
        gatherReceivers(around, lattice, table, sides, members, ranges.first(part), ranges.last(part));
    std::vector<uint32_t> words;
    for (const auto& receivers : ofCells) words.push_back(uint32_t(receivers.size()));
    for (const auto& receivers : ofCells)
        for (const Receiver& receiver : receivers) packReceiver(receiver, words);
    return words;
}

ReceiverSections ReceiverTask::merge(BakeParts&& parts) const {
    ReceiverSections sections;
    uint32_t receivers = 0;
    for (uint32_t part = 0; part < parts.size(); ++part) {
        const std::span<const uint32_t> words(parts[part]);
        const size_t cells = ranges.last(part) - ranges.first(part);
        for (const uint32_t ofCell : words.first(cells)) {
            sections.first.push_back(receivers);
            receivers += ofCell;
        }
        append(sections.words, words.subspan(cells));
    }
    sections.first.push_back(receivers);
    return sections;
}

LinkTask::LinkTask(const Surroundings& surroundings, std::span<const glm::vec3> cachePlaces,
                   std::span<const glm::vec3> cacheNormals, const SurfelTree& surfelTree,
                   const BakeSettings& bakeSettings, const std::array<uint32_t, 4>& fingerprint)
    : around(surroundings), caches(cachePlaces), normals(cacheNormals), tree(surfelTree),
      settings(bakeSettings), geometry(fingerprint),
      lookup(std::span(surfelTree.nodes).first(surfelTree.order.size())), ranges(cachePlaces.size()) {}

BakeTask LinkTask::task() const {
    ContentKey key;
    key.add(geometry);
    addCounted(key, caches);
    addCounted(key, normals);
    addCounted(key, std::span(tree.nodes));
    for (const uint32_t setting :
         {settings.links, settings.bands, settings.raysPerLink, uint32_t(settings.linkForm), settings.seed})
        key.add(setting);
    return {"links", key.words(), ranges.parts(), [this](uint32_t part) { return run(part); }};
}

// Their stretches of sections linkNodes, linkFactors and linkShapes.
std::vector<uint32_t> LinkTask::run(uint32_t part) const {
    LinkSections links =
        linkCaches(around, caches, normals, ranges.first(part), ranges.last(part), tree, lookup, settings);
    std::vector<uint32_t> words = std::move(links.nodes);
    append(words, links.factors);
    append(words, links.shapes);
    return words;
}

LinkSections LinkTask::merge(BakeParts&& parts) const {
    BakeLayout layout;
    layout.links = settings.links;
    layout.bands = settings.bands;
    layout.linkForm = settings.linkForm;
    LinkSections sections;
    layout.caches = uint32_t(caches.size());
    sections.nodes.reserve(sizeOf(layout, BakeSection::linkNodes));
    sections.factors.reserve(sizeOf(layout, BakeSection::linkFactors));
    sections.shapes.reserve(sizeOf(layout, BakeSection::linkShapes));
    for (uint32_t part = 0; part < parts.size(); ++part) {
        layout.caches = ranges.last(part) - ranges.first(part);
        const size_t nodes = sizeOf(layout, BakeSection::linkNodes);
        const std::span<const uint32_t> words(parts[part]);
        append(sections.nodes, words.first(nodes));
        append(sections.factors, words.subspan(nodes, nodes));
        append(sections.shapes, words.subspan(2 * nodes));
        parts[part] = {}; // it may be all memory that there is
    }
    return sections;
}

} // namespace rebound::detail
