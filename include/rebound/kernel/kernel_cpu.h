// SPDX-License-Identifier: MIT
// The kernel language as C++. Included inside a namespace of one instruction set, after lanes_headers.h.

#include "rebound/kernel/lanes.h"

inline float halfToFloat(uint16_t h) { return glm::unpackHalf1x16(h); }
// To the nearest, halfway cases to the even one (glm::packHalf1x16 rounds them up), and at most 65504.
inline uint16_t floatToHalf(float f) {
    const uint32_t bits = __builtin_bit_cast(uint32_t, f), magnitude = bits & 0x7fffffffu;
    uint32_t half;
    if (magnitude > 0x7f800000u) half = 0x7e00u;
    else if (magnitude >= 0x477fe000u) half = 0x7bffu; // from 65504 on the largest
    else if (magnitude < 0x38800000u) // a denormal half: where 0.5 is added, the unit is 2^-24
        half = __builtin_bit_cast(uint32_t, __builtin_bit_cast(float, magnitude) + 0.5f) - 0x3f000000u;
    else half = (magnitude - 0x38000000u + 0xfffu + ((magnitude >> 13) & 1u)) >> 13;
    return uint16_t(half | ((bits >> 16) & 0x8000u));
}

#include "rebound/kernel/lanes_x86.h"
#include "rebound/kernel/vectors_cpu.h"
#include "rebound/kernel/images_cpu.h"
#include "rebound/kernel/buffers_cpu.h"

#define RB_FUNCTION inline
// Behind the parameters of a function that uses the buffers, features and constants of the kernel that includes it.
#define RB_OF_KERNEL const
// Before a loop of a few rounds over an array: the array then lives in registers.
#if defined(__clang__)
#define RB_UNROLL _Pragma("clang loop unroll(full)")
#elif defined(__GNUC__)
#define RB_UNROLL _Pragma("GCC unroll 16")
#else
#define RB_UNROLL
#endif
#define RB_TEXTURE_ARGUMENT const TextureOfAnySize&

template <int id>
struct Slot {};

template <int id, int first, int... rest>
constexpr int featureValue() {
    if constexpr (id == 0) return first;
    else return featureValue<id - 1, rest...>();
}

// A kernel is a class template over its features' values; ThisKernel names the one that the file defines.
#define RB_KERNEL_FOR(name, items)                                                                           \
    template <int... featureValues>                                                                          \
    struct name;                                                                                             \
    template <int... featureValues>                                                                          \
    using ThisKernel = name<featureValues...>;                                                               \
    template <int... featureValues>                                                                          \
    struct name {                                                                                            \
        static constexpr bool forItems = items;
#define RB_KERNEL(name) RB_KERNEL_FOR(name, false)
#define RB_ITEM_KERNEL(name) RB_KERNEL_FOR(name, true)
#define RB_FEATURE(id, name, count)                                                                          \
    static constexpr int name = featureValue<id, featureValues...>();                                        \
    static constexpr int featureCount(Slot<id>) { return count; }
#define RB_COMBINATIONS(condition)                                                                           \
    static constexpr bool isListed() { return condition; }
#define RB_SLOT(slot, bindingKind, name)                                                                     \
    static constexpr BindingKind kindOf(Slot<slot>) { return BindingKind::bindingKind; }                     \
    static constexpr const char* nameOf(Slot<slot>) { return #name; }
#define RB_BIND(slot, bindingKind, name)                                                                     \
    RB_SLOT(slot, bindingKind, name)                                                                         \
    void bind(Slot<slot>, const Binding& binding) { name = decltype(name)(binding); }
#define RB_TEXTURE(slot, name)                                                                               \
    Texture name;                                                                                            \
    static constexpr bool fillsGrid(Slot<slot>) { return true; }                                             \
    RB_BIND(slot, texture, name)
#define RB_SPARSE_TEXTURE(slot, name)                                                                        \
    SparseTexture name;                                                                                      \
    static constexpr bool fillsGrid(Slot<slot>) { return true; }                                             \
    static constexpr bool isSparse(Slot<slot>) { return true; }                                              \
    RB_BIND(slot, texture, name)
#define RB_TEXTURE_OF_ANY_SIZE(slot, name)                                                                   \
    TextureOfAnySize name;                                                                                   \
    RB_BIND(slot, texture, name)
#define RB_INPUT(slot, name)                                                                                 \
    HostImage name;                                                                                          \
    RB_BIND(slot, input, name)
#define RB_UINT_TEXTURE(slot, name)                                                                          \
    UIntTexture name;                                                                                        \
    static constexpr bool fillsGrid(Slot<slot>) { return true; }                                             \
    RB_BIND(slot, uintTexture, name)
#define RB_UINT_INPUT(slot, name)                                                                            \
    UIntHostImage name;                                                                                      \
    RB_BIND(slot, uintInput, name)
#define RB_IMAGE(slot, format, name)                                                                         \
    ImageOf<Format::format, Texture, UIntTexture> name;                                                      \
    static constexpr Format formatOf(Slot<slot>) { return Format::format; }                                  \
    RB_BIND(slot, image, name)
#define RB_OUTPUT(slot, format, name)                                                                        \
    ImageOf<Format::format, HostImage, UIntHostImage> name;                                                  \
    static constexpr Format formatOf(Slot<slot>) { return Format::format; }                                  \
    RB_BIND(slot, output, name)
#define RB_BUFFER(slot, Type, name)                                                                          \
    const Type* name;                                                                                        \
    RB_SLOT(slot, buffer, name)                                                                              \
    static constexpr size_t sizeOf(Slot<slot>) { return sizeof(Type); }                                      \
    void bind(Slot<slot>, const Binding& binding) { name = static_cast<const Type*>(binding.data); }
#define RB_VALUES(slot, Type, name)                                                                          \
    NumberBuffer<const Type> name;                                                                           \
    static constexpr Format formatOf(Slot<slot>) { return numberFormat<Type>; }                              \
    static constexpr size_t sizeOf(Slot<slot>) { return sizeof(Type); }                                      \
    RB_BIND(slot, values, name)
#define RB_OUTPUT_VALUES(slot, Type, name)                                                                   \
    NumberBuffer<Type> name;                                                                                 \
    static constexpr Format formatOf(Slot<slot>) { return numberFormat<Type>; }                              \
    static constexpr size_t sizeOf(Slot<slot>) { return sizeof(Type); }                                      \
    RB_BIND(slot, outputValues, name)
#define RB_CONSTANTS(slot, Type, name)                                                                       \
    Type name;                                                                                               \
    RB_SLOT(slot, constants, name)                                                                           \
    static constexpr size_t sizeOf(Slot<slot>) { return sizeof(Type); }                                      \
    void bind(Slot<slot>, const Binding& binding) { name = *static_cast<const Type*>(binding.data); }
#define RB_MAIN(pixel, extent) [[gnu::flatten]] void run(const Pixel pixel) const {
#define RB_ITEM_MAIN(item, count) void run(const Item item) const {
#define RB_END_KERNEL                                                                                        \
    }                                                                                                        \
    }                                                                                                        \
    ;
