// SPDX-License-Identifier: MIT
// Vectors of the kernel language on a CPU: glm::vec of Real and Int, and GLSL's functions on them.
// Included by kernel_cpu.h inside the instruction set's namespace.

using Vec2 = glm::vec<2, Real, glm::highp>;
using Vec3 = glm::vec<3, Real, glm::highp>;
using Vec4 = glm::vec<4, Real, glm::highp>;
using IVec2 = glm::vec<2, Int, glm::highp>;
using UVec4 = glm::vec<4, UInt, glm::highp>;
using uint = uint32_t;
using glm::ivec2;
using glm::ivec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

// A uniform float beside a varying vector, as GLSL allows.
inline Vec2 operator*(const Vec2& v, float s) { return v * Real(s); }
inline Vec2 operator*(float s, const Vec2& v) { return v * Real(s); }
inline Vec3 operator*(const Vec3& v, float s) { return v * Real(s); }
inline Vec3 operator*(float s, const Vec3& v) { return v * Real(s); }
inline Vec4 operator*(const Vec4& v, float s) { return v * Real(s); }
inline Vec4 operator*(float s, const Vec4& v) { return v * Real(s); }

inline Vec2 varying(const vec2& v) { return Vec2(Real(v.x), Real(v.y)); }
inline Vec3 varying(const vec3& v) { return Vec3(Real(v.x), Real(v.y), Real(v.z)); }

inline Real dot(const Vec2& a, const Vec2& b) { return a.x * b.x + a.y * b.y; }
inline Real dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return Vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
inline Real length(const Vec3& a) { return sqrt(dot(a, a)); }

inline Vec2 select(Mask m, const Vec2& a, const Vec2& b) {
    return Vec2(select(m, a.x, b.x), select(m, a.y, b.y));
}
inline Vec3 select(Mask m, const Vec3& a, const Vec3& b) {
    return Vec3(select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z));
}
inline Vec4 select(Mask m, const Vec4& a, const Vec4& b) {
    return Vec4(select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z), select(m, a.w, b.w));
}
inline Vec3 min(const Vec3& a, const Vec3& b) { return Vec3(min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)); }
inline Vec3 max(const Vec3& a, const Vec3& b) { return Vec3(max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)); }
inline Vec3 min(const Vec3& a, float b) { return Vec3(min(a.x, b), min(a.y, b), min(a.z, b)); }
inline Vec3 max(const Vec3& a, float b) { return Vec3(max(a.x, b), max(a.y, b), max(a.z, b)); }

// Uniform values have GLSL's functions too.
inline float abs(float a) { return __builtin_fabsf(a); }
inline float min(float a, float b) { return b < a ? b : a; }
inline float max(float a, float b) { return a < b ? b : a; }
inline int min(int a, int b) { return b < a ? b : a; }
inline int max(int a, int b) { return a < b ? b : a; }
