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

    TextureOfAnySize() = default;
    explicit TextureOfAnySize(const Binding& b)
        : width(b.width), height(b.height), channels(b.channels), holdsHalves(b.holdsHalves),
          rowStride(b.rowStride / ptrdiff_t(sizeof(float))) {
        for (int c = 0; c < 4; ++c)
            plane[c] = static_cast<float*>(b.data) +
                       (c < b.channels ? c * (b.channelStride / ptrdiff_t(sizeof(float))) : 0);
    }
    ptrdiff_t index(int x, int y) const { return y * rowStride + x; }
};

// One that has a texel at every pixel of the grid: devices see to it.
struct Texture : TextureOfAnySize {
    using TextureOfAnySize::TextureOfAnySize;
};

// True where some lane of pixel + offset lies inside: if false, every lane's fetchOffset is zero.
inline bool reaches(const TextureOfAnySize& t, Pixel p, ivec2 o) {
    const int x = p.x + o.x, y = p.y + o.y;
    return unsigned(y) < unsigned(t.height) && x > -laneCount && x < t.width;
}

inline Vec4 fetchInside(const TextureOfAnySize& t, int x, int y) {
    const ptrdiff_t i = t.index(x, y);
    return Vec4(loadLanes(t.plane[0] + i), loadLanes(t.plane[1] + i), loadLanes(t.plane[2] + i),
                loadLanes(t.plane[3] + i));
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
    const ptrdiff_t i = t.index(x, y);
    return Vec4(loadEveryOther(t.plane[0] + i), loadEveryOther(t.plane[1] + i),
                loadEveryOther(t.plane[2] + i), loadEveryOther(t.plane[3] + i));
}

// The texel at ((pixel + bias) >> shift) + offset, for biases of 0 to 2^shift and offsets of -1 to 1; zero outside.
inline Vec4 fetchMagnified(const TextureOfAnySize& t, Pixel p, ivec2 bias, int shift, ivec2 o) {
    const int x = (p.x + bias.x) >> shift, y = ((p.y + bias.y) >> shift) + o.y;
    const int phase = (p.x + bias.x) & ((1 << shift) - 1);
    if (unsigned(y) >= unsigned(t.height) || x + o.x > t.width) return Vec4(Real(0.0f));
    const ptrdiff_t i = t.index(x + o.x, y);
    return Vec4(loadRepeated(t.plane[0] + i, phase, shift), loadRepeated(t.plane[1] + i, phase, shift),
                loadRepeated(t.plane[2] + i, phase, shift), loadRepeated(t.plane[3] + i, phase, shift));
}

// True where some lane of pixel + offset lies inside: if false, every lane's fetchOffset is zero.
inline bool reaches(const Texture& t, SparsePixel p, ivec2 o) {
    const int x = p.x + o.x, y = p.y + o.y;
    return unsigned(y) < unsigned(t.height) && x > -2 * laneCount && x < t.width;
}

inline Vec4 fetchInsideSparse(const Texture& t, int x, int y) {
    const ptrdiff_t i = t.index(x, y);
    return Vec4(loadEveryOther(t.plane[0] + i), loadEveryOther(t.plane[1] + i),
                loadEveryOther(t.plane[2] + i), loadEveryOther(t.plane[3] + i));
}
inline Vec4 fetch(const Texture& t, SparsePixel p) { return fetchInsideSparse(t, p.x, p.y); }
inline Vec4 fetchOffset(const Texture& t, SparsePixel p, ivec2 o) {
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

// Lanes beyond the right side land in the padding; the backend clears it when the row is done.
inline void store(const Texture& t, Pixel p, const Vec4& v) {
    const ptrdiff_t i = t.index(p.x, p.y);
    storeLanes(t.plane[0] + i, stored(t, v.x));
    if (t.channels > 1) storeLanes(t.plane[1] + i, stored(t, v.y));
    if (t.channels > 2) storeLanes(t.plane[2] + i, stored(t, v.z));
    if (t.channels > 3) storeLanes(t.plane[3] + i, stored(t, v.w));
}

// Between the lanes lie another vector's pixels.
inline void store(const Texture& t, SparsePixel p, const Vec4& v) {
    alignas(64) float lanes[4][laneCount];
    storeLanes(lanes[0], stored(t, v.x));
    storeLanes(lanes[1], stored(t, v.y));
    storeLanes(lanes[2], stored(t, v.z));
    storeLanes(lanes[3], stored(t, v.w));
    for (int c = 0; c < t.channels; ++c) {
        float* row = t.plane[c] + t.index(0, p.y);
        for (int i = 0, x = p.x; i < laneCount && x < t.width; ++i, x += 2) row[x] = lanes[c][i];
    }
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
    bool contiguous() const { return image.pixelStride == (image.isHalf ? 2 : 4); }

    // Lanes x, x + step, ...; zero outside. step: 1 or 2.
    Real load(int channel, int x, int y, int step) const {
        if (channel >= image.channels || unsigned(y) >= unsigned(image.height)) return Real(0.0f);
        if (contiguous() && x >= 0 && x + step * laneCount <= image.width)
            return loadContiguous(channel, x, y, step);
        alignas(64) float lanes[laneCount];
        for (int i = 0; i < laneCount; ++i) {
            const int xi = x + i * step;
            lanes[i] = unsigned(xi) < unsigned(image.width) ? loadOne(address(channel, xi, y)) : 0.0f;
        }
        return loadLanes(lanes);
    }
    void storeLanesOf(int channel, Pixel p, Real v) const {
        if (channel >= image.channels) return;
        if (image.holdsHalves) v = withinHalves(v);
        if (contiguous() && p.x + laneCount <= image.width) {
            char* to = address(channel, p.x, p.y);
            if (image.isHalf) storeHalves(reinterpret_cast<uint16_t*>(to), v);
            else storeLanes(reinterpret_cast<float*>(to), v);
            return;
        }
        alignas(64) float lanes[laneCount];
        storeLanes(lanes, v);
        for (int i = 0; i < laneCount && p.x + i < image.width; ++i)
            storeOne(address(channel, p.x + i, p.y), lanes[i]);
    }

private:
    Real loadContiguous(int channel, int x, int y, int step) const {
        const char* from = address(channel, x, y);
        if (!image.isHalf) {
            const float* f = reinterpret_cast<const float*>(from);
            return step == 1 ? loadLanes(f) : loadEveryOther(f);
        }
        const uint16_t* h = reinterpret_cast<const uint16_t*>(from);
        if (step == 1) return loadHalves(h);
        alignas(64) float pairs[2 * laneCount];
        storeLanes(pairs, loadHalves(h));
        storeLanes(pairs + laneCount, loadHalves(h + laneCount));
        return loadEveryOther(pairs);
    }
    float loadOne(const char* p) const {
        if (image.isHalf) {
            uint16_t h;
            __builtin_memcpy(&h, p, sizeof h);
            return halfToFloat(h);
        }
        float f;
        __builtin_memcpy(&f, p, sizeof f);
        return f;
    }
    void storeOne(char* p, float f) const {
        if (image.isHalf) {
            const uint16_t h = floatToHalf(f);
            __builtin_memcpy(p, &h, sizeof h);
        } else {
            __builtin_memcpy(p, &f, sizeof f);
        }
    }
};

inline Vec4 fetchSpan(const HostImage& t, int x, int y, int step) {
    return Vec4(t.load(0, x, y, step), t.load(1, x, y, step), t.load(2, x, y, step), t.load(3, x, y, step));
}
inline Vec4 fetch(const HostImage& t, Pixel p) { return fetchSpan(t, p.x, p.y, 1); }
inline Vec4 fetchOffset(const HostImage& t, Pixel p, ivec2 o) {
    return fetchSpan(t, p.x + o.x, p.y + o.y, 1);
}
inline Vec4 fetchMinified(const HostImage& t, Pixel p, ivec2 o) {
    return fetchSpan(t, 2 * p.x + o.x, 2 * p.y + o.y, 2);
}
inline void store(const HostImage& t, Pixel p, const Vec4& v) {
    t.storeLanesOf(0, p, v.x);
    t.storeLanesOf(1, p, v.y);
    t.storeLanesOf(2, p, v.z);
    t.storeLanesOf(3, p, v.w);
}

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
