/* Queues of secondary rays. A queue lists ray slots in rising order; it is worked off in batches
 * that start at entry `first`. The rays of sixteen neighbouring entries for one sample index make
 * one ray block, and the blocks of all samples of these entries lie together, so that a packet is
 * coherent (same stratum, neighbouring origins) and a stream of rays stays in one neighbourhood. */
#ifndef MACULA_SHADE_QUEUE_H
#define MACULA_SHADE_QUEUE_H

#include "lib/vector.h"
#include "shared/ray.h"

/* True for all work-items of a group that lies beyond the list. CPUs turn a test of each slot into
 * masked loads, which are slow where the memory behind the list was never touched. */
MACULA_ALWAYS_INLINE bool beyond_list(uint ray_count) {
    return (uint)get_group_id(0) * (uint)get_local_size(0) >= ray_count;
}

/* Entries left at `first`. */
MACULA_ALWAYS_INLINE uint batch_count(uint queue_count, uint first) {
    return queue_count > first ? queue_count - first : 0u;
}

/* Entries rounded up to whole ray blocks. */
MACULA_ALWAYS_INLINE uint padded_count(uint count) {
    return (count + MACULA_RAY_BLOCK - 1u) / MACULA_RAY_BLOCK * MACULA_RAY_BLOCK;
}

/* Rays of a batch of at most `capacity` entries (a multiple of MACULA_RAY_BLOCK). */
MACULA_ALWAYS_INLINE uint batch_rays(uint count, uint samples, uint capacity) {
    const uint padded = padded_count(count);
    return (padded < capacity ? padded : capacity) * samples;
}

MACULA_ALWAYS_INLINE uint queued_ray(uint entry, uint index, uint samples) {
    const uint block = entry / MACULA_RAY_BLOCK * samples + index;
    return block * MACULA_RAY_BLOCK + entry % MACULA_RAY_BLOCK;
}

/* t_max < 0 makes the ray inactive. */
MACULA_ALWAYS_INLINE void store_ray(global RayBlock* rays, uint ray, float3 origin,
                                    float3 direction, float t_max) {
    global RayBlock* block = rays + ray / MACULA_RAY_BLOCK;
    const uint lane = ray % MACULA_RAY_BLOCK;
    block->origin_x[lane] = origin.x;
    block->origin_y[lane] = origin.y;
    block->origin_z[lane] = origin.z;
    block->t_min[lane] = 0.0f;
    block->direction_x[lane] = direction.x;
    block->direction_y[lane] = direction.y;
    block->direction_z[lane] = direction.z;
    block->t_max[lane] = t_max;
}

#endif
