// SPDX-License-Identifier: MIT
// Turns the kernel that a file has just defined into a KernelEntry: every listed combination of its features, ready to run.
// Included inside the instruction set's namespace, behind the kernel.

#include "rebound/kernel/kernel_info.h"

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
void runRange(const Binding* slots, int widthOrItems, int begin, int end) {
    Kernel kernel;
    bindAll(kernel, slots, std::make_integer_sequence<int, slotCount>{});
    if constexpr (Kernel::forItems) {
        for (int i = begin; i < end; i += laneCount) kernel.run(Item{i, widthOrItems});
    } else {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < widthOrItems; x += laneCount) kernel.run(Pixel{x, y});
    }
}

template <int variant>
constexpr RunRange variantOf() {
    if constexpr (VariantOf<variant>::isListed()) return &runRange<typename VariantOf<variant>::Kernel>;
    else return nullptr;
}

template <int... variant>
constexpr auto makeVariants(std::integer_sequence<int, variant...>) {
    struct Table {
        RunRange entries[sizeof...(variant)];
    };
    return Table{{variantOf<variant>()...}};
}

static constexpr auto kernelVariants = makeVariants(std::make_integer_sequence<int, variantCount>{});
