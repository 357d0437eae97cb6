/* Queues of secondary rays. A queue lists ray slots in rising order; it is worked off in batches
 * that start at entry `first`. A batch has the rays of its entries in one of two orders:
 *   entry by entry, all rays of a point together: for rays to a light, whose packets are then
 * narrow also where the points of a foveated list lie apart; sample by sample for sixteen
 * neighbouring entries, whose rays of one sample make one block: for rays in all directions, of
 * which those from one stratum are coherent. The blocks of all samples of these entries lie
 * together. */
#ifndef MACULA_SHADE_QUEUE_H
#define MACULA_SHADE_QUEUE_H

#include "lib/lane_memory.h"
#include "shared/ray.h"

/* True for all work-items of a group that lies beyond the list. CPUs turn a test of each slot into
 * masked loads, which are slow where the memory behind the list was never touched. */
MACULA_ALWAYS_INLINE bool beyond_list(uint ray_count) {
    return (uint)get_group_id(0) * (uint)get_local_size(0) * MACULA_LANES >= ray_count;
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

/* Sample by sample. */
MACULA_ALWAYS_INLINE uint queued_ray(uint entry, uint index, uint samples) {
    const uint block = entry / MACULA_RAY_BLOCK * samples + index;
    return block * MACULA_RAY_BLOCK + entry % MACULA_RAY_BLOCK;
}

/* t_max < 0 makes a ray inactive. `ray`: of the first lane. */
MACULA_ALWAYS_INLINE void store_rays(global RayBlock* rays, uint ray, Real3 origin, Real3 direction,
                                     Real t_max) {
    global RayBlock* block = rays + ray / MACULA_RAY_BLOCK;
    const uint lane = ray % MACULA_RAY_BLOCK;
    store_reals(block->origin_x, lane, origin.x);
    store_reals(block->origin_y, lane, origin.y);
    store_reals(block->origin_z, lane, origin.z);
    store_reals(block->t_min, lane, splat(0.0f));
    store_reals(block->direction_x, lane, direction.x);
    store_reals(block->direction_y, lane, direction.y);
    store_reals(block->direction_z, lane, direction.z);
    store_reals(block->t_max, lane, t_max);
}

/* The entries of a work-item of a launch that covers a batch, and the surfaces that they name. */
typedef struct Entries {
    uint first; /* in the batch */
    Mask used;  /* the last block of the batch may be filled up */
    Uint slot;  /* 0 where it is not used */
} Entries;

/* `count`: batch_count(). */
MACULA_ALWAYS_INLINE Entries load_entries(global const uint* queue, uint first_of_batch,
                                          uint count) {
    Entries e;
    e.first = first_of_item();
    e.used = lanes_from(e.first) < count;
    e.slot = load_uints(queue, first_of_batch + e.first);
    e.slot = e.used ? e.slot : splat_uint(0u);
    return e;
}

/* The rays of a work-item of a launch that covers a batch entry by entry. */
typedef struct EntryRays {
    uint first;  /* ray of the batch */
    Uint sample; /* of its entry */
    Mask used;
    Uint slot; /* 0 where it is not used */
} EntryRays;

MACULA_ALWAYS_INLINE EntryRays load_entry_rays(global const uint* queue, uint first_of_batch,
                                               uint count, uint samples) {
    EntryRays r;
    r.first = first_of_item();
    /* Lanes are few rays on from the first one: floats divide such numbers exactly, and faster. */
    const uint first_entry = r.first / samples;
    const Uint on = lanes_from(r.first - first_entry * samples);
    const Uint further = to_uint((uint_to_real(on) + 0.5f) * m_divide(1.0f, (float)samples));
    const Uint entry = first_entry + further;
    r.sample = on - further * samples;
    r.used = entry < count;
    const Uint at = r.used ? first_of_batch + entry : splat_uint(first_of_batch);
    const Uint slot = MACULA_GATHER(uint, queue, at, );
    r.slot = r.used ? slot : splat_uint(0u);
    return r;
}

#endif
