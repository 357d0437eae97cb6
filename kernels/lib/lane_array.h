/* Lanes one by one: in a private array. OpenCL C only. */
#ifndef MACULA_LIB_LANE_ARRAY_H
#define MACULA_LIB_LANE_ARRAY_H

#include "lib/lanes.h"

#if MACULA_LANES == 1
MACULA_ALWAYS_INLINE void put_lanes(float* array, Real value) {
    array[0] = value;
}
#else
MACULA_ALWAYS_INLINE void put_lanes(float* array, Real value) {
    vstore16(value, 0, array);
}
#endif

#endif
