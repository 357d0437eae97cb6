/* Three-vectors of the dual dialect: float3 of OpenCL C, and the same operations on the host.
 * Private values only; device memory holds scalars or float4. */
#ifndef MACULA_LIB_VECTOR_H
#define MACULA_LIB_VECTOR_H

#include "lib/ray.h"

#ifdef __OPENCL_VERSION__
MACULA_ALWAYS_INLINE float3 make3(float x, float y, float z) {
    return (float3)(x, y, z);
}
MACULA_ALWAYS_INLINE float3 fma3(float3 a, float3 b, float3 c) {
    return fma(a, b, c);
}
#else
namespace macula::shared {
struct float3 {
    float x, y, z;
};
inline float3 make3(float x, float y, float z) {
    return {x, y, z};
}
inline float3 operator+(float3 a, float3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline float3 operator-(float3 a, float3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline float3 operator-(float3 a) {
    return {-a.x, -a.y, -a.z};
}
inline float3 operator*(float3 a, float3 b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline float3 operator*(float3 a, float s) {
    return {a.x * s, a.y * s, a.z * s};
}
inline float3 fma3(float3 a, float3 b, float3 c) {
    return {fma(a.x, b.x, c.x), fma(a.y, b.y, c.y), fma(a.z, b.z, c.z)};
}
} /* namespace macula::shared */
#endif

MACULA_SHARED_BEGIN

MACULA_ALWAYS_INLINE float3 splat3(float s) {
    return make3(s, s, s);
}
/* v * s + c, one rounding. */
MACULA_ALWAYS_INLINE float3 scale_add3(float3 v, float s, float3 c) {
    return fma3(v, splat3(s), c);
}
MACULA_ALWAYS_INLINE float3 lerp3(float3 a, float3 b, float t) {
    return scale_add3(b - a, t, a);
}
MACULA_ALWAYS_INLINE float dot3(float3 a, float3 b) {
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}
MACULA_ALWAYS_INLINE float3 cross3(float3 a, float3 b) {
    return make3(fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)),
                 fma(a.x, b.y, -(a.y * b.x)));
}
MACULA_ALWAYS_INLINE float clamped(float x, float lo, float hi) {
    return x < lo ? lo : (x > hi ? hi : x);
}
MACULA_ALWAYS_INLINE float largest3(float3 a) {
    return m_max(m_max(fabs(a.x), fabs(a.y)), fabs(a.z));
}

/* v scaled to unit length; `fallback` where v is zero or too small to have a direction. Components
 * are scaled first, so that no square underflows or overflows. */
MACULA_ALWAYS_INLINE float3 unit3(float3 v, float3 fallback) {
    const float size = largest3(v);
    if (!(size > 1e-30f))
        return fallback;
    const float3 w = v * m_divide(1.0f, size);
    return w * m_inverse_sqrt(dot3(w, w));
}

MACULA_SHARED_END
#endif
