// SPDX-License-Identifier: MIT
// What the kernel that a file has just defined declares, as KernelInfo. The one source of slots, kinds, formats, features
// and combinations, for CPU and GPU. Included behind the kernel, inside its namespace.

template <int id, class Kernel = ThisKernel<0, 0, 0, 0>>
constexpr int featureCountOf() {
    if constexpr (requires { Kernel::featureCount(Slot<id>{}); }) return Kernel::featureCount(Slot<id>{});
    else return 1;
}

template <int slot, class Kernel = ThisKernel<0, 0, 0, 0>>
constexpr BindingKind bindingKindOf() {
    if constexpr (requires { Kernel::kindOf(Slot<slot>{}); }) return Kernel::kindOf(Slot<slot>{});
    else return BindingKind::none;
}

template <int slot, class Kernel = ThisKernel<0, 0, 0, 0>>
constexpr size_t sizeOf() {
    if constexpr (requires { Kernel::sizeOf(Slot<slot>{}); }) return Kernel::sizeOf(Slot<slot>{});
    else return 0;
}

template <int slot, class Kernel = ThisKernel<0, 0, 0, 0>>
constexpr Format formatOf() {
    if constexpr (requires { Kernel::formatOf(Slot<slot>{}); }) return Kernel::formatOf(Slot<slot>{});
    else return Format::r32f;
}

template <int slot, class Kernel = ThisKernel<0, 0, 0, 0>>
constexpr const char* nameOf() {
    if constexpr (requires { Kernel::nameOf(Slot<slot>{}); }) return Kernel::nameOf(Slot<slot>{});
    else return nullptr;
}

template <int slot, class Kernel = ThisKernel<0, 0, 0, 0>>
constexpr uint16_t gridBitOf() {
    if constexpr (requires { Kernel::fillsGrid(Slot<slot>{}); }) return uint16_t(1u << slot);
    else return 0;
}

template <int slot, class Kernel = ThisKernel<0, 0, 0, 0>>
constexpr uint16_t sparseBitOf() {
    if constexpr (requires { Kernel::isSparse(Slot<slot>{}); }) return uint16_t(1u << slot);
    else return 0;
}

inline constexpr int variantCount =
    featureCountOf<0>() * featureCountOf<1>() * featureCountOf<2>() * featureCountOf<3>();

// The kernel with the features of a combination's number.
template <int variant>
struct VariantOf {
    static constexpr int f0 = variant % featureCountOf<0>(), r0 = variant / featureCountOf<0>();
    static constexpr int f1 = r0 % featureCountOf<1>(), r1 = r0 / featureCountOf<1>();
    static constexpr int f2 = r1 % featureCountOf<2>(), f3 = r1 / featureCountOf<2>();
    using Kernel = ThisKernel<f0, f1, f2, f3>;
    static constexpr bool isListed() {
        if constexpr (requires { Kernel::isListed(); }) return Kernel::isListed();
        else return true;
    }
};

template <int... variant>
constexpr auto makeCombinations(std::integer_sequence<int, variant...>) {
    struct Table {
        bool entries[sizeof...(variant)];
    };
    return Table{{VariantOf<variant>::isListed()...}};
}
static constexpr auto kernelCombinations = makeCombinations(std::make_integer_sequence<int, variantCount>{});

template <int... slot>
constexpr KernelInfo makeKernelInfo(std::integer_sequence<int, slot...>) {
    return {{bindingKindOf<slot>()...},
            {featureCountOf<0>(), featureCountOf<1>(), featureCountOf<2>(), featureCountOf<3>()},
            {sizeOf<slot>()...},
            {formatOf<slot>()...},
            {nameOf<slot>()...},
            uint16_t((0 | ... | gridBitOf<slot>())),
            uint16_t((0 | ... | sparseBitOf<slot>())),
            ThisKernel<0, 0, 0, 0>::forItems,
            kernelCombinations.entries};
}
static constexpr KernelInfo kernelInfo = makeKernelInfo(std::make_integer_sequence<int, slotCount>{});
