/* lib/vector.h for sixteen lanes side by side. OpenCL C only. */
#ifndef MACULA_LIB_VECTOR16_H
#define MACULA_LIB_VECTOR16_H

#include "lib/math_vector.h"
#include "lib/vector.h"

typedef struct Vector16 {
    float16 x, y, z;
} Vector16;

#define MACULA_WIDTH 16
#define VECTOR3 Vector16
#define VECTOR_MASK int16
#include "lib/vector_functions.h"
#undef MACULA_WIDTH
#undef VECTOR3
#undef VECTOR_MASK

/* The same vector in all lanes. */
MACULA_ALWAYS_INLINE Vector16 spread16(float3 v) {
    return make3((float16)(v.x), (float16)(v.y), (float16)(v.z));
}

#endif
