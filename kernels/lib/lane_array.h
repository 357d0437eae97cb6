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

#else

MACULA_ALWAYS_INLINE void put_lanes(float* array, Real value) {
    vstore16(value, 0, array);
}
MACULA_ALWAYS_INLINE void put_uint_lanes(uint* array, Uint value) {
    vstore16(value, 0, array);
}

#endif
#endif
