// SPDX-License-Identifier: MIT
// Images of the kernel language on a CPU. Included by kernel_cpu.h inside the instruction set's namespace.

// Lanes hold x, x + 1, ... x + laneCount - 1.
struct Pixel {
    int x, y;
};

inline Vec2 pixelCenter(Pixel p) {
    return Vec2(toReal(laneIndex()) + (float(p.x) + 0.5f), Real(float(p.y) + 0.5f));
}

// Every other pixel of a row, so that all lanes lie in columns of one parity: x, x + 2, ...
struct SparsePixel {
    int x, y;
};

// Of two neighbouring vectors of lanes the first takes the even columns of both, the second the odd ones; a first vector
// without a second takes both in turn.
inline int sparseCount(Pixel p, int width) {
    const bool isFirst = p.x % (2 * laneCount) == 0;
    return isFirst && p.x + laneCount >= width ? 2 : 1;
}
inline SparsePixel sparsePixel(Pixel p, int turn) {
    const int start = p.x / (2 * laneCount) * (2 * laneCount);
    return {p.x == start ? start + turn : start + 1, p.y};
}
inline int columnOf(SparsePixel p) { return p.x; }
inline int rowOf(SparsePixel p) { return p.y; }

inline Vec2 pixelCenter(SparsePixel p) {
    return Vec2(toReal(laneIndex()) * 2.0f + (float(p.x) + 0.5f), Real(float(p.y) + 0.5f));
}

// Rebound's own image: a plane a channel, zero in the padding around the rows. Absent channels repeat channel 0.
struct TextureOfAnySize {
    float* plane[4];
    int width, height, channels;
    bool holdsHalves;
    ptrdiff_t rowStride; // [floats]
    ptrdiff_t
        oddColumns; // from an even column's texel to the odd one behind it; 0: columns lie in order [floats]

    TextureOfAnySize() = default;
    explicit TextureOfAnySize(const Binding& b)
        : width(b.width), height(b.height), channels(b.channels), holdsHalves(b.holdsHalves),
          rowStride(b.rowStride / ptrdiff_t(sizeof(float))),
          oddColumns(b.oddColumns / ptrdiff_t(sizeof(float))) {
        for (int c = 0; c < 4; ++c)
            plane[c] = static_cast<float*>(b.data) +
                       (c < b.channels ? c * (b.channelStride / ptrdiff_t(sizeof(float))) : 0);
    }
    bool isApart() const { return oddColumns != 0; }
    ptrdiff_t inOrder(int x, int y) const { return y * rowStride + x; }
    ptrdiff_t apart(int x, int y) const { return y * rowStride + (x >> 1) + ((x & 1) != 0 ? oddColumns : 0); }
    ptrdiff_t index(int x, int y) const { return isApart() ? apart(x, y) : inOrder(x, y); }
};

// One that has a texel at every pixel of the grid: devices see to it.
struct Texture : TextureOfAnySize {
    using TextureOfAnySize::TextureOfAnySize;
};

// The same, read by sparse pixels: devices keep its even and its odd columns apart.
struct SparseTexture : TextureOfAnySize {
    using TextureOfAnySize::TextureOfAnySize;
};

// A Real for each channel, made by load(plane of that channel).
template <class Load>
Vec4 eachChannel(const TextureOfAnySize& t, Load load) {
    return Vec4(load(t.plane[0]), load(t.plane[1]), load(t.plane[2]), load(t.plane[3]));
}

// True where some lane of pixel + offset lies inside: if false, every lane's fetchOffset is zero.
inline bool reaches(const TextureOfAnySize& t, Pixel p, ivec2 o) {
    const int x = p.x + o.x, y = p.y + o.y;
    return unsigned(y) < unsigned(t.height) && x > -laneCount && x < t.width;
}

inline Vec4 fetchInside(const TextureOfAnySize& t, int x, int y) {
    if (t.isApart()) {
        const ptrdiff_t first = t.apart(x, y), second = t.apart(x + 1, y);
        return eachChannel(t, [=](const float* plane) { return loadInTurns(plane + first, plane + second); });
    }
    const ptrdiff_t i = t.inOrder(x, y);
    return eachChannel(t, [=](const float* plane) { return loadLanes(plane + i); });
}

// This pixel's texel.
inline Vec4 fetch(const Texture& t, Pixel p) { return fetchInside(t, p.x, p.y); }

// The texel at pixel + a uniform offset; zero outside.
inline Vec4 fetchOffset(const TextureOfAnySize& t, Pixel p, ivec2 o) {
    return reaches(t, p, o) ? fetchInside(t, p.x + o.x, p.y + o.y) : Vec4(Real(0.0f));
}

// The texel at 2 * pixel + offset, for offsets of -2 to 3; zero outside.
inline Vec4 fetchMinified(const TextureOfAnySize& t, Pixel p, ivec2 o) {
    const int x = 2 * p.x + o.x, y = 2 * p.y + o.y;
    if (unsigned(y) >= unsigned(t.height) || x >= t.width) return Vec4(Real(0.0f));
    if (t.isApart()) {
        const ptrdiff_t i = t.apart(x, y);
        return eachChannel(t, [=](const float* plane) { return loadLanes(plane + i); });
    }
    const ptrdiff_t i = t.inOrder(x, y);
    return eachChannel(t, [=](const float* plane) { return loadEveryOther(plane + i, 0); });
}

// The texel at ((pixel + bias) >> shift) + offset, for biases of 0 to 2^shift and offsets of -1 to 1; zero outside.
inline Vec4 fetchMagnified(const TextureOfAnySize& t, Pixel p, ivec2 bias, int shift, ivec2 o) {
    const int x = ((p.x + bias.x) >> shift) + o.x, y = ((p.y + bias.y) >> shift) + o.y;
    const int phase = (p.x + bias.x) & ((1 << shift) - 1);
    if (unsigned(y) >= unsigned(t.height) || x > t.width) return Vec4(Real(0.0f));
    if (t.isApart()) {
        const ptrdiff_t first = t.apart(x, y), second = t.apart(x + 1, y);
        return eachChannel(t, [=](const float* plane) {
            return loadRepeatedInTurns(plane + first, plane + second, phase, shift);
        });
    }
    const ptrdiff_t i = t.inOrder(x, y);
    return eachChannel(t, [=](const float* plane) { return loadRepeated(plane + i, phase, shift); });
}

// True where some lane of pixel + offset lies inside: if false, every lane's fetchOffset is zero.
inline bool reaches(const SparseTexture& t, SparsePixel p, ivec2 o) {
    const int x = p.x + o.x, y = p.y + o.y;
    return unsigned(y) < unsigned(t.height) && x > -2 * laneCount && x < t.width;
}

inline Vec4 fetchInsideSparse(const SparseTexture& t, int x, int y) {
    const ptrdiff_t i = t.apart(x, y);
    return eachChannel(t, [=](const float* plane) { return loadLanes(plane + i); });
}
inline Vec4 fetch(const SparseTexture& t, SparsePixel p) { return fetchInsideSparse(t, p.x, p.y); }
inline Vec4 fetchOffset(const SparseTexture& t, SparsePixel p, ivec2 o) {
    return reaches(t, p, o) ? fetchInsideSparse(t, p.x + o.x, p.y + o.y) : Vec4(Real(0.0f));
}

// Any texel, lane by lane; zero outside. The slowest access on a CPU.
inline Vec4 fetchAt(const TextureOfAnySize& t, IVec2 at) {
    alignas(64) int32_t x[laneCount], y[laneCount];
    alignas(64) float lanes[4][laneCount];
    storeLanes(x, at.x);
    storeLanes(y, at.y);
    for (int i = 0; i < laneCount; ++i) {
        const bool inside = unsigned(x[i]) < unsigned(t.width) && unsigned(y[i]) < unsigned(t.height);
        for (int c = 0; c < 4; ++c) lanes[c][i] = inside ? t.plane[c][t.index(x[i], y[i])] : 0.0f;
    }
    return Vec4(loadLanes(lanes[0]), loadLanes(lanes[1]), loadLanes(lanes[2]), loadLanes(lanes[3]));
}

// What an image holds of a value: a GPU's, which may be of half floats, ends where those do.
inline Real stored(const Texture& t, Real a) { return t.holdsHalves ? withinHalves(a) : a; }

// Calls write(plane, value) for each channel that the image has.
template <class Write>
void writeChannels(const Texture& t, const Vec4& v, Write write) {
    write(t.plane[0], stored(t, v.x));
    if (t.channels > 1) write(t.plane[1], stored(t, v.y));
    if (t.channels > 2) write(t.plane[2], stored(t, v.z));
    if (t.channels > 3) write(t.plane[3], stored(t, v.w));
}

// Lanes beyond the right side land in the padding; the backend clears it when the row is done.
inline void store(const Texture& t, Pixel p, const Vec4& v) {
    if (t.isApart()) {
        const ptrdiff_t first = t.apart(p.x, p.y), second = t.apart(p.x + 1, p.y);
        writeChannels(t, v, [=](float* plane, Real a) { storeInTurns(plane + first, plane + second, a); });
    } else {
        const ptrdiff_t i = t.inOrder(p.x, p.y);
        writeChannels(t, v, [=](float* plane, Real a) { storeLanes(plane + i, a); });
    }
}

// In order, another vector's pixels lie between the lanes.
inline void store(const Texture& t, SparsePixel p, const Vec4& v) {
    if (t.isApart()) {
        const ptrdiff_t i = t.apart(p.x, p.y);
        writeChannels(t, v, [=](float* plane, Real a) { storeLanes(plane + i, a); });
        return;
    }
    const ptrdiff_t row = t.inOrder(0, p.y);
    writeChannels(t, v, [&](float* plane, Real a) {
        alignas(64) float lanes[laneCount];
        storeLanes(lanes, a);
        for (int i = 0, x = p.x; i < laneCount && x < t.width; ++i, x += 2) plane[row + x] = lanes[i];
    });
}

// The host's image, in whatever layout the host keeps it.
struct HostImage {
    Binding image;

    HostImage() = default;
    explicit HostImage(const Binding& b) : image(b) {}

    char* address(int channel, int x, int y) const {
        return static_cast<char*>(image.data) + channel * image.channelStride + y * image.rowStride +
               x * image.pixelStride;
    }
    // Loads ask for what lies so far ahead: a kernel reads more rows at a time than processors follow by themselves.
    static constexpr int prefetchDistance = 512; // [bytes]
    bool contiguous() const { return image.pixelStride == (image.isHalf ? 2 : 4); }

    // Whether lanes x, x + step, ... of a row lie in one piece, from the first of step pixels to the last.
    bool isInOnePiece(int x, int y, int step) const {
        return contiguous() && x >= 0 && x + step * laneCount <= image.width &&
               unsigned(y) < unsigned(image.height);
    }

    // Lanes x, x + step, ... of every channel; zero outside. step: 1, 2 or 4.
    Vec4 load(int x, int y, int step) const {
        const int first = x & (step - 1);
        if (!isInOnePiece(x - first, y, step)) return loadOneByOne(x, y, step);
        const char* from = address(0, x - first, y);
        if (image.isHalf)
            return eachChannel(from, [=](const char* p) {
                __builtin_prefetch(p + prefetchDistance + 64 * first);
                const uint16_t* h = reinterpret_cast<const uint16_t*>(p);
                if (step == 4) return loadEveryFourthHalf(h, first);
                return step == 2 ? loadEveryOtherHalf(h, first) : loadHalves(h);
            });
        return eachChannel(from, [=](const char* p) {
            __builtin_prefetch(p + prefetchDistance + 64 * first);
            const float* f = reinterpret_cast<const float*>(p);
            if (step == 4) return loadEveryFourth(f, first);
            return step == 2 ? loadEveryOther(f, first) : loadLanes(f);
        });
    }

    // Any pixel, lane by lane; zero outside.
    Vec4 loadAt(IVec2 at) const {
        alignas(64) int32_t x[laneCount], y[laneCount];
        storeLanes(x, at.x);
        storeLanes(y, at.y);
        alignas(64) float lanes[4][laneCount] = {};
        for (int i = 0; i < laneCount; ++i)
            if (unsigned(x[i]) < unsigned(image.width) && unsigned(y[i]) < unsigned(image.height))
                for (int c = 0; c < image.channels; ++c) lanes[c][i] = numberAt(address(c, x[i], y[i]));
        return Vec4(loadLanes(lanes[0]), loadLanes(lanes[1]), loadLanes(lanes[2]), loadLanes(lanes[3]));
    }

    void storeLanesOf(Pixel p, const Vec4& v) const {
        if (!isInOnePiece(p.x, p.y, 1)) {
            storeOneByOne(p, v);
        } else if (image.isHalf) {
            eachChannel(address(0, p.x, p.y), v, [](char* to, Real a) {
                storeHalves(reinterpret_cast<uint16_t*>(to), a); // which ends where halves do
            });
        } else {
            const bool holdsHalves = image.holdsHalves;
            eachChannel(address(0, p.x, p.y), v, [=](char* to, Real a) {
                storeLanes(reinterpret_cast<float*>(to), holdsHalves ? withinHalves(a) : a);
            });
        }
    }

private:
    float numberAt(const char* from) const {
        if (image.isHalf) {
            uint16_t half;
            __builtin_memcpy(&half, from, sizeof half);
            return halfToFloat(half);
        }
        float number;
        __builtin_memcpy(&number, from, sizeof number);
        return number;
    }
    template <class Load>
    Vec4 eachChannel(const char* first, Load loadFrom) const {
        const Real zero(0.0f);
        return Vec4(loadFrom(first), image.channels > 1 ? loadFrom(first + image.channelStride) : zero,
                    image.channels > 2 ? loadFrom(first + 2 * image.channelStride) : zero,
                    image.channels > 3 ? loadFrom(first + 3 * image.channelStride) : zero);
    }
    template <class Store>
    void eachChannel(char* first, const Vec4& v, Store storeTo) const {
        storeTo(first, v.x);
        if (image.channels > 1) storeTo(first + image.channelStride, v.y);
        if (image.channels > 2) storeTo(first + 2 * image.channelStride, v.z);
        if (image.channels > 3) storeTo(first + 3 * image.channelStride, v.w);
    }
    // Sides of the image, and layouts whose pixels lie apart.
    [[gnu::noinline]] Vec4 loadOneByOne(int x, int y, int step) const {
        if (unsigned(y) >= unsigned(image.height)) return Vec4(Real(0.0f));
        const char* row = address(0, 0, y);
        if (image.isHalf && isInterleaved(x, y, step)) {
            const uint16_t* h = reinterpret_cast<const uint16_t*>(row + x * image.pixelStride);
            return Vec4(loadEveryFourthHalf(h, 0), loadEveryFourthHalf(h, 1), loadEveryFourthHalf(h, 2),
                        image.channels > 3 ? loadEveryFourthHalf(h, 3) : Real(0.0f));
        }
        return eachChannel(row, [=, this](const char* channel) {
            if (image.isHalf) {
                alignas(64) uint16_t lanes[laneCount] = {};
                collect(channel, x, step, lanes);
                return loadHalves(lanes);
            }
            alignas(64) float lanes[laneCount] = {};
            collect(channel, x, step, lanes);
            return loadLanes(lanes);
        });
    }
    // Whether lanes x, x + 1, ... lie in one piece of four halves a pixel, with nothing behind the image to be read.
    bool isInterleaved(int x, int y, int step) const {
        const bool hasPixelBehind = x + laneCount < image.width || y + 1 < image.height;
        return step == 1 && image.pixelStride == 8 && image.channelStride == 2 && image.rowStride > 0 &&
               x >= 0 && x + laneCount <= image.width && (image.channels == 4 || hasPixelBehind);
    }
    template <class Number>
    void collect(const char* row, int x, int step, Number* lanes) const {
        for (int i = 0, xi = x; i < laneCount; ++i, xi += step)
            if (unsigned(xi) < unsigned(image.width))
                __builtin_memcpy(&lanes[i], row + xi * image.pixelStride, sizeof(Number));
    }
    [[gnu::noinline]] void storeOneByOne(Pixel p, const Vec4& v) const {
        eachChannel(address(0, p.x, p.y), v, [=, this](char* to, Real a) {
            if (image.isHalf) {
                alignas(64) uint16_t lanes[laneCount];
                storeHalves(lanes, a);
                distribute(to, p, lanes);
            } else {
                alignas(64) float lanes[laneCount];
                storeLanes(lanes, image.holdsHalves ? withinHalves(a) : a);
                distribute(to, p, lanes);
            }
        });
    }
    template <class Number>
    void distribute(char* to, Pixel p, const Number* lanes) const {
        for (int i = 0; i < laneCount && p.x + i < image.width; ++i)
            __builtin_memcpy(to + i * image.pixelStride, &lanes[i], sizeof(Number));
    }
};

inline Vec4 fetch(const HostImage& t, Pixel p) { return t.load(p.x, p.y, 1); }
inline Vec4 fetchOffset(const HostImage& t, Pixel p, ivec2 o) { return t.load(p.x + o.x, p.y + o.y, 1); }
inline Vec4 fetchMinified(const HostImage& t, Pixel p, ivec2 o) {
    return t.load(2 * p.x + o.x, 2 * p.y + o.y, 2);
}
// The pixel at 4 * pixel + offset, for offsets of 0 to 3.
inline Vec4 fetchQuarter(const HostImage& t, Pixel p, ivec2 o) {
    return t.load(4 * p.x + o.x, 4 * p.y + o.y, 4);
}
// Any pixel; zero outside. The slowest access on a CPU.
inline Vec4 fetchAt(const HostImage& t, IVec2 at) { return t.loadAt(at); }
inline void store(const HostImage& t, Pixel p, const Vec4& v) { t.storeLanesOf(p, v); }

// Images of unsigned integers lie in memory as floats of the same bits.
template <class Image>
struct UIntImage {
    Image image;

    UIntImage() = default;
    explicit UIntImage(const Binding& b) : image(b) {}
};
using UIntTexture = UIntImage<Texture>;
using UIntHostImage = UIntImage<HostImage>;

inline UVec4 bitsOfLanes(const Vec4& v) {
    return UVec4(floatBitsToUint(v.x), floatBitsToUint(v.y), floatBitsToUint(v.z), floatBitsToUint(v.w));
}

template <class Image>
UVec4 fetch(const UIntImage<Image>& t, Pixel p) {
    return bitsOfLanes(fetch(t.image, p));
}
template <class Image>
UVec4 fetchOffset(const UIntImage<Image>& t, Pixel p, ivec2 o) {
    return bitsOfLanes(fetchOffset(t.image, p, o));
}
inline UVec4 fetchAt(const UIntTexture& t, IVec2 at) { return bitsOfLanes(fetchAt(t.image, at)); }
template <class Image>
void store(const UIntImage<Image>& t, Pixel p, const UVec4& v) {
    store(t.image, p,
          Vec4(uintBitsToFloat(v.x), uintBitsToFloat(v.y), uintBitsToFloat(v.z), uintBitsToFloat(v.w)));
}

template <Format format, class OfFloats, class OfUInts>
using ImageOf = std::conditional_t<format == Format::r32ui || format == Format::rgba32ui, OfUInts, OfFloats>;
