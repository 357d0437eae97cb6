/* Ordered prefix sum and compaction: reduce, then scan, over tiles, level above level (Blelloch
 * 1990; Sengupta et al. 2007). The result depends on nothing but the input: sums are exact modulo
 * 2^32 and nothing is appended by an atomic. The number of elements lives on the device; a launch
 * covers the capacity and tiles beyond the count return at once.
 *
 * Level 0 is the input, level k + 1 holds the sum of each tile of level k, and the top level is one
 * tile. Host side: host/kernel/prefix_sum.hpp. */
#include "shared/language.h"

#define ITEMS 16u /* consecutive elements of one work-item */
#define TILE (MACULA_WORK_GROUP * ITEMS)

/* Elements of a level. `capacity` bounds the count: a wrong one stays inside the buffers. */
static inline uint level_count(global const uint *count, uint capacity, uint level) {
    uint n = min(*count, capacity);
    for (uint i = 0u; i < level; ++i)
        n = n / TILE + (n % TILE != 0u ? 1u : 0u);
    return n;
}

static inline uint first_element(void) {
    return (uint)get_group_id(0) * TILE + (uint)get_local_id(0) * ITEMS;
}

static inline uint sum_of_item(global const uint *values, uint first, uint n) {
    uint sum = 0u;
    const uint end = min(first + ITEMS, n);
    for (uint i = first; i < end; ++i)
        sum += values[i];
    return sum;
}

/* Inclusive scan of one value for each work-item of the group (Hillis and Steele 1986). */
static inline uint scan_group(uint value, local uint *shared_sums) {
    const uint me = (uint)get_local_id(0);
    shared_sums[me] = value;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint distance = 1u; distance < MACULA_WORK_GROUP; distance *= 2u) {
        const uint left = me >= distance ? shared_sums[me - distance] : 0u;
        barrier(CLK_LOCAL_MEM_FENCE);
        shared_sums[me] += left;
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    return shared_sums[me];
}

/* `values` may be `offsets`: a work-item reads an element before it writes that very element. */
static inline void write_offsets(global const uint *values, global uint *offsets, uint first,
                                 uint n, uint offset) {
    const uint end = min(first + ITEMS, n);
    for (uint i = first; i < end; ++i) {
        const uint value = values[i];
        offsets[i] = offset;
        offset += value;
    }
}

/* One work-group a tile: sums[tile] of `level`. */
kernel __attribute__((reqd_work_group_size(MACULA_WORK_GROUP, 1, 1))) void
sum_tiles(global const uint *values, global const uint *count, uint capacity, uint level,
          global uint *sums) {
    local uint shared_sums[MACULA_WORK_GROUP];
    const uint n = level_count(count, capacity, level);
    if ((uint)get_group_id(0) * TILE >= n)
        return;
    const uint sum = scan_group(sum_of_item(values, first_element(), n), shared_sums);
    if (get_local_id(0) == MACULA_WORK_GROUP - 1u)
        sums[get_group_id(0)] = sum;
}

/* One work-group a tile: exclusive offsets inside it, plus the tile's own offset. */
kernel __attribute__((reqd_work_group_size(MACULA_WORK_GROUP, 1, 1))) void
scan_tiles(global const uint *values, global const uint *count, uint capacity, uint level,
           global const uint *tile_offsets, global uint *offsets) {
    local uint shared_sums[MACULA_WORK_GROUP];
    const uint n = level_count(count, capacity, level);
    if ((uint)get_group_id(0) * TILE >= n)
        return;
    const uint first = first_element();
    const uint sum = sum_of_item(values, first, n);
    const uint before = scan_group(sum, shared_sums) - sum;
    write_offsets(values, offsets, first, n, tile_offsets[get_group_id(0)] + before);
}

/* The top level: one work-group; writes the total of everything. */
kernel __attribute__((reqd_work_group_size(MACULA_WORK_GROUP, 1, 1))) void
scan_top(global const uint *values, global const uint *count, uint capacity, uint level,
         global uint *offsets, global uint *total) {
    local uint shared_sums[MACULA_WORK_GROUP];
    const uint n = level_count(count, capacity, level);
    const uint first = first_element();
    const uint sum = sum_of_item(values, first, n);
    const uint up_to_here = scan_group(sum, shared_sums);
    write_offsets(values, offsets, first, n, up_to_here - sum);
    if (get_local_id(0) == MACULA_WORK_GROUP - 1u)
        *total = up_to_here;
}

/* indices[k] = position of the k-th flag that is 1, in order. One work-group a tile, whose offset
 * is known. A loop over the set bits, since CPUs scatter vectors with a few lanes very slowly. */
kernel __attribute__((reqd_work_group_size(MACULA_WORK_GROUP, 1, 1))) void
compact_tiles(global const uint *flags, global const uint *count, uint capacity,
              global const uint *tile_offsets, global uint *indices) {
    local uint shared_sums[MACULA_WORK_GROUP];
    const uint n = min(*count, capacity);
    if ((uint)get_group_id(0) * TILE >= n)
        return;
    const uint first = first_element(), end = min(first + ITEMS, n);
    uint set = 0u;
    for (uint i = first; i < end; ++i)
        set |= (flags[i] != 0u ? 1u : 0u) << (i - first);
    const uint up_to_here = scan_group(popcount(set), shared_sums);
    uint place = tile_offsets[get_group_id(0)] + up_to_here - popcount(set);
    for (uint rest = set; rest != 0u; rest &= rest - 1u)
        indices[place++] = first + popcount((rest & -rest) - 1u);
}
