/* Lanes one by one: in private arrays. OpenCL C only. */
#ifndef MACULA_LIB_LANE_ARRAY_H
#define MACULA_LIB_LANE_ARRAY_H

#include "lib/lane_memory.h"

#if MACULA_LANES == 1

MACULA_ALWAYS_INLINE void put_lanes(float* array, Real value) {
    array[0] = value;
}
MACULA_ALWAYS_INLINE void put_uint_lanes(uint* array, Uint value) {
    array[0] = value;
}
MACULA_ALWAYS_INLINE Lane4 lanes_of(const float4* array) {
    const Lane4 v = {array[0].xyz, array[0].w};
    return v;
}

#else

MACULA_ALWAYS_INLINE void put_lanes(float* array, Real value) {
    vstore16(value, 0, array);
}
MACULA_ALWAYS_INLINE void put_uint_lanes(uint* array, Uint value) {
    vstore16(value, 0, array);
}
MACULA_ALWAYS_INLINE Lane4 lanes_of(const float4* array) {
    const float* words = (const float*)array;
    return lane4_of(vload16(0, words), vload16(1, words), vload16(2, words), vload16(3, words));
}

#endif
#endif
