/* Three-vectors of the dual dialect: float3 of OpenCL C, and the same on the host. Private values
 * only; device memory holds scalars or float4. Of sixteen lanes: lib/lanes.h. */
#ifndef MACULA_LIB_VECTOR_H
#define MACULA_LIB_VECTOR_H

#include "lib/math.h"

MACULA_SHARED_BEGIN

#ifndef __OPENCL_VERSION__
struct float3 {
    float x, y, z;
};
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
#endif

#define MACULA_WIDTH
#define VECTOR3 float3
#define VECTOR_MASK bool
#include "lib/vector_functions.h"
#undef MACULA_WIDTH
#undef VECTOR3
#undef VECTOR_MASK

MACULA_ALWAYS_INLINE float3 vector_at(MACULA_GLOBAL const float* v) {
    return make3(v[0], v[1], v[2]);
}

MACULA_SHARED_END
#endif
