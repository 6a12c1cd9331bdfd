// SPDX-License-Identifier: MIT
// Buffers of numbers of the kernel language on a CPU. Included by kernel_cpu.h inside the instruction set's namespace.

// Lanes hold items first, first + 1, ... first + laneCount - 1, of which those from count on do not exist.
struct Item {
    int first, count;
};

inline Int indexOf(Item item) { return laneIndex() + Int(item.first); }

// A pixel's place in a buffer that holds rows of so many numbers, one behind the other.
inline Item itemOf(Pixel p, int width) { return {p.y * width + p.x, p.y * width + width}; }

template <class T>
struct LanesOf;
template <>
struct LanesOf<float> {
    using Type = Real;
};
template <>
struct LanesOf<int32_t> {
    using Type = Int;
};
template <>
struct LanesOf<uint32_t> {
    using Type = UInt;
};

template <class T>
inline constexpr Format numberFormat = std::is_integral_v<T> ? Format::r32ui : Format::r32f;

// T: float, int or uint; const where it is read.
template <class T>
struct NumberBuffer {
    using Number = std::remove_const_t<T>;
    using Lanes = typename LanesOf<Number>::Type;
    T* data;
    int count;

    NumberBuffer() = default;
    explicit NumberBuffer(const Binding& b) : data(static_cast<T*>(b.data)), count(int(b.size / sizeof(T))) {}
    // The same number for all lanes; index lies inside.
    const T& operator[](int index) const { return data[index]; }
};

// The numbers at item + offset; zero outside.
template <class T>
typename NumberBuffer<T>::Lanes loadOffset(const NumberBuffer<T>& v, Item item, int offset) {
    const int from = item.first + offset;
    if (from >= 0 && from <= v.count - laneCount) return loadLanes(v.data + from);
    alignas(64) typename NumberBuffer<T>::Number lanes[laneCount];
    for (int i = 0; i < laneCount; ++i) {
        const int at = from + i;
        lanes[i] = at >= 0 && at < v.count ? v.data[at] : typename NumberBuffer<T>::Number(0);
    }
    return loadLanes(lanes);
}
template <class T>
typename NumberBuffer<T>::Lanes loadItem(const NumberBuffer<T>& v, Item item) {
    return loadOffset(v, item, 0);
}

// Any number, lane by lane; zero outside.
template <class T>
typename NumberBuffer<T>::Lanes loadAt(const NumberBuffer<T>& v, Int index) {
    alignas(64) int32_t at[laneCount];
    alignas(64) typename NumberBuffer<T>::Number lanes[laneCount];
    storeLanes(at, index);
    for (int i = 0; i < laneCount; ++i)
        lanes[i] = at[i] >= 0 && at[i] < v.count ? v.data[at[i]] : typename NumberBuffer<T>::Number(0);
    return loadLanes(lanes);
}

// Writes the number at item + offset, for items that exist; nothing outside.
template <class T>
void storeOffset(const NumberBuffer<T>& v, Item item, int offset, typename NumberBuffer<T>::Lanes x) {
    const int from = item.first + offset;
    if (item.count - item.first >= laneCount && from >= 0 && from <= v.count - laneCount) {
        storeLanes(v.data + from, x);
        return;
    }
    alignas(64) T lanes[laneCount];
    storeLanes(lanes, x);
    for (int i = 0; i < laneCount && item.first + i < item.count; ++i)
        if (from + i >= 0 && from + i < v.count) v.data[from + i] = lanes[i];
}
template <class T>
void storeItem(const NumberBuffer<T>& v, Item item, typename NumberBuffer<T>::Lanes x) {
    storeOffset(v, item, 0, x);
}

// Writes the number at an index of each lane whose item exists; nothing outside. No two lanes write the same.
template <class T>
void storeAt(const NumberBuffer<T>& v, Item item, Int index, typename NumberBuffer<T>::Lanes x) {
    alignas(64) int32_t at[laneCount];
    alignas(64) T lanes[laneCount];
    storeLanes(at, index);
    storeLanes(lanes, x);
    for (int i = 0; i < laneCount && item.first + i < item.count; ++i)
        if (at[i] >= 0 && at[i] < v.count) v.data[at[i]] = lanes[i];
}
