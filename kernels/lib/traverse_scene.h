/* One ray of a queue through the whole scene: the loop over the upper level that all one-ray
 * variants share. The including variant has defined its lower level before:
 *
 *   bool traverse_lower(const TraceScene *, TraceQuery *, int root);  true: the query is answered
 */
#ifndef MACULA_LIB_TRAVERSE_SCENE_H
#define MACULA_LIB_TRAVERSE_SCENE_H

#include "lib/traverse_binary.h"
#include "lib/traverse_query.h"
#include "lib/traverse_queue.h"

#if MACULA_INSTANCES
static inline bool traverse_instance(const TraceScene* scene, TraceQuery* query,
                                     const TraceRay* world, const QueuedRay* ray, uint index) {
    global const Instance* instance = scene->instances + index;
    if (!enter_instance(world, instance, &query->span))
        return false;
    query->ray = transform_ray(instance, ray->ox, ray->oy, ray->oz, ray->dx, ray->dy, ray->dz,
                               ray->t_min, query->best.t);
    query->first_triangle = instance->first_triangle;
    query->mesh_triangle = instance->mesh_triangle;
    return traverse_lower(scene, query, instance->root);
}

static inline void traverse_scene(const TraceScene* scene, TraceQuery* query,
                                  const QueuedRay* ray) {
    TraceRay world = make_trace_ray(ray->ox, ray->oy, ray->oz, ray->dx, ray->dy, ray->dz,
                                    ray->t_min, ray->t_max);
    int stack[MACULA_BINARY_STACK];
    uint depth = 1u;
    stack[0] = MACULA_NO_CHILD;
    int node = 0;
    while (node != MACULA_NO_CHILD) {
        if (node >= 0) {
            node = descend(scene->upper_nodes + node, &world, stack, &depth);
            continue;
        }
        if (traverse_instance(scene, query, &world, ray, (uint)~node >> MACULA_LEAF_COUNT_BITS))
            return;
        world.t_max = query->best.t;
        node = stack[--depth];
    }
}
#else
static inline void traverse_scene(const TraceScene* scene, TraceQuery* query,
                                  const QueuedRay* ray) {
    query->ray = make_trace_ray(ray->ox, ray->oy, ray->oz, ray->dx, ray->dy, ray->dz, ray->t_min,
                                ray->t_max);
    query->first_triangle = 0u;
    query->mesh_triangle = 0u;
    traverse_lower(scene, query, scene->instances[0].root);
}
#endif

static inline void trace_ray(const TraceScene* scene, global const RayBlock* rays, uint i,
                             global uint* results) {
    const QueuedRay ray = load_ray(rays, i);
    TraceQuery query;
    query.best = no_hit(ray.t_max);
    if (ray_is_active(ray.t_min, ray.t_max))
        traverse_scene(scene, &query, &ray);
    store_result(results, i, &query.best);
}

#define MACULA_TRACE_SCENE                                                                         \
    {                                                                                              \
        nodes, triangles, instances, upper_nodes, {                                                \
            mask_slots, mask_triangles, mask_textures, mask_words                                  \
        }                                                                                          \
    }

#endif
