/* Many rays a work-item, for CPUs: rays that have little in common are sorted by class, which is
 * their octant and dominant axis, and traced in chunks of up to 32 that share the loads of nodes
 * and triangles (after Tsakok 2009, "Faster Incoherent Rays: Multi-BVH Ray Stream Tracing"). */
#include "lib/wide_stream_scene.h"

/* The rays that are not active come after the classes. */
#define INACTIVE MACULA_STREAM_CLASSES
#define BINS (MACULA_STREAM_CLASSES + 1u)

/* The bins of a block of which `left` rays are in the queue. Raises the greatest components of the
 * active ones' origins and directions in size. */
static inline uchar16 bins_of(global const RayBlock* block, uint left, float16* reach,
                              float16* speed) {
    const float16 dx = bounded_direction16(vload16(0, block->direction_x));
    const float16 dy = bounded_direction16(vload16(0, block->direction_y));
    const float16 dz = bounded_direction16(vload16(0, block->direction_z));
    const float16 t_min = vload16(0, block->t_min), t_max = vload16(0, block->t_max);
    const int16 octant = ((dx < 0.0f) & 1) | ((dy < 0.0f) & 2) | ((dz < 0.0f) & 4);
    const int16 ray_class = octant * 3 + dominant_axis16(dx, dy, dz);
    const int16 active = (t_min >= 0.0f) & (t_min <= t_max) & (MACULA_LANES16 < (int16)((int)left));
    const float16 own = reach16(vload16(0, block->origin_x), vload16(0, block->origin_y),
                                vload16(0, block->origin_z));
    const float16 own_speed = reach16(dx, dy, dz);
    *reach = m_max(*reach, active ? own : *reach);
    *speed = m_max(*speed, active ? own_speed : *speed);
    return convert_uchar16(active ? ray_class : (int16)((int)INACTIVE));
}

/* A counting sort. Rays of a bin stay in order. */
static inline void sort_rays(global const RayBlock* blocks, uint count, QueuedRays* q) {
    uchar bin[MACULA_RAYS_PER_ITEM];
    uint next[BINS];
    float16 reach = 0x1p-20f, speed = 0.0f;
    for (uint i = 0u; i < count; i += MACULA_RAY_BLOCK) {
        global const RayBlock* block = blocks + i / MACULA_RAY_BLOCK;
        fetch_block(block + 4);
        vstore16(bins_of(block, count - i, &reach, &speed), 0, bin + i);
    }
    q->sizes.reach = greatest_lane16(reach);
    q->sizes.speed = greatest_lane16(speed);
    for (uint b = 0u; b < BINS; ++b)
        next[b] = 0u;
    for (uint i = 0u; i < count; ++i)
        ++next[bin[i]];
    q->begin[0] = 0u;
    for (uint b = 0u; b < BINS; ++b) {
        q->begin[b + 1u] = q->begin[b] + next[b];
        next[b] = q->begin[b];
    }
    for (uint i = 0u; i < count; i += MACULA_RAY_BLOCK) {
        float16 row[MACULA_RAY_BLOCK];
        prepare_rows(blocks + i / MACULA_RAY_BLOCK, i, row);
        const uint lanes = count - i < MACULA_RAY_BLOCK ? count - i : MACULA_RAY_BLOCK;
        for (uint lane = 0u; lane < lanes; ++lane) {
            const uint b = bin[i + lane], to = next[b]++;
            q->ray[to].row = row[lane];
            q->ray[to].value[MACULA_ROW_BIT] = as_float(1u << (to - q->begin[b]) % MACULA_CHUNK);
        }
    }
}

kernel void trace(TRACE_ARGUMENTS) {
    const uint first = first_of_spread(*ray_count, MACULA_RAYS_PER_ITEM);
    if (first >= *ray_count)
        return;
    const TraceScene scene = {nodes,
                              triangles,
                              instances,
                              upper_nodes,
                              {mask_slots, mask_triangles, mask_textures, mask_words}};
    const uint rest = *ray_count - first;
    QueuedRays queued;
    sort_rays(rays + first / MACULA_RAY_BLOCK,
              rest < MACULA_RAYS_PER_ITEM ? rest : MACULA_RAYS_PER_ITEM, &queued);
    trace_classes(&scene, rays, &queued, first, results);
    for (uint i = queued.begin[INACTIVE]; i < queued.begin[BINS]; ++i) {
        const TraceHit miss = no_hit(queued.ray[i].value[MACULA_ROW_T_MAX]);
        store_result(results, first + queue_index(queued.ray + i), &miss);
    }
}
