/* How lanes read and write the slots of device memory (lib/lanes.h). A work-item's lanes hold
 * neighbouring slots, or slots that a queue names. OpenCL C only. */
#ifndef MACULA_LIB_LANE_MEMORY_H
#define MACULA_LIB_LANE_MEMORY_H

#include "lib/lanes.h"

/* Four words a slot: three components, and a fourth word that is not always a number. */
typedef struct Lane4 {
    Real3 xyz;
    Real w;
} Lane4;

/* The first slot of a work-item. */
static inline uint first_of_item(void) {
    return (uint)get_global_id(0) * MACULA_LANES;
}

#if MACULA_LANES == 1

static inline Uint lanes_from(uint first) {
    return first;
}
static inline Real load_reals(global const float* p, uint first) {
    return p[first];
}
static inline Uint load_uints(global const uint* p, uint first) {
    return p[first];
}
static inline void store_reals(global float* p, uint first, Real value) {
    p[first] = value;
}
static inline void store_uints(global uint* p, uint first, Uint value) {
    p[first] = value;
}
MACULA_ALWAYS_INLINE Lane4 gather4(global const float4* p, Uint index) {
    const Lane4 v = {p[index].xyz, p[index].w};
    return v;
}
MACULA_ALWAYS_INLINE Lane4 load4(global const float4* p, uint first) {
    return gather4(p, first);
}
MACULA_ALWAYS_INLINE void store4(global float4* p, uint first, Real3 xyz, Real w) {
    p[first] = (float4)(xyz, w);
}
MACULA_ALWAYS_INLINE void store2(global float2* p, uint first, Real x, Real y) {
    p[first] = (float2)(x, y);
}
MACULA_ALWAYS_INLINE void store2_uints(global uint* p, uint first, Uint x, Uint y) {
    p[2u * first] = x;
    p[2u * first + 1u] = y;
}
MACULA_ALWAYS_INLINE uint count_lanes(Mask mask) {
    return mask ? 1u : 0u;
}
/* Where `wanted`; the slots differ from lane to lane. */
MACULA_ALWAYS_INLINE void scatter4(global float4* p, Uint index, Mask wanted, Real3 xyz, Real w) {
    if (wanted)
        p[index] = (float4)(xyz, w);
}
MACULA_ALWAYS_INLINE void scatter_reals(global float* p, Uint index, Mask wanted, Real value) {
    if (wanted)
        p[index] = value;
}

#else

static inline Uint lanes_from(uint first) {
    return first + as_uint16(MACULA_LANES16);
}
static inline Real load_reals(global const float* p, uint first) {
    return vload16(0, p + first);
}
static inline Uint load_uints(global const uint* p, uint first) {
    return vload16(0, p + first);
}
static inline void store_reals(global float* p, uint first, Real value) {
    vstore16(value, 0, p + first);
}
static inline void store_uints(global uint* p, uint first, Uint value) {
    vstore16(value, 0, p + first);
}

/* Four slots, one after another, from four that hold x, y, z and w of four slots each. */
MACULA_ALWAYS_INLINE float16 transposed(float16 m) {
    return m.s048c159d26ae37bf;
}

MACULA_ALWAYS_INLINE Lane4 lane4_of(float16 a, float16 b, float16 c, float16 d) {
    const float16 ta = transposed(a), tb = transposed(b), tc = transposed(c), td = transposed(d);
    const Lane4 v = {{(float16)(ta.s0123, tb.s0123, tc.s0123, td.s0123),
                      (float16)(ta.s4567, tb.s4567, tc.s4567, td.s4567),
                      (float16)(ta.s89ab, tb.s89ab, tc.s89ab, td.s89ab)},
                     (float16)(ta.scdef, tb.scdef, tc.scdef, td.scdef)};
    return v;
}

MACULA_ALWAYS_INLINE Lane4 gather4(global const float4* p, Uint i) {
    return lane4_of((float16)(p[i.s0], p[i.s1], p[i.s2], p[i.s3]),
                    (float16)(p[i.s4], p[i.s5], p[i.s6], p[i.s7]),
                    (float16)(p[i.s8], p[i.s9], p[i.sa], p[i.sb]),
                    (float16)(p[i.sc], p[i.sd], p[i.se], p[i.sf]));
}

MACULA_ALWAYS_INLINE Lane4 load4(global const float4* p, uint first) {
    global const float* words = (global const float*)(p + first);
    return lane4_of(vload16(0, words), vload16(1, words), vload16(2, words), vload16(3, words));
}

/* Part k: slots 4k to 4k + 3. */
typedef struct Slots4 {
    float16 part[4];
} Slots4;

MACULA_ALWAYS_INLINE Slots4 slots_of(Real3 v, Real w) {
    const Slots4 s = {{transposed((float16)(v.x.s0123, v.y.s0123, v.z.s0123, w.s0123)),
                       transposed((float16)(v.x.s4567, v.y.s4567, v.z.s4567, w.s4567)),
                       transposed((float16)(v.x.s89ab, v.y.s89ab, v.z.s89ab, w.s89ab)),
                       transposed((float16)(v.x.scdef, v.y.scdef, v.z.scdef, w.scdef))}};
    return s;
}

MACULA_ALWAYS_INLINE void store4(global float4* p, uint first, Real3 xyz, Real w) {
    const Slots4 s = slots_of(xyz, w);
    global float* words = (global float*)(p + first);
    vstore16(s.part[0], 0, words);
    vstore16(s.part[1], 1, words);
    vstore16(s.part[2], 2, words);
    vstore16(s.part[3], 3, words);
}

MACULA_ALWAYS_INLINE void store2(global float2* p, uint first, Real x, Real y) {
    global float* words = (global float*)(p + first);
    vstore16((float16)(x.lo, y.lo).s08192a3b4c5d6e7f, 0, words);
    vstore16((float16)(x.hi, y.hi).s08192a3b4c5d6e7f, 1, words);
}

/* Two words a slot. */
MACULA_ALWAYS_INLINE void store2_uints(global uint* p, uint first, Uint x, Uint y) {
    vstore16((uint16)(x.lo, y.lo).s08192a3b4c5d6e7f, 0, p + 2u * first);
    vstore16((uint16)(x.hi, y.hi).s08192a3b4c5d6e7f, 1, p + 2u * first);
}
MACULA_ALWAYS_INLINE uint count_lanes(Mask mask) {
    return popcount(bits_of_lanes16(mask));
}
MACULA_ALWAYS_INLINE void scatter4(global float4* p, Uint index, Mask wanted, Real3 xyz, Real w) {
    const Slots4 s = slots_of(xyz, w);
    float4 values[16];
    for (uint k = 0u; k < 4u; ++k)
        vstore16(s.part[k], k, (float*)values);
    uint indices[16];
    int flags[16];
    vstore16(index, 0, indices);
    vstore16(wanted, 0, flags);
    for (uint lane = 0u; lane < 16u; ++lane)
        if (flags[lane])
            p[indices[lane]] = values[lane];
}

MACULA_ALWAYS_INLINE void scatter_reals(global float* p, Uint index, Mask wanted, Real value) {
    uint indices[16];
    int flags[16];
    float values[16];
    vstore16(index, 0, indices);
    vstore16(wanted, 0, flags);
    vstore16(value, 0, values);
    for (uint lane = 0u; lane < 16u; ++lane)
        if (flags[lane])
            p[indices[lane]] = values[lane];
}

#endif
#endif
