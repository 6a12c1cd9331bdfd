// SPDX-License-Identifier: MIT
#include "rebound/bake/geometry.hpp"

#include "content_key.hpp"

namespace rebound {

std::array<uint32_t, 4> fingerprintOf(const BakeGeometry& geometry) {
    detail::ContentKey key;
    key.add(uint64_t(geometry.positions.size()));
    key.add(uint64_t(geometry.indices.size()));
    key.addAll(std::span(geometry.positions));
    key.addAll(std::span(geometry.indices));
    return key.words();
}

} // namespace rebound
