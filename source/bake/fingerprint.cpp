// SPDX-License-Identifier: MIT
#include "rebound/bake/geometry.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <memory>

namespace rebound {

std::array<uint32_t, 4> fingerprintOf(const BakeGeometry& geometry) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
    XXH3_128bits_reset(state.get());
    const uint64_t counts[2] = {geometry.positions.size(), geometry.indices.size()};
    XXH3_128bits_update(state.get(), counts, sizeof counts);
    XXH3_128bits_update(state.get(), geometry.positions.data(),
                        geometry.positions.size() * sizeof(glm::vec3));
    XXH3_128bits_update(state.get(), geometry.indices.data(), geometry.indices.size() * sizeof(uint32_t));
    const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
    return {uint32_t(hash.low64), uint32_t(hash.low64 >> 32), uint32_t(hash.high64),
            uint32_t(hash.high64 >> 32)};
}

} // namespace rebound
