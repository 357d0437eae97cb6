/* A chunk of rays through the whole scene: lib/traverse_scene.h for several rays at once. OpenCL C
 * only. */
#ifndef MACULA_LIB_WIDE_STREAM_SCENE_H
#define MACULA_LIB_WIDE_STREAM_SCENE_H

#include "lib/traverse_binary.h"
#include "lib/traverse_queue.h"
#include "lib/wide_stream.h"

/* Rays as they lie in the queue, side by side; whole chunks may be read from every ray on. */
#define MACULA_QUEUED_RAYS (MACULA_RAYS_PER_ITEM + MACULA_STREAM_LANES)
typedef struct QueuedRays {
    float o[3][MACULA_QUEUED_RAYS], d[3][MACULA_QUEUED_RAYS];
    float t_min[MACULA_QUEUED_RAYS], t_max[MACULA_QUEUED_RAYS];
    ushort index[MACULA_QUEUED_RAYS]; /* in the queue, less that of the work-item's first */
    float reach;                      /* largest origin component in size of the active ones */
} QueuedRays;

/* make_trace_ray for the lanes from `lane` on, from the rays at `from`. */
static inline void prepare_rays16(const QueuedRays* q, uint from, Stream* s, const StreamClass* c,
                                  uint lane) {
    const float16 o[3] = {vload16(0, q->o[0] + from), vload16(0, q->o[1] + from),
                          vload16(0, q->o[2] + from)};
    const float16 margin = MACULA_RAY_MARGIN * reach16(o[0], o[1], o[2]);
    for (uint axis = 0u; axis < 3u; ++axis) {
        const float16 r =
            m_divide((float16)(1.0f), bounded_direction16(vload16(0, q->d[axis] + from)));
        vstore16(r, 0, s->r[axis] + lane);
        vstore16(fma(fabs(r), -margin, -(o[axis] * r)), 0, s->n[axis] + lane);
        vstore16(o[axis], 0, s->o[axis] + lane);
    }
    const float16 sz = vload16(0, s->r[c->kz] + lane);
    const float16 dx = bounded_direction16(vload16(0, q->d[c->kx] + from));
    const float16 dy = bounded_direction16(vload16(0, q->d[c->ky] + from));
    vstore16(dx * sz, 0, s->sx + lane);
    vstore16(dy * sz, 0, s->sy + lane);
    vstore16(vload16(0, q->t_min + from), 0, s->t_min + lane);
    vstore16(vload16(0, q->t_max + from), 0, s->t_max + lane);
}

#if MACULA_INSTANCES
typedef struct StreamChunk {
    Stream stream;
    const QueuedRays* queued;
    uint begin; /* of the chunk's rays in `queued` */
    TraceRay world[MACULA_STREAM_LANES];
} StreamChunk;

static inline void set_stream_ray(Stream* s, uint k, const TraceRay* r) {
    s->r[0][k] = r->rx;
    s->r[1][k] = r->ry;
    s->r[2][k] = r->rz;
    s->n[0][k] = r->nx;
    s->n[1][k] = r->ny;
    s->n[2][k] = r->nz;
    s->o[0][k] = r->ox;
    s->o[1][k] = r->oy;
    s->o[2][k] = r->oz;
    s->sx[k] = r->sx;
    s->sy[k] = r->sy;
    s->t_min[k] = r->t_min;
    s->t_max[k] = r->t_max;
}

/* Moves the rays that enter an instance's world box into its space; returns their greatest reach,
 * and them by class. */
static inline float enter_instance_of_rays(global const Instance* instance, StreamChunk* chunk,
                                           uint rays, uint of_class[MACULA_STREAM_CLASSES]) {
    const QueuedRays* q = chunk->queued;
    Stream* s = &chunk->stream;
    float reach = 0x1p-20f;
    for (uint i = 0u; i < MACULA_STREAM_CLASSES; ++i)
        of_class[i] = 0u;
    for (; rays != 0u; rays &= rays - 1u) {
        const uint k = first_bit(rays);
        if (!enter_instance(chunk->world + k, instance, s->span + k))
            continue;
        const uint i = chunk->begin + k;
        const TraceRay r = transform_ray(instance, q->o[0][i], q->o[1][i], q->o[2][i], q->d[0][i],
                                         q->d[1][i], q->d[2][i], q->t_min[i], s->best[k].t);
        set_stream_ray(s, k, &r);
        reach = m_max(reach, m_max(m_max(fabs(r.ox), fabs(r.oy)), fabs(r.oz)));
        of_class[r.octant * 3u + r.kz] |= 1u << k;
    }
    return reach;
}

/* Returns the rays whose query is answered. */
static inline uint traverse_instance_of_rays(const TraceScene* scene, StreamChunk* chunk,
                                             uint index, uint rays) {
    global const Instance* instance = scene->instances + index;
    Stream* s = &chunk->stream;
    uint of_class[MACULA_STREAM_CLASSES];
    const float reach = enter_instance_of_rays(instance, chunk, rays, of_class);
    s->first_triangle = instance->first_triangle;
    s->mesh_triangle = instance->mesh_triangle;
    uint answered = 0u;
    for (uint i = 0u; i < MACULA_STREAM_CLASSES; ++i) {
        if (of_class[i] == 0u)
            continue;
        const StreamClass c = stream_class(i, reach);
        StreamWalk walk[MACULA_STREAM_CHUNKS];
        start_walk(walk, instance->root, of_class[i]);
        start_walk(walk + 1, instance->root, 0u);
        traverse_stream(scene, s, &c, walk);
        answered |= walk[0].answered;
    }
    for (; rays != 0u; rays &= rays - 1u) {
        const uint k = first_bit(rays);
        chunk->world[k].t_max = s->best[k].t;
    }
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

static inline void trace_rays(const TraceScene* scene, StreamChunk* chunk, uint rays) {
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
}
#endif

static inline uint mask_of(uint count) {
    return count >= 32u ? ~0u : (1u << count) - 1u;
}

static inline void store_chunk(const QueuedRays* q, uint begin, uint count, uint first,
                               const Stream* s, global uint* results) {
    for (uint k = 0u; k < count; ++k)
        store_result(results, first + q->index[begin + k], &s->best[k]);
}

#if MACULA_INSTANCES
/* Traces the `count` rays from `begin` on, all of one class. */
static inline void trace_chunk(const TraceScene* scene, const QueuedRays* q, uint begin, uint count,
                               uint first, global uint* results) {
    StreamChunk chunk;
    Stream* s = &chunk.stream;
    chunk.queued = q;
    chunk.begin = begin;
    for (uint k = 0u; k < count; ++k) {
        const uint i = begin + k;
        chunk.world[k] = make_trace_ray(q->o[0][i], q->o[1][i], q->o[2][i], q->d[0][i], q->d[1][i],
                                        q->d[2][i], q->t_min[i], q->t_max[i]);
        s->best[k] = no_hit(q->t_max[i]);
    }
    trace_rays(scene, &chunk, mask_of(count));
    store_chunk(q, begin, count, first, s, results);
}

static inline void trace_class(const TraceScene* scene, const QueuedRays* q, uint begin, uint end,
                               uint class_index, uint first, global uint* results) {
    for (; begin < end; begin += MACULA_CHUNK)
        trace_chunk(scene, q, begin, end - begin < MACULA_CHUNK ? end - begin : MACULA_CHUNK, first,
                    results);
}
#else
static inline void prepare_chunk(const QueuedRays* q, uint begin, Stream* s, const StreamClass* c) {
    prepare_rays16(q, begin, s, c, 0u);
    prepare_rays16(q, begin + 16u, s, c, 16u);
    for (uint k = 0u; k < MACULA_STREAM_LANES; ++k)
        s->best[k] = no_hit(s->t_max[k]);
    s->first_triangle = 0u;
    s->mesh_triangle = 0u;
}

/* Traces the rays in [begin, end), all of one class. */
static inline void trace_class(const TraceScene* scene, const QueuedRays* q, uint begin, uint end,
                               uint class_index, uint first, global uint* results) {
    const int root = scene->instances[0].root;
    const StreamClass c = stream_class(class_index, q->reach);
    while (begin < end) {
        Stream s[MACULA_STREAM_CHUNKS];
        StreamWalk walk[MACULA_STREAM_CHUNKS];
        uint count[MACULA_STREAM_CHUNKS];
        uint next = begin;
        for (uint i = 0u; i < MACULA_STREAM_CHUNKS; ++i) {
            count[i] = end - next < MACULA_CHUNK ? end - next : MACULA_CHUNK;
            prepare_chunk(q, next, s + i, &c);
            start_walk(walk + i, root, mask_of(count[i]));
            next += count[i];
        }
        traverse_stream(scene, s, &c, walk);
        for (uint i = 0u; i < MACULA_STREAM_CHUNKS; ++i) {
            store_chunk(q, begin, count[i], first, s + i, results);
            begin += count[i];
        }
    }
}
#endif

#endif
