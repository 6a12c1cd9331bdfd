// SPDX-License-Identifier: MIT
// Hashes of contents, as names of what was computed from them.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace rebound::lab {

// 128 bits by XXH3.
class ContentHash {
public:
    ContentHash();
    ContentHash(ContentHash&&) noexcept;
    ContentHash& operator=(ContentHash&&) noexcept;
    ~ContentHash();

    // Of types without padding: numbers and vectors of numbers.
    template <class Value>
    void add(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        addBytes(&value, sizeof value);
    }

    // The number of values, then the values.
    template <class Value>
    void addRange(std::span<const Value> values) {
        static_assert(std::is_trivially_copyable_v<Value>);
        add(values.size());
        addBytes(values.data(), values.size_bytes());
    }

    template <class Value>
    void addRange(const std::vector<Value>& values) {
        addRange(std::span<const Value>(values));
    }

    // 32 hexadecimal digits.
    std::string digits() const;

private:
    void addBytes(const void*, size_t);

    struct State;
    std::unique_ptr<State> state;
};

} // namespace rebound::lab
