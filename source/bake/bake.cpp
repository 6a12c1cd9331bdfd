// SPDX-License-Identifier: MIT
#include "rebound/bake/bake.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace rebound {

namespace {

constexpr uint32_t noCache = 0xffffffffu;

using detail::wrongBake;

std::string numberName(BakeSection section, size_t index) {
    return "number " + std::to_string(index) + " of section " + name(section);
}

// That each number is at most `last`, or `alsoAllowed`.
Result<> validateIndices(BakeSection section, std::span<const uint32_t> values, size_t firstNumber,
                         uint32_t last, uint32_t alsoAllowed) {
    bool good = true; // no early exit: a loop that compilers turn into vector instructions
    for (const uint32_t value : values) good &= value <= last || value == alsoAllowed;
    if (good) return {};
    const auto bad = std::find_if(values.begin(), values.end(),
                                  [&](uint32_t value) { return value > last && value != alsoAllowed; });
    return wrongBake(numberName(section, firstNumber + size_t(bad - values.begin())), std::to_string(*bad),
                     "at most " + std::to_string(last));
}

bool isFiniteNumber(uint32_t bits) { return (bits & 0x7f800000u) != 0x7f800000u; }

// That each is a finite float, and not negative where that is asked for.
Result<> validateNumbers(BakeSection section, std::span<const uint32_t> values, bool signedNumbers) {
    const uint32_t sign = signedNumbers ? 0u : 0x80000000u;
    bool good = true;
    for (const uint32_t value : values) good &= isFiniteNumber(value) && (value & sign) == 0;
    if (good) return {};
    const auto bad = std::find_if(values.begin(), values.end(), [&](uint32_t value) {
        return !isFiniteNumber(value) || (value & sign) != 0;
    });
    float number;
    std::memcpy(&number, &*bad, sizeof number);
    return wrongBake(numberName(section, size_t(bad - values.begin())), std::to_string(number),
                     signedNumbers ? "a finite number" : "a finite number of at least 0");
}

Result<> validateSurfels(const Bake& bake) {
    const std::span<const uint32_t> surfels = bake.section(BakeSection::surfels);
    const size_t stride = BakeLayout::stride(bake.layout.surfels);
    if (auto places = validateNumbers(BakeSection::surfels, surfels.first(3 * stride), true); !places)
        return places;
    const std::span<const uint32_t> areas = surfels.subspan(4 * stride, stride);
    for (size_t i = 0; i < stride; ++i)
        if (!isFiniteNumber(areas[i]) || (areas[i] & 0x80000000u))
            return wrongBake("area of surfel " + std::to_string(i), "not finite or negative",
                             "a finite area");
    return {};
}

Result<> validateTerms(const Bake& bake) {
    const BakeLayout& l = bake.layout;
    for (uint32_t s = 0; s < l.stages; ++s) {
        const BakeStage& stage = l.stage[s];
        const size_t count = size_t(stage.terms) * BakeLayout::stride(stage.nodes);
        auto terms = validateIndices(BakeSection::terms,
                                     bake.section(BakeSection::terms).subspan(stage.firstTerm, count),
                                     stage.firstTerm, stage.firstNode - 1, l.nodes);
        if (!terms) return terms;
    }
    return {};
}

Result<> validateCells(const Bake& bake) {
    const BakeLayout& l = bake.layout;
    const std::span<const uint32_t> cells = bake.section(BakeSection::cells);
    for (size_t c = 0; c < l.cells; ++c) {
        const std::span<const uint32_t> cell = cells.subspan(12 * c, 12);
        if (auto corners =
                validateIndices(BakeSection::cells, cell.first(8), 12 * c, l.gridCaches() - 1, noCache);
            !corners)
            return corners;
        for (int axis = 0; axis < 3; ++axis)
            if (const uint32_t place = cell[8] >> (10 * axis) & 1023u; place >= 4 * l.bricks[axis])
                return wrongBake("place of cell " + std::to_string(c),
                                 std::to_string(place) + " along axis " + std::to_string(axis),
                                 "less than " + std::to_string(4 * l.bricks[axis]));
        if (uint64_t(cell[9]) + cell[10] > l.receivers)
            return wrongBake("last receiver of cell " + std::to_string(c),
                             std::to_string(uint64_t(cell[9]) + cell[10]),
                             "at most " + std::to_string(l.receivers));
    }
    return {};
}

Result<> validateMapTexels(const Bake& bake) {
    const BakeLayout& l = bake.layout;
    const std::span<const uint32_t> texels = bake.section(BakeSection::mapTexels);
    for (size_t i = 0; i < texels.size(); ++i)
        if (const uint32_t cache = texels[i] & 0xffffffu;
            cache != BakeLayout::noMapCache && (cache < l.gridCaches() || cache >= l.caches))
            return wrongBake(
                numberName(BakeSection::mapTexels, i), "the texel of cache " + std::to_string(cache),
                "one of " + std::to_string(l.gridCaches()) + " to " + std::to_string(l.caches - 1));
    return {};
}

} // namespace

Result<> validate(const Bake& bake) {
    const BakeLayout& l = bake.layout;
    if (auto layout = validate(l); !layout) return layout;
    for (int i = 0; i < bakeSectionCount; ++i) {
        const BakeSection section{i};
        if (bake.section(section).size() != sizeOf(l, section))
            return wrongBake(std::string("section ") + name(section),
                             std::to_string(bake.section(section).size()) + " numbers long",
                             std::to_string(sizeOf(l, section)));
    }
    if (auto surfels = validateSurfels(bake); !surfels) return surfels;
    if (auto terms = validateTerms(bake); !terms) return terms;
    struct Indices {
        BakeSection section;
        uint32_t last;
    };
    for (const Indices& i : {Indices{BakeSection::linkNodes, l.nodes},
                             {BakeSection::bricks, l.filledBricks - 1},
                             {BakeSection::brickCells, l.cells - 1}})
        if (auto indices = validateIndices(i.section, bake.section(i.section), 0, i.last, i.last); !indices)
            return indices;
    for (const BakeSection section : {BakeSection::linkFactors, BakeSection::places})
        if (auto numbers = validateNumbers(section, bake.section(section), section == BakeSection::places);
            !numbers)
            return numbers;
    if (auto texels = validateMapTexels(bake); !texels) return texels;
    return validateCells(bake);
}

} // namespace rebound
