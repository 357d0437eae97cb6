/* The state of one ray's query and the acceptance of a hit: the one place where closest and any
 * hit differ, and where masks are tested. OpenCL C only.
 *
 * A lower level is traversed with `ray` in the space of its mesh. `ray.t_max` is the best t so far,
 * and with it the bound for culling: a box is skipped only where near > far or near > ray.t_max,
 * never on equality, since an equal t with a lower id wins. */
#ifndef MACULA_LIB_TRAVERSE_QUERY_H
#define MACULA_LIB_TRAVERSE_QUERY_H

#include "lib/instance.h"
#include "lib/mask.h"
#include "lib/trace_contract.h"
#include "lib/triangle.h"

/* The buffers of the contract that describe the scene. */
typedef struct TraceScene {
    global const uchar* nodes;
    global const uchar* triangles;
    global const Instance* instances;
    global const BinaryNode* upper_nodes;
    MaskTables masks;
} TraceScene;

typedef struct TraceQuery {
    TraceRay ray;
    TraceHit best;
    /* Of the instance being traversed: */
    InstanceSpan span;
    uint first_triangle;
    uint mesh_triangle;
} TraceQuery;

/* Takes a hit of intersect_triangle if it is solid and closer than the best. True when the query
 * is answered, which only an any-hit query is before its traversal ends. */
static inline bool accept_hit(const TraceScene* scene, TraceQuery* query, uint stored_id, float t,
                              float u, float v) {
    const uint id = stored_id & MACULA_ID_MASK;
#if MACULA_INSTANCES
    if (!clamp_to_span(&query->span, &t))
        return false;
#endif
#if !MACULA_ANY_HIT
    if (!is_closer(t, query->first_triangle + id, &query->best))
        return false;
#endif
#if MACULA_MASKS
    if ((stored_id & MACULA_MASKED_BIT) != 0u &&
        !mask_is_solid(&scene->masks, query->mesh_triangle + id, u, v))
        return false;
#endif
    query->best.t = t;
    query->best.u = u;
    query->best.v = v;
    query->best.triangle = query->first_triangle + id;
    query->ray.t_max = t;
    return MACULA_ANY_HIT;
}

/* Tests the Triangles of a leaf; true when the query is answered. */
static inline bool test_leaf(const TraceScene* scene, TraceQuery* query, int leaf) {
    global const Triangle* triangles = (global const Triangle*)scene->triangles;
    const uint bits = (uint)~leaf;
    const uint first = bits >> MACULA_LEAF_COUNT_BITS;
    const uint end = first + (bits & MACULA_LEAF_MAX);
    for (uint i = first; i < end; ++i) {
        global const Triangle* tri = triangles + i;
        float t, u, v;
        if (intersect_triangle(&query->ray, tri->v0[0], tri->v0[1], tri->v0[2], tri->v1[0],
                               tri->v1[1], tri->v1[2], tri->v2[0], tri->v2[1], tri->v2[2], &t, &u,
                               &v) &&
            accept_hit(scene, query, tri->id, t, u, v))
            return true;
    }
    return false;
}

#endif
