/* The stack of a traversal that takes a mask of up to 32 rays or packets through a tree of eight
 * children at once. OpenCL C only. */
#ifndef MACULA_LIB_WIDE_PUSH_H
#define MACULA_LIB_WIDE_PUSH_H

#include "lib/simd.h"
#include "lib/traverse_wide8.h"

/* A child to visit, in the caller's own code, and the rays or packets that enter it. */
typedef struct MaskedEntry {
    uint child;
    uint mask;
} MaskedEntry;

/* The number of the lowest bit of a mask that is not 0. */
static inline uint first_bit(uint mask) {
    return (uint)popcount(~mask & (mask - 1u));
}

/* What children are ordered by: `key`, a multiple of 8 that is not negative, for those with a mask,
 * below 0 for the others. The lane's number makes keys differ. */
static inline int8 child_keys8(int8 masks, int8 key) {
    return (masks != 0 ? key : (int8)(-8)) | MACULA_LANES8;
}

static inline void put_entry(MaskedEntry* stack, int place, uint child, int mask) {
    stack[place].child = child;
    stack[place].mask = (uint)mask;
}

static inline uint entered_children8(int8 masks) {
    return (uint)popcount(bits_of_lanes8(masks != 0));
}

#endif
