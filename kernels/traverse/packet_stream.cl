/* Packets of sixteen rays in a stream, for CPUs: a work-item takes several packets through the tree
 * together and tests their frusta only, which is fastest for camera rays (after Wald, Boulos and
 * Shirley 2007, section 4, and Tsakok 2009). Rays that have little in common are traced one by
 * one, so that no queue is a hazard. */
#include "lib/packet_scene.h"
#include "lib/packet_stream.h"

/* Loads packet k; false when it needs no tracing in the stream. */
static inline bool prepare_packet(const TraceScene *scene, global const RayBlock *rays, uint first,
                                  uint count, global uint *results, PacketStream *stream, uint k) {
    global const RayBlock *block = rays + first / MACULA_RAY_BLOCK;
    PacketHit *best = stream->best + k;
    *best = no_hit16(vload16(0, block->t_max));
    QueuedPacket q;
    if (load_packet(block, count - first, &q)) {
        if (!is_coherent16(&q)) {
            trace_single_rays(scene, rays, first, count, results);
            return false;
        }
#if MACULA_INSTANCES
        trace_coherent(scene, &q, best);
#else
        stream->packet[k] = make_packet(q.ox, q.oy, q.oz, q.dx, q.dy, q.dz, q.t_min, q.t_max);
        stream->frustum[k] = make_frustum(stream->packet + k);
        return true;
#endif
    }
    store_packet(results, first, count, best);
    return false;
}

kernel void trace(TRACE_ARGUMENTS) {
    const uint first = (uint)get_global_id(0) * MACULA_RAYS_PER_ITEM;
    const uint count = *ray_count;
    if (first >= count)
        return;
    const TraceScene scene = MACULA_TRACE_SCENE;
    PacketStream stream;
    uint of_octant[8] = {0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u};
    uint packets = 0u;
    for (uint k = 0u; k < MACULA_PACKETS && first + k * 16u < count; ++k)
        if (prepare_packet(&scene, rays, first + k * 16u, count, results, &stream, k)) {
            of_octant[stream.frustum[k].octant] |= 1u << k;
            packets |= 1u << k;
        }
    const PacketInstance instance = instance_of(instances);
    for (uint octant = 0u; octant < 8u; ++octant)
        if (of_octant[octant] != 0u)
            traverse_packets(&scene, &instance, &stream, instances[0].root, of_octant[octant],
                             octant);
    for (; packets != 0u; packets &= packets - 1u) {
        const uint k = first_bit(packets);
        store_packet(results, first + k * 16u, count, stream.best + k);
    }
}
