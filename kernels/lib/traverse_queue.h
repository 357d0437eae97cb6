/* A ray of a queue, and its result, for variants that handle rays one by one. OpenCL C only. */
#ifndef MACULA_LIB_TRAVERSE_QUEUE_H
#define MACULA_LIB_TRAVERSE_QUEUE_H

#include "lib/trace_contract.h"
#include "lib/triangle.h"

/* A ray as it lies in the queue: the instances' transforms start from these values. */
typedef struct QueuedRay {
    float ox, oy, oz, t_min;
    float dx, dy, dz, t_max;
} QueuedRay;

static inline QueuedRay load_ray(global const RayBlock* rays, uint i) {
    global const RayBlock* block = rays + i / MACULA_RAY_BLOCK;
    const uint lane = i % MACULA_RAY_BLOCK;
    QueuedRay r;
    r.ox = block->origin_x[lane];
    r.oy = block->origin_y[lane];
    r.oz = block->origin_z[lane];
    r.t_min = block->t_min[lane];
    r.dx = block->direction_x[lane];
    r.dy = block->direction_y[lane];
    r.dz = block->direction_z[lane];
    r.t_max = block->t_max[lane];
    return r;
}

static inline void store_result(global uint* results, uint i, const TraceHit* best) {
#if MACULA_ANY_HIT
    results[i] = best->triangle != MACULA_NO_TRIANGLE ? 1u : 0u;
#else
    global HitBlock* block = (global HitBlock*)results + i / MACULA_RAY_BLOCK;
    const uint lane = i % MACULA_RAY_BLOCK;
    block->t[lane] = unsigned_zero(best->t);
    block->u[lane] = unsigned_zero(best->u);
    block->v[lane] = unsigned_zero(best->v);
    block->triangle[lane] = best->triangle;
#endif
}

#endif
