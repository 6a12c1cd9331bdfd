// SPDX-License-Identifier: MIT
// Buffers of numbers of the kernel language on a CPU. Included by kernel_cpu.h inside the instruction set's namespace.

// Lanes hold items first, first + 1, ... first + laneCount - 1, of which those from count on do not exist.
struct Item {
    int first, count;
};

inline Int indexOf(Item item) { return laneIndex() + Int(item.first); }
// Of the item's group of 16: the same for all lanes.
inline int groupOf(Item item) { return item.first / 16; }

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

// Any number; zero outside. Moved as bits.
inline Real loadAt(const NumberBuffer<const float>& v, Int index) {
    return realOfBits(loadIndexed(reinterpret_cast<const int32_t*>(v.data), index, v.count));
}
inline Int loadAt(const NumberBuffer<const int32_t>& v, Int index) {
    return loadIndexed(v.data, index, v.count);
}
inline UInt loadAt(const NumberBuffer<const uint32_t>& v, Int index) {
    return toUInt(loadIndexed(reinterpret_cast<const int32_t*>(v.data), index, v.count));
}

// The four numbers from 4 * index on, of a buffer that holds floats by fours; zero outside.
inline Vec4 loadFour(const NumberBuffer<const float>& v, Int index) {
    const int fours = v.count / 4;
    Real result[4];
    if (fours > 0 && allBelow(index, fours)) {
        loadFours(v.data, index, result);
    } else {
        const Mask inside = !(index < Int(0)) && index < Int(fours);
        const Int first = select(inside, index << 2, Int(-1));
        for (int c = 0; c < 4; ++c) result[c] = loadAt(v, select(inside, first + Int(c), Int(-1)));
    }
    return Vec4(result[0], result[1], result[2], result[3]);
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

// Writes the four numbers from 4 * index on of each lane whose item exists; nothing outside. No two lanes write the same.
inline void storeFour(const NumberBuffer<float>& v, Item item, Int index, const Vec4& x) {
    alignas(64) int32_t at[laneCount];
    alignas(64) float lanes[4][laneCount];
    storeLanes(at, index);
    for (int c = 0; c < 4; ++c) storeLanes(lanes[c], x[c]);
    const int fours = v.count / 4;
    for (int i = 0; i < laneCount && item.first + i < item.count; ++i)
        if (at[i] >= 0 && at[i] < fours)
            for (int c = 0; c < 4; ++c) v.data[4 * ptrdiff_t(at[i]) + c] = lanes[c][i];
}
