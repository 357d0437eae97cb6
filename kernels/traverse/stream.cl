/* Many rays a work-item, for CPUs: rays that have little in common are sorted by class, which is
 * their octant and dominant axis, and traced in chunks of up to 32 that share the loads of nodes
 * and triangles (after Tsakok 2009, "Faster Incoherent Rays: Multi-BVH Ray Stream Tracing"). */
#include "lib/wide_stream_scene.h"

/* The rays that are not active come after the classes. */
#define INACTIVE MACULA_STREAM_CLASSES
#define BINS (MACULA_STREAM_CLASSES + 1u)

/* The bins of a block of which `left` rays are in the queue. */
static inline uchar16 bins_of(global const RayBlock* block, uint left) {
    const float16 dx = bounded_direction16(vload16(0, block->direction_x));
    const float16 dy = bounded_direction16(vload16(0, block->direction_y));
    const float16 dz = bounded_direction16(vload16(0, block->direction_z));
    const float16 t_min = vload16(0, block->t_min), t_max = vload16(0, block->t_max);
    const int16 octant = ((dx < 0.0f) & 1) | ((dy < 0.0f) & 2) | ((dz < 0.0f) & 4);
    const int16 ray_class = octant * 3 + dominant_axis16(dx, dy, dz);
    const int16 active = (t_min >= 0.0f) & (t_min <= t_max) & (MACULA_LANES16 < (int16)((int)left));
    return convert_uchar16(active ? ray_class : (int16)((int)INACTIVE));
}

static inline void copy_ray(global const RayBlock* block, uint lane, QueuedRays* q, uint to) {
    q->o[0][to] = block->origin_x[lane];
    q->o[1][to] = block->origin_y[lane];
    q->o[2][to] = block->origin_z[lane];
    q->d[0][to] = block->direction_x[lane];
    q->d[1][to] = block->direction_y[lane];
    q->d[2][to] = block->direction_z[lane];
    q->t_min[to] = block->t_min[lane];
    q->t_max[to] = block->t_max[lane];
}

/* A counting sort: bin b of the rays goes to [begin[b], begin[b + 1]), in order. */
static inline void sort_rays(global const RayBlock* blocks, uint count, QueuedRays* q,
                             uint begin[BINS + 1u]) {
    uchar bin[MACULA_RAYS_PER_ITEM];
    uint next[BINS];
    for (uint i = 0u; i < count; i += MACULA_RAY_BLOCK)
        vstore16(bins_of(blocks + i / MACULA_RAY_BLOCK, count - i), 0, bin + i);
    for (uint b = 0u; b < BINS; ++b)
        next[b] = 0u;
    for (uint i = 0u; i < count; ++i)
        ++next[bin[i]];
    begin[0] = 0u;
    for (uint b = 0u; b < BINS; ++b) {
        begin[b + 1u] = begin[b] + next[b];
        next[b] = begin[b];
    }
    q->reach = 0x1p-20f;
    for (uint i = 0u; i < count; ++i) {
        const uint to = next[bin[i]]++;
        copy_ray(blocks + i / MACULA_RAY_BLOCK, i % MACULA_RAY_BLOCK, q, to);
        q->index[to] = (ushort)i;
        const float reach = m_max(m_max(fabs(q->o[0][to]), fabs(q->o[1][to])), fabs(q->o[2][to]));
        q->reach = bin[i] != INACTIVE && reach > q->reach ? reach : q->reach;
    }
    for (uint i = 0u; i < MACULA_STREAM_LANES; ++i)
        copy_ray(blocks, 0u, q, count + i);
}

kernel void trace(TRACE_ARGUMENTS) {
    const uint first = (uint)get_global_id(0) * MACULA_RAYS_PER_ITEM;
    if (first >= *ray_count)
        return;
    const TraceScene scene = {nodes,
                              triangles,
                              instances,
                              upper_nodes,
                              {mask_slots, mask_triangles, mask_textures, mask_words}};
    const uint rest = *ray_count - first;
    QueuedRays queued;
    uint begin[BINS + 1u];
    sort_rays(rays + first / MACULA_RAY_BLOCK,
              rest < MACULA_RAYS_PER_ITEM ? rest : MACULA_RAYS_PER_ITEM, &queued, begin);
    for (uint i = 0u; i < INACTIVE; ++i)
        trace_class(&scene, &queued, begin[i], begin[i + 1u], i, first, results);
    for (uint i = begin[INACTIVE]; i < begin[BINS]; ++i) {
        const TraceHit miss = no_hit(queued.t_max[i]);
        store_result(results, first + queued.index[i], &miss);
    }
}
