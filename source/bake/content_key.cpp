// SPDX-License-Identifier: MIT
#include "content_key.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <new>

namespace rebound::detail {

ContentKey::ContentKey()
    : state(XXH3_createState(), [](void* s) { XXH3_freeState(static_cast<XXH3_state_t*>(s)); }) {
    if (!state) throw std::bad_alloc();
    XXH3_128bits_reset(static_cast<XXH3_state_t*>(state.get()));
}

void ContentKey::addBytes(const void* bytes, size_t count) {
    if (count > 0) XXH3_128bits_update(static_cast<XXH3_state_t*>(state.get()), bytes, count);
}

std::array<uint32_t, 4> ContentKey::words() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(static_cast<const XXH3_state_t*>(state.get()));
    return {uint32_t(hash.low64), uint32_t(hash.low64 >> 32), uint32_t(hash.high64),
            uint32_t(hash.high64 >> 32)};
}

} // namespace rebound::detail
