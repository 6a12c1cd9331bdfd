// SPDX-License-Identifier: MIT
// Typed values out of a glTF file's buffers. All functions throw InputError.
#pragma once

#include "lab/files/input_error.hpp"

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rebound::lab {

// An accessor that no buffer view bounds is refused beyond this number of elements.
inline constexpr size_t largestUnbackedAccessor = size_t(1) << 20;

// Items of a list by an index from the file; `what` names the item in the error.
template <class Item>
const Item& itemAt(const std::vector<Item>& items, int index, const std::string& what) {
    if (index < 0 || static_cast<size_t>(index) >= items.size())
        refuse("it refers to " + what + " " + std::to_string(index) + ", but has " +
               std::to_string(items.size()));
    return items[static_cast<size_t>(index)];
}

// The number of elements, without reading them.
size_t accessorCount(const tinygltf::Model&, int accessor);

// `components` floats an element (1 to 4, or 16 for a matrix); normalised integers become 0 to 1 or -1 to 1,
// other integers keep their value. Refuses values that are not finite.
std::vector<float> readFloats(const tinygltf::Model&, int accessor, int components);

// One non-negative integer a component: 1 for indices, 4 for joints.
std::vector<uint32_t> readIntegers(const tinygltf::Model&, int accessor, int components);

// Bytes of a buffer view.
std::span<const uint8_t> bufferViewBytes(const tinygltf::Model&, int bufferView);

} // namespace rebound::lab
