// SPDX-License-Identifier: MIT
#include "lab/scenes/content_hash.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstdio>

namespace rebound::lab {

struct ContentHash::State {
    XXH3_state_t hash;
};

ContentHash::ContentHash() : state(std::make_unique<State>()) { XXH3_128bits_reset(&state->hash); }
ContentHash::ContentHash(ContentHash&&) noexcept = default;
ContentHash& ContentHash::operator=(ContentHash&&) noexcept = default;
ContentHash::~ContentHash() = default;

void ContentHash::addBytes(const void* bytes, size_t size) { XXH3_128bits_update(&state->hash, bytes, size); }

std::string ContentHash::digits() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(&state->hash);
    char text[33];
    std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                  static_cast<unsigned long long>(hash.low64));
    return text;
}

} // namespace rebound::lab
