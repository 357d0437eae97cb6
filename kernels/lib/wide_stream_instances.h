/* A chunk of rays through the upper level. OpenCL C only. */
#ifndef MACULA_LIB_WIDE_STREAM_INSTANCES_H
#define MACULA_LIB_WIDE_STREAM_INSTANCES_H

#include "lib/traverse_binary.h"
#include "lib/traverse_queue.h"
#include "lib/wide_stream.h"

#if MACULA_INSTANCES
typedef struct StreamChunk {
    Stream stream;
    StreamRay object[MACULA_STREAM_LANES]; /* in the space of the instance being traversed */
    QueuedRay queued[MACULA_STREAM_LANES];
    TraceRay world[MACULA_STREAM_LANES];
} StreamChunk;

static inline void queue_ray(StreamChunk* chunk, uint k, QueuedRay q) {
    chunk->queued[k] = q;
    chunk->world[k] = make_trace_ray(q.ox, q.oy, q.oz, q.dx, q.dy, q.dz, q.t_min, q.t_max);
}

static inline StreamRay stream_ray(const TraceRay* r, uint k) {
    StreamRay ray;
    ray.row =
        (float16)(r->rx, r->ry, r->rz, r->nx, r->ny, r->nz, r->t_max, r->t_min,
                  pick_axis(r->kx, r->ox, r->oy, r->oz), pick_axis(r->ky, r->ox, r->oy, r->oz),
                  pick_axis(r->kz, r->ox, r->oy, r->oz), r->sx, r->sy, r->sz, as_float(1u << k),
                  0.0f);
    return ray;
}

/* Moves the rays that enter an instance's world box into its space; returns their sizes but for the
 * mesh's, and them by class. */
static inline StreamSizes enter_instance_of_rays(global const Instance* instance,
                                                 StreamChunk* chunk, uint rays,
                                                 uint of_class[MACULA_STREAM_CLASSES]) {
    Stream* s = &chunk->stream;
    StreamSizes sizes = {0x1p-20f, 0.0f, 0.0f};
    for (uint i = 0u; i < MACULA_STREAM_CLASSES; ++i)
        of_class[i] = 0u;
    for (; rays != 0u; rays &= rays - 1u) {
        const uint k = first_bit(rays);
        if (!enter_instance(chunk->world + k, instance, s->span + k))
            continue;
        const QueuedRay* q = chunk->queued + k;
        const TraceRay r = transform_ray(instance, q->ox, q->oy, q->oz, q->dx, q->dy, q->dz,
                                         q->t_min, chunk->world[k].t_max);
        chunk->object[k] = stream_ray(&r, k);
        sizes.reach = m_max(sizes.reach, m_max(m_max(fabs(r.ox), fabs(r.oy)), fabs(r.oz)));
        sizes.speed = m_max(sizes.speed, m_divide(1.0f, fabs(r.sz)));
        of_class[r.octant * 3u + r.kz] |= 1u << k;
    }
    return sizes;
}

/* Returns the rays whose query is answered. */
static inline uint traverse_instance_of_rays(const TraceScene* scene, StreamChunk* chunk,
                                             uint index, uint rays) {
    global const Instance* instance = scene->instances + index;
    Stream* s = &chunk->stream;
    uint of_class[MACULA_STREAM_CLASSES];
    StreamSizes sizes = enter_instance_of_rays(instance, chunk, rays, of_class);
    s->first_triangle = instance->first_triangle;
    s->mesh_triangle = instance->mesh_triangle;
    sizes.mesh = mesh_size((global const Wide8Node*)scene->nodes + instance->root);
    uint answered = 0u;
    for (uint i = 0u; i < MACULA_STREAM_CLASSES; ++i) {
        if (of_class[i] == 0u)
            continue;
        const StreamClass c = stream_class(i, &sizes);
        StreamWalk walk;
        start_walk(&walk, instance->root, of_class[i]);
        while (is_walking(&walk))
            step_walk(scene, s, &c, &walk);
        answered |= walk.answered;
    }
#if !MACULA_ANY_HIT
    for (; rays != 0u; rays &= rays - 1u) {
        const uint k = first_bit(rays);
        chunk->world[k].t_max = s->best[k].t;
    }
#endif
    return answered;
}

static inline void enter_binary_of_rays(global const BinaryNode* node, const StreamChunk* chunk,
                                        uint rays, uint of_child[2]) {
    of_child[0] = of_child[1] = 0u;
    for (; rays != 0u; rays &= rays - 1u) {
        const uint k = first_bit(rays);
        float near;
        of_child[0] |= enter_child(node, 0u, chunk->world + k, &near) ? 1u << k : 0u;
        of_child[1] |= enter_child(node, 1u, chunk->world + k, &near) ? 1u << k : 0u;
    }
}

/* Returns the rays whose query is answered. */
static inline uint trace_rays(const TraceScene* scene, StreamChunk* chunk, uint rays) {
    MaskedEntry stack[MACULA_MAX_DEPTH + 2];
    uint depth = 1u, answered = 0u;
    put_entry(stack, 0, 0u, (int)rays);
    while (depth != 0u) {
        const MaskedEntry entry = stack[--depth];
        const int child = (int)entry.child;
        const uint left = entry.mask & ~answered;
        if (left == 0u)
            continue;
        if (child < 0) {
            answered |= traverse_instance_of_rays(scene, chunk,
                                                  (uint)~child >> MACULA_LEAF_COUNT_BITS, left);
            continue;
        }
        global const BinaryNode* node = scene->upper_nodes + child;
        uint of_child[2];
        enter_binary_of_rays(node, chunk, left, of_child);
        for (uint i = 0u; i < 2u; ++i)
            if (of_child[i] != 0u)
                put_entry(stack, (int)depth++, (uint)node->child[i], (int)of_child[i]);
    }
    return answered;
}
#endif

#endif
