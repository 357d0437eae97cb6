/* A chunk of rays through the whole scene: lib/traverse_scene.h for several rays at once. OpenCL C
 * only. */
#ifndef MACULA_LIB_WIDE_STREAM_SCENE_H
#define MACULA_LIB_WIDE_STREAM_SCENE_H

#include "lib/traverse_binary.h"
#include "lib/traverse_queue.h"
#include "lib/wide_stream.h"

typedef struct StreamChunk {
    StreamRay stream[MACULA_CHUNK];
#if MACULA_INSTANCES
    QueuedRay queued[MACULA_CHUNK];
    TraceRay world[MACULA_CHUNK];
#endif
} StreamChunk;

static inline TraceRay trace_ray_of(const QueuedRay* q) {
    return make_trace_ray(q->ox, q->oy, q->oz, q->dx, q->dy, q->dz, q->t_min, q->t_max);
}

#if MACULA_INSTANCES
/* Moves the rays that enter an instance's world box into its space; returns them by octant. */
static inline void enter_instance_of_rays(global const Instance* instance, StreamChunk* c,
                                          uint rays, uint of_octant[8]) {
    for (uint i = 0u; i < 8u; ++i)
        of_octant[i] = 0u;
    for (; rays != 0u; rays &= rays - 1u) {
        const uint k = first_ray(rays);
        TraceQuery* query = &c->stream[k].query;
        const QueuedRay* q = c->queued + k;
        if (!enter_instance(c->world + k, instance, &query->span))
            continue;
        query->ray = transform_ray(instance, q->ox, q->oy, q->oz, q->dx, q->dy, q->dz, q->t_min,
                                   query->best.t);
        query->first_triangle = instance->first_triangle;
        query->mesh_triangle = instance->mesh_triangle;
        permute_origin(c->stream + k);
        of_octant[query->ray.octant] |= 1u << k;
    }
}

/* Returns the rays whose query is answered. */
static inline uint traverse_instance_of_rays(const TraceScene* scene, StreamChunk* c, uint index,
                                             uint rays) {
    global const Instance* instance = scene->instances + index;
    uint of_octant[8];
    enter_instance_of_rays(instance, c, rays, of_octant);
    uint answered = 0u;
    for (uint octant = 0u; octant < 8u; ++octant)
        if (of_octant[octant] != 0u)
            answered |=
                traverse_stream(scene, c->stream, instance->root, of_octant[octant], octant);
    for (; rays != 0u; rays &= rays - 1u) {
        const uint k = first_ray(rays);
        c->world[k].t_max = c->stream[k].query.best.t;
    }
    return answered;
}

static inline void enter_binary_of_rays(global const BinaryNode* node, const StreamChunk* c,
                                        uint rays, uint of_child[2]) {
    of_child[0] = of_child[1] = 0u;
    for (; rays != 0u; rays &= rays - 1u) {
        const uint k = first_ray(rays);
        float near;
        of_child[0] |= enter_child(node, 0u, c->world + k, &near) ? 1u << k : 0u;
        of_child[1] |= enter_child(node, 1u, c->world + k, &near) ? 1u << k : 0u;
    }
}

static inline void trace_rays(const TraceScene* scene, StreamChunk* c, uint rays, uint octant) {
    StreamEntry stack[MACULA_MAX_DEPTH + 2];
    uint depth = 1u, answered = 0u;
    stack[0].child = 0;
    stack[0].rays = rays;
    (void)octant; /* that of the world rays; an instance's space has its own */
    while (depth != 0u) {
        const StreamEntry entry = stack[--depth];
        const uint left = entry.rays & ~answered;
        if (left == 0u)
            continue;
        if (entry.child < 0) {
            answered |= traverse_instance_of_rays(
                scene, c, (uint)~entry.child >> MACULA_LEAF_COUNT_BITS, left);
            continue;
        }
        global const BinaryNode* node = scene->upper_nodes + entry.child;
        uint of_child[2];
        enter_binary_of_rays(node, c, left, of_child);
        for (uint i = 0u; i < 2u; ++i)
            if (of_child[i] != 0u) {
                stack[depth].child = node->child[i];
                stack[depth++].rays = of_child[i];
            }
    }
}
#else
static inline void trace_rays(const TraceScene* scene, StreamChunk* c, uint rays, uint octant) {
    traverse_stream(scene, c->stream, scene->instances[0].root, rays, octant);
}
#endif

/* Traces `count` active rays of one octant, given by their numbers less `first`. */
static inline void trace_chunk(const TraceScene* scene, global const RayBlock* rays, uint first,
                               const ushort* order, uint count, uint octant, global uint* results) {
    StreamChunk c;
    for (uint k = 0u; k < count; ++k) {
        const QueuedRay queued = load_ray(rays, first + order[k]);
        TraceQuery* query = &c.stream[k].query;
        query->best = no_hit(queued.t_max);
        query->ray = trace_ray_of(&queued);
        query->first_triangle = 0u;
        query->mesh_triangle = 0u;
        permute_origin(c.stream + k);
#if MACULA_INSTANCES
        c.queued[k] = queued;
        c.world[k] = query->ray;
#endif
    }
    trace_rays(scene, &c, count == 32u ? ~0u : (1u << count) - 1u, octant);
    for (uint k = 0u; k < count; ++k)
        store_result(results, first + order[k], &c.stream[k].query.best);
}

#endif
