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

/* Puts the children that are entered on a stack of `depth` entries, that of the least key on top,
 * without a branch that waits for the tests: each at the number of those that come after it, so
 * that those which nothing enters end up above the top: all eight are written. Returns how many
 * entries there are now. */
static inline uint push_children8(MaskedEntry* stack, uint depth, const uint child[8], int8 masks,
                                  int8 key) {
    const int8 place = -(((int8)(key.s0) > key) + ((int8)(key.s1) > key) + ((int8)(key.s2) > key) +
                         ((int8)(key.s3) > key) + ((int8)(key.s4) > key) + ((int8)(key.s5) > key) +
                         ((int8)(key.s6) > key) + ((int8)(key.s7) > key));
    stack += depth;
    put_entry(stack, place.s0, child[0], masks.s0);
    put_entry(stack, place.s1, child[1], masks.s1);
    put_entry(stack, place.s2, child[2], masks.s2);
    put_entry(stack, place.s3, child[3], masks.s3);
    put_entry(stack, place.s4, child[4], masks.s4);
    put_entry(stack, place.s5, child[5], masks.s5);
    put_entry(stack, place.s6, child[6], masks.s6);
    put_entry(stack, place.s7, child[7], masks.s7);
    return depth + ((uint)popcount(lane_mask8(masks != 0)) >> 3);
}

#endif
