/* How a world-space ray meets a placed mesh. t keeps its meaning, since the direction is not
 * normalised on the way into object space. */
#ifndef MACULA_LIB_INSTANCE_H
#define MACULA_LIB_INSTANCE_H

#include "lib/ray.h"
#include "shared/bvh.h"

MACULA_SHARED_BEGIN

/* What the world box of an instance leaves of a ray's interval. */
typedef struct InstanceSpan {
    float near;  /* entry into the world box, at least the ray's t_min */
    float t_max; /* of the world ray */
} InstanceSpan;

/* False when the ray misses the instance's world box: then nothing in it counts as hit. */
MACULA_INLINE bool enter_instance(const TraceRay* world, MACULA_GLOBAL const Instance* instance,
                                  InstanceSpan* span) {
    float far;
    box_interval(world, instance->lo[0], instance->lo[1], instance->lo[2], instance->hi[0],
                 instance->hi[1], instance->hi[2], &span->near, &far);
    span->t_max = world->t_max;
    return span->near <= far;
}

/* Moves an object-space hit's t behind the entry into the world box, so that no box of the upper
 * level can cull it; false when that is beyond the ray's end. t is never lowered: otherwise a hit
 * that lower-level boxes cull by a closer t could still win. Does nothing for identity instances,
 * whose world box contains the boxes of their triangles. */
MACULA_INLINE bool clamp_to_span(const InstanceSpan* span, float* t) {
    *t = m_max(*t, span->near);
    return *t <= span->t_max;
}

/* The ray in the instance's object space. Origin and direction are the world ray's own, before
 * make_trace_ray bounds the direction. The identity gives the very ray of make_trace_ray. */
MACULA_INLINE TraceRay transform_ray(MACULA_GLOBAL const Instance* instance, float ox, float oy,
                                     float oz, float dx, float dy, float dz, float t_min,
                                     float t_max) {
    MACULA_GLOBAL const float* x = instance->object_from_world[0];
    MACULA_GLOBAL const float* y = instance->object_from_world[1];
    MACULA_GLOBAL const float* z = instance->object_from_world[2];
    return make_trace_ray(fma(x[0], ox, fma(x[1], oy, fma(x[2], oz, x[3]))),
                          fma(y[0], ox, fma(y[1], oy, fma(y[2], oz, y[3]))),
                          fma(z[0], ox, fma(z[1], oy, fma(z[2], oz, z[3]))),
                          fma(x[0], dx, fma(x[1], dy, x[2] * dz)),
                          fma(y[0], dx, fma(y[1], dy, y[2] * dz)),
                          fma(z[0], dx, fma(z[1], dy, z[2] * dz)), t_min, t_max);
}

MACULA_SHARED_END
#endif
