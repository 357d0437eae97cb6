/* Parts of make_trace_ray of lib/ray.h for sixteen rays side by side, in the same arithmetic.
 * OpenCL C only. */
#ifndef MACULA_LIB_RAY16_H
#define MACULA_LIB_RAY16_H

#include "lib/ray.h"
#include "lib/simd.h"

static inline float16 bounded_direction16(float16 d) {
    const float16 least = d < 0.0f ? (float16)(-MACULA_MIN_DIRECTION) : MACULA_MIN_DIRECTION;
    return fabs(d) < MACULA_MIN_DIRECTION ? least : d;
}

static inline float16 pick_axis16(int16 axis, float16 x, float16 y, float16 z) {
    return axis == 0 ? x : (axis == 1 ? y : z);
}

/* kz of the bounded directions. */
static inline int16 dominant_axis16(float16 dx, float16 dy, float16 dz) {
    const float16 ax = fabs(dx), ay = fabs(dy), az = fabs(dz);
    return ((ax >= ay) & (ax >= az)) ? (int16)(0) : (ay >= az ? (int16)(1) : (int16)(2));
}

static inline float16 reach16(float16 ox, float16 oy, float16 oz) {
    return m_max(m_max(fabs(ox), fabs(oy)), m_max(fabs(oz), (float16)(0x1p-20f)));
}

/* Asks the cache for a block of the queue: one that this work-item, or the next one on the same
 * core, will load. */
static inline void fetch_block(global const RayBlock* block) {
    for (uint offset = 0u; offset < sizeof(RayBlock); offset += 64u)
        MACULA_FETCH(block, offset);
}

#endif
