// SPDX-License-Identifier: MIT
// The kernel language as GLSL: 4.50 for Vulkan, 4.30 or ES 3.10 for OpenGL. The includer writes #version.

#define Real float
#define Int int
#define UInt uint
#define Mask bool
#define Vec2 vec2
#define Vec3 vec3
#define Vec4 vec4
#define IVec2 ivec2
#define UVec4 uvec4
#define Pixel ivec2
#define SparsePixel ivec2
#define Item int
#define RB_FUNCTION
#define RB_OF_KERNEL
#define RB_UNROLL
#define RB_TEXTURE_ARGUMENT highp sampler2D

#define RB_KERNEL(name) layout(local_size_x = 8, local_size_y = 8) in;
#define RB_ITEM_KERNEL(name) layout(local_size_x = 64) in;

// A feature's value is a specialization constant in Vulkan, and in OpenGL a macro that the backend defines.
#ifdef VULKAN
#define RB_FEATURE(id, name, count) layout(constant_id = id) const int name = 0;
#else
#define RB_FEATURE(id, name, count) const int name = REBOUND_FEATURE_##id;
#endif

// For the CPU, which compiles what is listed; a GPU's driver compiles what is asked for.
#define RB_COMBINATIONS(condition)

#ifdef VULKAN
#define RB_LAYOUT(slot) set = 0, binding = slot
#else
#define RB_LAYOUT(slot) binding = slot
#endif

#define RB_TEXTURE(slot, name) layout(RB_LAYOUT(slot)) uniform highp sampler2D name;
#define RB_SPARSE_TEXTURE(slot, name) RB_TEXTURE(slot, name)
#define RB_TEXTURE_OF_ANY_SIZE(slot, name) RB_TEXTURE(slot, name)
#define RB_INPUT(slot, name) layout(RB_LAYOUT(slot)) uniform highp sampler2D name;
#define RB_UINT_TEXTURE(slot, name) layout(RB_LAYOUT(slot)) uniform highp usampler2D name;
#define RB_UINT_INPUT(slot, name) layout(RB_LAYOUT(slot)) uniform highp usampler2D name;
#define RB_IMAGE(slot, format, name)                                                                         \
    layout(RB_LAYOUT(slot), format) writeonly uniform highp RB_IMAGE_OF_##format name;                       \
    RB_TEXEL_OF_##format name##Stored(RB_TEXEL_OF_##format v) { return RB_STORED_##format(v); }
#define RB_OUTPUT(slot, format, name) RB_IMAGE(slot, format, name)
// A format's images and texels, and what it makes of a texel.
#define RB_IMAGE_OF_r32f image2D
#define RB_IMAGE_OF_rgba16f image2D
#define RB_IMAGE_OF_rgba32f image2D
#define RB_IMAGE_OF_r32ui uimage2D
#define RB_IMAGE_OF_rgba32ui uimage2D
#define RB_TEXEL_OF_r32f vec4
#define RB_TEXEL_OF_rgba16f vec4
#define RB_TEXEL_OF_rgba32f vec4
#define RB_TEXEL_OF_r32ui uvec4
#define RB_TEXEL_OF_rgba32ui uvec4
#define RB_STORED_r32f(v) (v)
#define RB_STORED_rgba32f(v) (v)
#define RB_STORED_rgba16f(v) roundToHalf(v)
#define RB_STORED_r32ui(v) (v)
#define RB_STORED_rgba32ui(v) (v)
#define RB_BUFFER(slot, Type, name)                                                                          \
    layout(RB_LAYOUT(slot), std430) readonly buffer name##Block { Type name[]; };
#define RB_VALUES(slot, Type, name)                                                                          \
    layout(RB_LAYOUT(slot), std430) readonly buffer name##Block { Type name[]; };                            \
    const Type name##Zero = Type(0);
#define RB_OUTPUT_VALUES(slot, Type, name)                                                                   \
    layout(RB_LAYOUT(slot), std430) writeonly buffer name##Block { Type name[]; };
#define RB_CONSTANTS(slot, Type, name)                                                                       \
    layout(RB_LAYOUT(slot), std140) uniform name##Block { Type name; };
#define RB_MAIN(pixel, extent)                                                                               \
    void main() {                                                                                            \
        ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);                                                       \
        if (pixel.x >= (extent).x || pixel.y >= (extent).y) return;
// More groups than there may be in a row fill further rows.
#define RB_ITEM_MAIN(item, count)                                                                            \
    void main() {                                                                                            \
        int item = int(gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u);        \
        if (item >= (count)) return;
#define RB_END_KERNEL }

precision highp float;
precision highp int;

float select(bool m, float a, float b) { return m ? a : b; }
int select(bool m, int a, int b) { return m ? a : b; }
vec2 select(bool m, vec2 a, vec2 b) { return m ? a : b; }
vec3 select(bool m, vec3 a, vec3 b) { return m ? a : b; }
vec4 select(bool m, vec4 a, vec4 b) { return m ? a : b; }
uint select(bool m, uint a, uint b) { return m ? a : b; }
bool anyLane(bool m) { return m; }
int firstLane(bool m, int a) { return a; }
float inverseSqrt(float x) { return inversesqrt(x); }
float reciprocal(float x) { return 1.0f / x; }
float roughReciprocal(float x) { return 1.0f / x; }
float toReal(int x) { return float(x); }
int toInt(float x) { return int(x); }
float toReal(uint x) { return float(x); }
int toInt(uint x) { return int(x); }
uint toUInt(int x) { return uint(x); }
uint toUInt(float x) { return uint(x); }
// A macro, since GLSL reserves the word.
#define varying(v) (v)
int bitsOf(float x) { return floatBitsToInt(x); }
float realOfBits(int x) { return intBitsToFloat(x); }
bool isFinite(float x) { return (bitsOf(x) & 0x7f800000) != 0x7f800000; }

// The nearest half, halfway cases to the even one; beyond their range, infinities included, the largest: +-65504. NaN
// stays NaN. Drivers may round towards zero where they store halves, and beyond 65504 to infinity, which a later pass
// would spread: so stores to half formats round before.
float roundToHalf(float v) {
    int bits = bitsOf(v);
    int magnitude = bits & 0x7fffffff;
    int limited = min(magnitude, 0x477fe000);
    int rounded = (limited + 0xfff + ((limited >> 13) & 1)) & 0x7fffe000;
    if (limited < 0x38800000) { // below 2^-14 halves lie 2^-24 apart; no sum that a compiler may shorten
        float scaled = realOfBits(limited) * 16777216.0f;
        int whole = int(scaled);
        float rest = scaled - float(whole);
        if (rest > 0.5f || (rest == 0.5f && (whole & 1) == 1)) whole += 1;
        rounded = bitsOf(float(whole) * 5.9604645e-8f);
    }
    return magnitude > 0x7f800000 ? v : realOfBits((bits - magnitude) + rounded);
}
vec4 roundToHalf(vec4 v) {
    return vec4(roundToHalf(v.x), roundToHalf(v.y), roundToHalf(v.z), roundToHalf(v.w));
}

vec2 pixelCenter(ivec2 p) { return vec2(p) + 0.5f; }

// An invocation is its own vector of lanes.
int sparseCount(ivec2 p, int width) { return 1; }
ivec2 sparsePixel(ivec2 p, int turn) { return p; }
int columnOf(ivec2 p) { return p.x; }
int rowOf(ivec2 p) { return p.y; }

bool isInside(ivec2 p, ivec2 size) { return p.x >= 0 && p.y >= 0 && p.x < size.x && p.y < size.y; }
bool reaches(highp sampler2D t, ivec2 p, ivec2 o) { return isInside(p + o, textureSize(t, 0)); }
vec4 fetchAt(highp sampler2D t, ivec2 p) {
    return isInside(p, textureSize(t, 0)) ? texelFetch(t, p, 0) : vec4(0.0f);
}
uvec4 fetchAt(highp usampler2D t, ivec2 p) {
    return isInside(p, textureSize(t, 0)) ? texelFetch(t, p, 0) : uvec4(0u);
}
uvec4 fetch(highp usampler2D t, ivec2 p) { return texelFetch(t, p, 0); }
uvec4 fetchOffset(highp usampler2D t, ivec2 p, ivec2 o) { return fetchAt(t, p + o); }
vec4 fetch(highp sampler2D t, ivec2 p) { return texelFetch(t, p, 0); }
vec4 fetchOffset(highp sampler2D t, ivec2 p, ivec2 o) { return fetchAt(t, p + o); }
vec4 fetchMinified(highp sampler2D t, ivec2 p, ivec2 o) { return fetchAt(t, 2 * p + o); }
vec4 fetchQuarter(highp sampler2D t, ivec2 p, ivec2 o) { return fetchAt(t, 4 * p + o); }
vec4 fetchMagnified(highp sampler2D t, ivec2 p, ivec2 bias, int shift, ivec2 o) {
    return fetchAt(t, ((p + bias) >> shift) + o);
}
// A macro, since SPIR-V has the image's format in a parameter's type.
#define store(image, p, v) imageStore(image, p, image##Stored(v))

// Macros, since GLSL passes no buffers to functions.
int indexOf(int item) { return item; }
int groupOf(int item) { return item / 16; }
int itemOf(ivec2 p, int width) { return p.y * width + p.x; }
bool isElement(int index, int count) { return index >= 0 && index < count; }
#define loadAt(values, index) (isElement(index, values.length()) ? values[index] : values##Zero)
#define loadOffset(values, item, offset) loadAt(values, (item) + (offset))
#define loadItem(values, item) loadAt(values, item)
#define loadFour(values, index)                                                                              \
    (isElement(index, values.length() / 4) ? vec4(values[4 * (index)], values[4 * (index) + 1],              \
                                                  values[4 * (index) + 2], values[4 * (index) + 3])          \
                                           : vec4(0.0f))
#define storeAt(values, item, index, x)                                                                      \
    if (isElement(index, values.length())) values[index] = x
#define storeOffset(values, item, offset, x) storeAt(values, item, (item) + (offset), x)
#define storeItem(values, item, x) storeAt(values, item, item, x)
#define storeFour(values, item, index, numbers)                                                              \
    {                                                                                                        \
        int fourAt = (index);                                                                                \
        vec4 fourStored = (numbers);                                                                         \
        if (isElement(fourAt, values.length() / 4)) {                                                        \
            values[4 * fourAt] = fourStored.x;                                                               \
            values[4 * fourAt + 1] = fourStored.y;                                                           \
            values[4 * fourAt + 2] = fourStored.z;                                                           \
            values[4 * fourAt + 3] = fourStored.w;                                                           \
        }                                                                                                    \
    }
