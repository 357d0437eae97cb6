/* A packet of a queue through the whole scene. OpenCL C only. */
#ifndef MACULA_LIB_PACKET_SCENE_H
#define MACULA_LIB_PACKET_SCENE_H

#include "lib/packet_instances.h"
#include "lib/wide_single.h"

static inline void store_packet(global uint *results, uint first, uint count,
                                const PacketHit *best) {
    const uint lanes = count - first < MACULA_RAY_BLOCK ? count - first : MACULA_RAY_BLOCK;
#if MACULA_ANY_HIT
    const uint16 hit = best->triangle != (uint16)(MACULA_NO_TRIANGLE) ? (uint16)(1u) : (uint16)(0u);
    if (lanes == MACULA_RAY_BLOCK)
        vstore16(hit, 0, results + first);
    else
        for (uint i = 0u; i < lanes; ++i)
            results[first + i] = ((const uint *)&hit)[i];
#else
    global HitBlock *block = (global HitBlock *)results + first / MACULA_RAY_BLOCK;
    vstore16(best->t, 0, block->t);
    vstore16(best->u, 0, block->u);
    vstore16(best->v, 0, block->v);
    vstore16(best->triangle, 0, block->triangle);
#endif
}

static inline PacketHit no_hit16(float16 t_max) {
    PacketHit h;
    h.t = t_max;
    h.u = 0.0f;
    h.v = 0.0f;
    h.triangle = MACULA_NO_TRIANGLE;
    return h;
}

/* How much the directions of a packet may differ, relative to the largest component. */
#ifndef MACULA_COHERENT_SPREAD
#define MACULA_COHERENT_SPREAD 0.2f
#endif

/* True where tracing the lanes together saves work. */
static inline bool is_coherent16(const QueuedPacket *q) {
    const float16 ax = fabs(q->dx), ay = fabs(q->dy), az = fabs(q->dz);
    const float size = greatest_lane16(m_max16(m_max16(ax, ay), az));
    const float spread = (greatest_lane16(q->dx) - least_lane16(q->dx)) +
                         (greatest_lane16(q->dy) - least_lane16(q->dy)) +
                         (greatest_lane16(q->dz) - least_lane16(q->dz));
    return spread <= MACULA_COHERENT_SPREAD * size;
}

#if MACULA_INSTANCES
static inline void trace_coherent(const TraceScene *scene, const QueuedPacket *q, PacketHit *best) {
    traverse_instances16(scene, q, best);
}
#else
static inline void trace_coherent(const TraceScene *scene, const QueuedPacket *q, PacketHit *best) {
    Packet p = make_packet(q->ox, q->oy, q->oz, q->dx, q->dy, q->dz, q->t_min, q->t_max);
    const PacketInstance instance = instance_of(scene->instances);
    traverse_packet(scene, &instance, &p, best, scene->instances[0].root);
}
#endif

static inline void trace_packet(const TraceScene *scene, global const RayBlock *rays, uint first,
                                uint count, global uint *results) {
    global const RayBlock *block = rays + first / MACULA_RAY_BLOCK;
    PacketHit best = no_hit16(vload16(0, block->t_max));
    QueuedPacket q;
    if (load_packet(block, count - first, &q)) {
        if (!is_coherent16(&q)) {
            trace_single_rays(scene, rays, first, count, results);
            return;
        }
        trace_coherent(scene, &q, &best);
    }
    store_packet(results, first, count, &best);
}

#endif
