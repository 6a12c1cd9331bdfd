// SPDX-License-Identifier: MIT
// Bakes written by hand.
#pragma once

#include "rebound/bake/bake.hpp"
#include "rebound/bake/packing.hpp"
#include "rebound/bake/surfels.hpp"

#include <bit>
#include <memory>
#include <vector>

namespace rebound::lab {

// One that holds surfels and nothing else.
inline Bake surfelsOnly(const std::vector<Surfel>& surfels) {
    const uint32_t count = uint32_t(surfels.size()), stride = BakeLayout::stride(count);
    auto words = std::make_shared<std::vector<uint32_t>>(size_t(7) * stride, 0u);
    for (uint32_t i = 0; i < count; ++i) {
        const Surfel& s = surfels[i];
        const uint32_t packed[7] = {std::bit_cast<uint32_t>(s.position.x),
                                    std::bit_cast<uint32_t>(s.position.y),
                                    std::bit_cast<uint32_t>(s.position.z),
                                    packOctahedral(s.normal),
                                    std::bit_cast<uint32_t>(s.area),
                                    packAlbedo(s.albedo),
                                    packEmission(s.emission)};
        for (uint32_t k = 0; k < 7; ++k) (*words)[size_t(k) * stride + i] = packed[k];
    }
    Bake bake;
    bake.layout.surfels = bake.layout.nodes = count;
    bake.sections[size_t(BakeSection::surfels)] = *words;
    bake.storage = std::move(words);
    return bake;
}

} // namespace rebound::lab
