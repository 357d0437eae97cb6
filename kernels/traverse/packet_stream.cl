/* Packets of sixteen rays in a stream, for CPUs: a work-item takes several packets through the tree
 * together and tests their frusta only, which is fastest for camera rays (after Wald, Boulos and
 * Shirley 2007, section 4, and Tsakok 2009). Rays that have little in common are traced one by
 * one, so that no queue is a hazard. */
#include "lib/packet_scene.h"
#include "lib/packet_stream.h"

/* Loads packet k; false when it needs no tracing in the stream. */
static inline bool prepare_packet(const TraceScene* scene, global const RayBlock* rays, uint first,
                                  uint count, global uint* results, PacketStream* stream, uint k) {
    global const RayBlock* block = rays + first / MACULA_RAY_BLOCK;
    Packet* p = stream->packet + k;
    PacketHit* best = stream->best + k;
    *best = no_hit16(vload16(0, block->t_max));
    QueuedPacket q;
    if (load_packet(block, count - first, &q)) {
        const PacketBounds bounds = make_packet(&q, p);
        const float spread = spread_of(&bounds);
        if (spread > MACULA_COHERENT_SPREAD) {
            trace_single_rays(scene, rays, first, count, results);
            return false;
        }
#if MACULA_INSTANCES
        trace_coherent(scene, &q, p, &bounds, best);
#else
        stream->frustum[k] = make_frustum(&bounds);
        stream->margin = m_max(stream->margin, p->margin);
        stream->wide |= spread > MACULA_WIDE_SPREAD ? 1u << k : 0u;
        return true;
#endif
    }
    store_packet(results, first, count, best);
    return false;
}

kernel void trace(TRACE_ARGUMENTS) {
    const uint count = *ray_count, first = first_of_spread(count, MACULA_RAYS_PER_ITEM);
    if (first >= count)
        return;
    const TraceScene scene = MACULA_TRACE_SCENE;
    PacketStream stream;
    stream.margin = 0.0f;
    stream.wide = 0u;
    /* The octants, those of packets with directions of both signs along some axis, and again both
     * of packets that are bound from their ends. */
    uint of_octant[32] = {0u};
    uint packets = 0u;
    for (uint k = 0u; k < MACULA_PACKETS && first + k * 16u < count; ++k) {
        fetch_block(rays + (first / 16u + MACULA_PACKETS + k));
        if (prepare_packet(&scene, rays, first + k * 16u, count, results, &stream, k)) {
            const Packet* p = stream.packet + k;
            of_octant[p->frustum_octant + (p->mixed ? 8u : 0u) + (p->turned ? 16u : 0u)] |= 1u << k;
            packets |= 1u << k;
        }
    }
    const PacketInstance instance = instance_of(&scene, instances);
    for (uint i = 0u; i < (MACULA_ANY_HIT ? 32u : 16u); ++i)
        if (of_octant[i] != 0u)
            traverse_packets(&scene, &instance, &stream, instances[0].root, of_octant[i],
                             (i & 7u) ^ (i >= 16u ? 7u : 0u), i & 7u, (i & 8u) != 0u);
    for (; packets != 0u; packets &= packets - 1u) {
        const uint k = first_bit(packets);
        store_packet(results, first + k * 16u, count, stream.best + k);
    }
}
