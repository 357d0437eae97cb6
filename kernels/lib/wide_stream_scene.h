/* A chunk of rays through the whole scene: lib/traverse_scene.h for several rays at once. OpenCL C
 * only. */
#ifndef MACULA_LIB_WIDE_STREAM_SCENE_H
#define MACULA_LIB_WIDE_STREAM_SCENE_H

#include "lib/wide_stream_instances.h"

/* The rays of a work-item, sorted by class. */
typedef struct QueuedRays {
    StreamRay ray[MACULA_RAYS_PER_ITEM];
    StreamSizes sizes; /* of the active ones */
} QueuedRays;

static inline uint queue_index(const StreamRay* ray) {
    return as_uint(ray->value[MACULA_ROW_INDEX]);
}

static inline uint mask_of(uint count) {
    return count >= 32u ? ~0u : (1u << count) - 1u;
}

static inline void start_chunk(Stream* s, StreamRay* rays, uint count) {
    s->ray = rays;
    s->first_triangle = 0u;
    s->mesh_triangle = 0u;
#if !MACULA_ANY_HIT
    for (uint k = 0u; k < count; ++k)
        s->best[k] = no_hit(rays[k].value[MACULA_ROW_T_MAX]);
#endif
}

/* `rays`: the chunk as it was queued; `first`: the work-item's first ray. */
static inline void store_chunk(const Stream* s, const StreamRay* rays, uint count, uint answered,
                               uint first, global uint* results) {
    for (uint k = 0u; k < count; ++k) {
        const uint i = first + queue_index(rays + k);
#if MACULA_ANY_HIT
        results[i] = (answered >> k) & 1u;
#else
        store_result(results, i, s->best + k);
#endif
    }
}

#if MACULA_INSTANCES
/* Traces the rays in [begin, end) of those that are sorted, all of one class. */
static inline void trace_class(const TraceScene* scene, global const RayBlock* rays, QueuedRays* q,
                               uint begin, uint end, uint class_index, uint first,
                               global uint* results) {
    while (begin < end) {
        StreamChunk chunk;
        const uint count = end - begin < MACULA_CHUNK ? end - begin : MACULA_CHUNK;
        start_chunk(&chunk.stream, q->ray + begin, count);
        for (uint k = 0u; k < count; ++k)
            queue_ray(&chunk, k, load_ray(rays, first + queue_index(q->ray + begin + k)));
        chunk.stream.ray = chunk.object;
        const uint answered = trace_rays(scene, &chunk, mask_of(count));
        store_chunk(&chunk.stream, q->ray + begin, count, answered, first, results);
        begin += count;
    }
}
#else
/* Traces the rays in [begin, end) of those that are sorted, all of one class. */
static inline void trace_class(const TraceScene* scene, global const RayBlock* rays, QueuedRays* q,
                               uint begin, uint end, uint class_index, uint first,
                               global uint* results) {
    const int root = scene->instances[0].root;
    q->sizes.mesh = mesh_size((global const Wide8Node*)scene->nodes + root);
    const StreamClass c = stream_class(class_index, &q->sizes);
    while (begin < end) {
        Stream s[MACULA_STREAM_CHUNKS];
        StreamWalk walk[MACULA_STREAM_CHUNKS];
        uint count[MACULA_STREAM_CHUNKS];
        for (uint i = 0u; i < MACULA_STREAM_CHUNKS; ++i) {
            count[i] = end - begin < MACULA_CHUNK ? end - begin : MACULA_CHUNK;
            start_chunk(s + i, q->ray + begin, count[i]);
            start_walk(walk + i, root, mask_of(count[i]));
            begin += count[i];
        }
        traverse_stream(scene, s, &c, walk);
        for (uint i = 0u; i < MACULA_STREAM_CHUNKS; ++i)
            store_chunk(s + i, s[i].ray, count[i], walk[i].answered, first, results);
    }
}
#endif

#endif
