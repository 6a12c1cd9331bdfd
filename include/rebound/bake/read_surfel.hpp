// SPDX-License-Identifier: MIT
// A bake's surfels, one at a time, for engines that light them on the host.
#pragma once

#include "rebound/bake/bake.hpp"
#include "rebound/bake/packing.hpp"
#include "rebound/bake/surfels.hpp"

#include <bit>

namespace rebound {

// Precondition: the bake is valid, and index < bake.layout.surfels.
inline Surfel surfelOf(const Bake& bake, uint32_t index) {
    const uint32_t stride = BakeLayout::stride(bake.layout.surfels);
    const auto words = bake.section(BakeSection::surfels);
    const auto word = [&](uint32_t k) { return words[size_t(k) * stride + index]; };
    const auto number = [&](uint32_t k) { return std::bit_cast<float>(word(k)); };
    return {{number(0), number(1), number(2)},
            unpackOctahedral(word(3)),
            number(4),
            unpackAlbedo(word(5)),
            unpackEmission(word(6))};
}

} // namespace rebound
