/* A packet through the upper level: the loop over instances, each lane as in lib/instance.h and
 * lib/traverse_scene.h. OpenCL C only. */
#ifndef MACULA_LIB_PACKET_INSTANCES_H
#define MACULA_LIB_PACKET_INSTANCES_H

#include "lib/packet_traverse.h"

static inline PacketInstance instance_of(const TraceScene* scene,
                                         global const Instance* instance) {
    PacketInstance i;
    i.near = 0.0f;
    i.plain =
        mesh_size((global const Wide8Node*)scene->nodes + instance->root) <= MACULA_PLAIN_SIZE;
    i.first_triangle = instance->first_triangle;
    i.mesh_triangle = instance->mesh_triangle;
    return i;
}

static inline float16 transform_point16(global const float* row, float16 x, float16 y, float16 z) {
    return fma((float16)(row[0]), x,
               fma((float16)(row[1]), y, fma((float16)(row[2]), z, (float16)(row[3]))));
}

static inline float16 transform_vector16(global const float* row, float16 x, float16 y, float16 z) {
    return fma((float16)(row[0]), x, fma((float16)(row[1]), y, (float16)(row[2]) * z));
}

/* transform_ray. */
static inline QueuedPacket transform_packet(global const Instance* instance, const QueuedPacket* q,
                                            float16 t_max) {
    global const float* x = instance->object_from_world[0];
    global const float* y = instance->object_from_world[1];
    global const float* z = instance->object_from_world[2];
    QueuedPacket object;
    object.ox = transform_point16(x, q->ox, q->oy, q->oz);
    object.oy = transform_point16(y, q->ox, q->oy, q->oz);
    object.oz = transform_point16(z, q->ox, q->oy, q->oz);
    object.dx = transform_vector16(x, q->dx, q->dy, q->dz);
    object.dy = transform_vector16(y, q->dx, q->dy, q->dz);
    object.dz = transform_vector16(z, q->dx, q->dy, q->dz);
    object.t_min = q->t_min;
    object.t_max = t_max;
    return object;
}

/* Traces the lanes that enter the instance's world box. */
static inline void traverse_instance16(const TraceScene* scene, const QueuedPacket* q,
                                       Packet* world, PacketHit* best, uint index) {
    global const Instance* instance = scene->instances + index;
    const float lo[3] = {instance->lo[0], instance->lo[1], instance->lo[2]};
    const float hi[3] = {instance->hi[0], instance->hi[1], instance->hi[2]};
    PacketInstance i = instance_of(scene, instance);
    float16 far;
    box_interval16(world, lo, hi, &i.near, &far);
    const int16 enters = i.near <= m_min(far, world->t_max);
    if (!any_lane16(enters))
        return;
    const QueuedPacket object =
        transform_packet(instance, q, enters ? world->t_max : (float16)(-1.0f));
    Packet p;
    const PacketBounds bounds = make_packet(&object, &p);
    traverse_packet(scene, &i, &p, &bounds, best, instance->root);
    world->t_max = enters ? p.t_max : world->t_max;
}

static inline bool enters_child16(const Packet* world, global const BinaryNode* node, uint i) {
    const float lo[3] = {node->box[i][0][0], node->box[i][1][0], node->box[i][2][0]};
    const float hi[3] = {node->box[i][0][1], node->box[i][1][1], node->box[i][2][1]};
    return any_lane16(enter_box16(world, lo, hi));
}

/* In depth-first order: instances overlap, and few are in a packet's way. */
static inline void traverse_instances16(const TraceScene* scene, const QueuedPacket* q,
                                        Packet* world, PacketHit* best) {
    int stack[MACULA_MAX_DEPTH + 2];
    uint depth = 1u;
    stack[0] = 0;
    while (depth != 0u) {
        const int reference = stack[--depth];
        if (reference < 0) {
            traverse_instance16(scene, q, world, best, (uint)~reference >> MACULA_LEAF_COUNT_BITS);
            continue;
        }
        global const BinaryNode* node = scene->upper_nodes + reference;
        for (uint i = 0u; i < 2u; ++i)
            if (enters_child16(world, node, i))
                stack[depth++] = node->child[i];
    }
}

#endif
