/* A packet of a queue through the whole scene. OpenCL C only. */
#ifndef MACULA_LIB_PACKET_SCENE_H
#define MACULA_LIB_PACKET_SCENE_H

#include "lib/packet_instances.h"
#include "lib/wide_single.h"

/* unsigned_zero of lib/triangle.h. */
static inline float16 unsigned_zero16(float16 x) {
    return as_uint16(x) == (uint16)(0x80000000u) ? (float16)(0.0f) : x;
}

static inline void store_packet(global uint* results, uint first, uint count,
                                const PacketHit* best) {
    const uint lanes = count - first < MACULA_RAY_BLOCK ? count - first : MACULA_RAY_BLOCK;
#if MACULA_ANY_HIT
    const uint16 hit = best->triangle != (uint16)(MACULA_NO_TRIANGLE) ? (uint16)(1u) : (uint16)(0u);
    if (lanes == MACULA_RAY_BLOCK)
        vstore16(hit, 0, results + first);
    else
        for (uint i = 0u; i < lanes; ++i)
            results[first + i] = ((const uint*)&hit)[i];
#else
    global HitBlock* block = (global HitBlock*)results + first / MACULA_RAY_BLOCK;
    vstore16(unsigned_zero16(best->t), 0, block->t);
    vstore16(unsigned_zero16(best->u), 0, block->u);
    vstore16(unsigned_zero16(best->v), 0, block->v);
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

/* Sums of the spreads of the direction components, relative to the greatest component. Above the
 * first, rays are traced one by one; above the second, lanes are tested at every node and not only
 * at leaves. Rays towards a light have several origins, and so looser frusta. */
#define MACULA_COHERENT_SPREAD 1.0f
#define MACULA_WIDE_SPREAD (MACULA_ANY_HIT ? 0.001f : 0.02f)

static inline float spread_of(const PacketBounds* b) {
    float size = 0.0f, spread = 0.0f;
    for (uint axis = 0u; axis < 3u; ++axis) {
        size = m_max(size, m_max(-b->d_lo[axis], b->d_hi[axis]));
        spread += b->d_hi[axis] - b->d_lo[axis];
    }
    return m_divide(spread, size);
}

static inline void trace_coherent(const TraceScene* scene, const QueuedPacket* q, Packet* p,
                                  const PacketBounds* bounds, PacketHit* best) {
#if MACULA_INSTANCES
    traverse_instances16(scene, q, p, best);
#else
    const PacketInstance instance = instance_of(scene, scene->instances);
    traverse_packet(scene, &instance, p, bounds, best, scene->instances[0].root);
#endif
}

static inline void trace_packet(const TraceScene* scene, global const RayBlock* rays, uint first,
                                uint count, global uint* results) {
    global const RayBlock* block = rays + first / MACULA_RAY_BLOCK;
    PacketHit best = no_hit16(vload16(0, block->t_max));
    fetch_block(block + 1);
    QueuedPacket q;
    if (load_packet(block, count - first, &q)) {
        Packet p;
        const PacketBounds bounds = make_packet(&q, &p);
        if (spread_of(&bounds) > MACULA_COHERENT_SPREAD) {
            trace_single_rays(scene, rays, first, count, results);
            return;
        }
        trace_coherent(scene, &q, &p, &bounds, &best);
    }
    store_packet(results, first, count, &best);
}

#endif
