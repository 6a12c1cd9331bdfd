// SPDX-License-Identifier: MIT
// XXH3, 128 bits, of many things one behind the other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

namespace rebound::detail {

class ContentKey {
public:
    ContentKey();

    // Values without gaps between their members.
    template <class T>
    void add(const T& value) {
        static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
        addBytes(&value, sizeof value);
    }
    // Their number is not added.
    template <class T>
    void addAll(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        addBytes(values.data(), values.size_bytes());
    }

    std::array<uint32_t, 4> words() const; // low half first

private:
    void addBytes(const void*, size_t);

    std::unique_ptr<void, void (*)(void*)> state;
};

} // namespace rebound::detail
