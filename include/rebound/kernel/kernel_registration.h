// SPDX-License-Identifier: MIT
// Turns the kernel that a file has just defined into a KernelEntry: every combination of its features, ready to run.
// Included inside the instruction set's namespace, behind the kernel.

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
constexpr uint16_t gridBitOf() {
    if constexpr (requires { Kernel::fillsGrid(Slot<slot>{}); }) return uint16_t(1u << slot);
    else return 0;
}

template <class Kernel, int slot>
void bindSlot(Kernel& kernel, const Binding* slots) {
    if constexpr (requires { kernel.bind(Slot<slot>{}, slots[slot]); })
        kernel.bind(Slot<slot>{}, slots[slot]);
}

template <class Kernel, int... slot>
void bindAll(Kernel& kernel, const Binding* slots, std::integer_sequence<int, slot...>) {
    (bindSlot<Kernel, slot>(kernel, slots), ...);
}

template <class Kernel>
void runRows(const Binding* slots, int width, int yBegin, int yEnd) {
    Kernel kernel;
    bindAll(kernel, slots, std::make_integer_sequence<int, slotCount>{});
    for (int y = yBegin; y < yEnd; ++y)
        for (int x = 0; x < width; x += laneCount) kernel.run(Pixel{x, y});
}

inline constexpr int variantCount =
    featureCountOf<0>() * featureCountOf<1>() * featureCountOf<2>() * featureCountOf<3>();

template <int variant>
constexpr RunRows variantOf() {
    constexpr int f0 = variant % featureCountOf<0>(), r0 = variant / featureCountOf<0>();
    constexpr int f1 = r0 % featureCountOf<1>(), r1 = r0 / featureCountOf<1>();
    constexpr int f2 = r1 % featureCountOf<2>(), f3 = r1 / featureCountOf<2>();
    return &runRows<ThisKernel<f0, f1, f2, f3>>;
}

template <int... variant>
constexpr auto makeVariants(std::integer_sequence<int, variant...>) {
    struct Table {
        RunRows entries[sizeof...(variant)];
    };
    return Table{{variantOf<variant>()...}};
}

static constexpr auto kernelVariants = makeVariants(std::make_integer_sequence<int, variantCount>{});

template <int... slot>
constexpr KernelInfo makeKernelInfo(std::integer_sequence<int, slot...>) {
    return {{bindingKindOf<slot>()...},
            {featureCountOf<0>(), featureCountOf<1>(), featureCountOf<2>(), featureCountOf<3>()},
            {sizeOf<slot>()...},
            uint16_t((0 | ... | gridBitOf<slot>()))};
}
static constexpr KernelInfo kernelInfo = makeKernelInfo(std::make_integer_sequence<int, slotCount>{});
