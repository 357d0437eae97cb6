/* A chunk of rays through the whole scene: lib/traverse_scene.h for several rays at once. OpenCL C
 * only. */
#ifndef MACULA_LIB_WIDE_STREAM_SCENE_H
#define MACULA_LIB_WIDE_STREAM_SCENE_H

#include "lib/wide_stream_instances.h"

/* The rays of a work-item, sorted by class. */
typedef struct QueuedRays {
    StreamRay ray[MACULA_RAYS_PER_ITEM];
    /* Class c is [begin[c], begin[c + 1]); those that are not active come last. */
    uint begin[MACULA_STREAM_CLASSES + 2u];
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
    s->t_max[0] = s->t_max[1] = -1.0f;
    for (uint k = 0u; k < count; ++k) {
        const float t_max = rays[k].value[MACULA_ROW_T_MAX];
        s->best[k] = no_hit(t_max);
        ((float*)s->t_max)[k] = t_max;
    }
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
/* Traces the rays of all classes. */
static inline void trace_classes(const TraceScene* scene, global const RayBlock* rays,
                                 QueuedRays* q, uint first, global uint* results) {
    for (uint i = 0u; i < MACULA_STREAM_CLASSES; ++i) {
        for (uint begin = q->begin[i]; begin < q->begin[i + 1u]; begin += MACULA_CHUNK) {
            StreamChunk chunk;
            const uint rest = q->begin[i + 1u] - begin;
            const uint count = rest < MACULA_CHUNK ? rest : MACULA_CHUNK;
            start_chunk(&chunk.stream, q->ray + begin, count);
            for (uint k = 0u; k < count; ++k)
                queue_ray(&chunk, k, load_ray(rays, first + queue_index(q->ray + begin + k)));
            chunk.stream.ray = chunk.object;
            const uint answered = trace_rays(scene, &chunk, mask_of(count));
            store_chunk(&chunk.stream, q->ray + begin, count, answered, first, results);
        }
    }
}
#else
/* A chunk under way. */
typedef struct ChunkWalk {
    Stream stream;
    StreamClass ray_class;
    StreamWalk walk;
    uint count;
} ChunkWalk;

/* Starts the chunk of rays from *begin on, of class *ray_class or a later one, if there is one, and
 * moves both behind it. */
static inline void start_next_chunk(const TraceScene* scene, QueuedRays* q, uint* ray_class,
                                    uint* begin, ChunkWalk* chunk) {
    while (*ray_class < MACULA_STREAM_CLASSES && *begin == q->begin[*ray_class + 1u])
        ++*ray_class;
    chunk->count = 0u;
    if (*ray_class == MACULA_STREAM_CLASSES)
        return;
    const uint rest = q->begin[*ray_class + 1u] - *begin;
    chunk->count = rest < MACULA_CHUNK ? rest : MACULA_CHUNK;
    chunk->ray_class = stream_class(*ray_class, &q->sizes);
    start_chunk(&chunk->stream, q->ray + *begin, chunk->count);
    start_walk(&chunk->walk, scene->instances[0].root, mask_of(chunk->count));
    *begin += chunk->count;
}

/* Visits what is on top of a chunk's stack; when that was the last, starts another chunk. */
static inline void step_chunk(const TraceScene* scene, QueuedRays* q, uint* ray_class, uint* begin,
                              ChunkWalk* chunk, uint first, global uint* results) {
    step_walk(scene, &chunk->stream, &chunk->ray_class, &chunk->walk);
    if (is_walking(&chunk->walk))
        return;
    store_chunk(&chunk->stream, chunk->stream.ray, chunk->count, chunk->walk.answered, first,
                results);
    start_next_chunk(scene, q, ray_class, begin, chunk);
}

/* Traces the rays of all classes. Several chunks are advanced in turn: while one waits for what it
 * asked of memory, or for its tests, the others compute. */
static inline void trace_classes(const TraceScene* scene, global const RayBlock* rays,
                                 QueuedRays* q, uint first, global uint* results) {
    const int root = scene->instances[0].root;
    q->sizes.mesh = mesh_size((global const Wide8Node*)scene->nodes + root);
    uint ray_class = 0u, begin = 0u;
    ChunkWalk chunk[MACULA_CHUNKS_IN_TURN];
    for (uint i = 0u; i < MACULA_CHUNKS_IN_TURN; ++i)
        start_next_chunk(scene, q, &ray_class, &begin, chunk + i);
    uint busy;
    do {
        busy = 0u;
#pragma unroll
        for (uint i = 0u; i < MACULA_CHUNKS_IN_TURN; ++i) {
            if (chunk[i].count == 0u)
                continue;
            step_chunk(scene, q, &ray_class, &begin, chunk + i, first, results);
            busy = 1u;
        }
    } while (busy != 0u);
}
#endif

#endif
