// SPDX-License-Identifier: MIT
#include "lab/gltf/gltf_accessors.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rebound::lab {
namespace {

// Elements at equal distances in memory; no data: all zero.
struct Elements {
    std::string name;
    const uint8_t* data = nullptr;
    size_t count = 0;
    size_t stride = 0; // [bytes]
    int componentType = 0;
    int components = 0;
    bool normalized = false;

    size_t componentSize() const {
        return static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(componentType)));
    }
    size_t elementSize() const { return componentSize() * static_cast<size_t>(components); }
};

template <class T>
T load(const uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

bool isKnownComponentType(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           type == TINYGLTF_COMPONENT_TYPE_SHORT || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT || type == TINYGLTF_COMPONENT_TYPE_FLOAT;
}

void requireComponentType(int type, const std::string& name) {
    if (!isKnownComponentType(type))
        refuse(name + " has the component type " + std::to_string(type) + ", which glTF does not know");
}

// Places elements into a buffer view, or refuses those that reach beyond its end.
void place(Elements& elements, std::span<const uint8_t> view, size_t offset) {
    const size_t size = elements.elementSize();
    if (elements.stride == 0) elements.stride = size;
    if (elements.stride < size)
        refuse(elements.name + " has elements of " + std::to_string(size) + " bytes at a stride of " +
               std::to_string(elements.stride));
    // The first comparison keeps the product of the second from overflowing.
    if (offset > view.size() || elements.count > view.size() ||
        offset + (elements.count - 1) * elements.stride + size > view.size())
        refuse(elements.name + " reads " + std::to_string(elements.count) + " elements from byte " +
               std::to_string(offset) + " of a buffer view of " + std::to_string(view.size()) + " bytes");
    elements.data = view.data() + offset;
}

Elements denseElements(const tinygltf::Model& model, int index) {
    const tinygltf::Accessor& accessor = itemAt(model.accessors, index, "accessor");
    Elements elements;
    elements.name = "accessor " + std::to_string(index);
    elements.count = accessor.count;
    elements.componentType = accessor.componentType;
    elements.components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
    elements.normalized = accessor.normalized;
    requireComponentType(elements.componentType, elements.name);
    if (elements.count == 0) refuse(elements.name + " has no elements");
    if (accessor.bufferView >= 0) {
        elements.stride = itemAt(model.bufferViews, accessor.bufferView, "buffer view").byteStride;
        place(elements, bufferViewBytes(model, accessor.bufferView), accessor.byteOffset);
    } else if (elements.count > largestUnbackedAccessor) {
        refuse(elements.name + " has " + std::to_string(elements.count) +
               " elements without a buffer view; at most " + std::to_string(largestUnbackedAccessor) +
               " are read");
    }
    return elements;
}

double component(const Elements& elements, const uint8_t* bytes) {
    const bool normalized = elements.normalized;
    switch (elements.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return normalized ? std::max(load<int8_t>(bytes) / 127.0, -1.0) : load<int8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return normalized ? load<uint8_t>(bytes) / 255.0 : load<uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return normalized ? std::max(load<int16_t>(bytes) / 32767.0, -1.0) : load<int16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return normalized ? load<uint16_t>(bytes) / 65535.0 : load<uint16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return normalized ? load<uint32_t>(bytes) / 4294967295.0 : load<uint32_t>(bytes);
    default:
        return static_cast<double>(load<float>(bytes));
    }
}

float finiteFloat(const Elements& elements, const uint8_t* bytes) {
    const float value = static_cast<float>(component(elements, bytes));
    if (!std::isfinite(value)) refuse(elements.name + " holds a value that is not finite");
    return value;
}

uint32_t integer(const Elements& elements, const uint8_t* bytes) {
    switch (elements.componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return load<uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<uint16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return load<uint32_t>(bytes);
    default:
        refuse(elements.name + " holds signed values or floats; expected unsigned integers");
    }
}

template <class Value, class Convert>
void copyElement(const Elements& from, size_t number, Value* to, const Convert& convert) {
    const uint8_t* bytes = from.data + number * from.stride;
    for (int i = 0; i < from.components; ++i)
        to[i] = convert(from, bytes + static_cast<size_t>(i) * from.componentSize());
}

template <class Value, class Convert>
void applySparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor, const Elements& dense,
                 std::vector<Value>& values, const Convert& convert) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 1 || static_cast<size_t>(sparse.count) > dense.count ||
        sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        refuse(dense.name + " has a sparse part of " + std::to_string(sparse.count) + " elements for " +
               std::to_string(dense.count));
    Elements places;
    places.name = "the list of places of " + dense.name;
    places.count = static_cast<size_t>(sparse.count);
    places.componentType = sparse.indices.componentType;
    places.components = 1;
    requireComponentType(places.componentType, places.name);
    place(places, bufferViewBytes(model, sparse.indices.bufferView),
          static_cast<size_t>(sparse.indices.byteOffset));
    Elements replacements = dense;
    replacements.count = places.count;
    replacements.stride = 0;
    place(replacements, bufferViewBytes(model, sparse.values.bufferView),
          static_cast<size_t>(sparse.values.byteOffset));
    for (size_t i = 0; i < places.count; ++i) {
        const uint32_t where = integer(places, places.data + i * places.stride);
        if (where >= dense.count)
            refuse(places.name + " names element " + std::to_string(where) + " of " +
                   std::to_string(dense.count));
        copyElement(replacements, i, values.data() + size_t(where) * static_cast<size_t>(dense.components),
                    convert);
    }
}

template <class Value, class Convert>
std::vector<Value> read(const tinygltf::Model& model, int index, int components, const Convert& convert) {
    const Elements elements = denseElements(model, index);
    if (elements.components != components)
        refuse(elements.name + " has " + std::to_string(elements.components) + " components where " +
               std::to_string(components) + " are expected");
    // Smaller matrices' columns would be padded.
    if (components > 4 && elements.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        refuse(elements.name + " holds matrices that are not of floats");
    std::vector<Value> values(elements.count * static_cast<size_t>(components), Value(0));
    if (elements.data)
        for (size_t i = 0; i < elements.count; ++i)
            copyElement(elements, i, values.data() + i * static_cast<size_t>(components), convert);
    const tinygltf::Accessor& accessor = model.accessors[static_cast<size_t>(index)];
    if (accessor.sparse.isSparse) applySparse(model, accessor, elements, values, convert);
    return values;
}

} // namespace

size_t accessorCount(const tinygltf::Model& model, int accessor) {
    return denseElements(model, accessor).count;
}

std::vector<float> readFloats(const tinygltf::Model& model, int accessor, int components) {
    return read<float>(model, accessor, components, finiteFloat);
}

std::vector<uint32_t> readIntegers(const tinygltf::Model& model, int accessor, int components) {
    return read<uint32_t>(model, accessor, components, integer);
}

std::span<const uint8_t> bufferViewBytes(const tinygltf::Model& model, int bufferView) {
    const tinygltf::BufferView& view = itemAt(model.bufferViews, bufferView, "buffer view");
    const std::vector<unsigned char>& buffer = itemAt(model.buffers, view.buffer, "buffer").data;
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
        refuse("buffer view " + std::to_string(bufferView) + " ends beyond its buffer");
    return {buffer.data() + view.byteOffset, view.byteLength};
}

} // namespace rebound::lab
