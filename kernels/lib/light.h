/* Sampling of light sources. Irradiance: rectangle and point lights by area, spheres by the solid
 * angle that they fill. */
#ifndef MACULA_LIB_LIGHT_H
#define MACULA_LIB_LIGHT_H

#include "lib/camera.h"
#include "lib/sampling.h"
#include "shared/light.h"

MACULA_SHARED_BEGIN

/* Shadow rays stop this part of their length short of the light, whose own geometry often lies in
 * the very plane of the emitter. */
#define MACULA_LIGHT_GAP 0x1p-11f
#define MACULA_FAR_AWAY 1e20f

/* One sample of a light as seen from a point. The ray runs from the point along `direction` for t
 * in [0, t_max]; t_max < 0: nothing arrives. `weight` times the colour times the cosine at the
 * receiver is the sample's irradiance. */
typedef struct LightSample {
    float3 direction;
    float t_max;
    float3 unit_direction;
    float weight;
} LightSample;

MACULA_ALWAYS_INLINE void sample_towards_point(MACULA_GLOBAL const Light* light, float3 target,
                                               float3 from, float margin, LightSample* out) {
    const float3 offset = target - from;
    const float squared = dot3(offset, offset);
    if (!(squared > 1e-30f))
        return;
    const float inverse = m_inverse_sqrt(squared);
    out->direction = offset;
    out->unit_direction = offset * inverse;
    out->t_max = fma(-margin, inverse, 1.0f - MACULA_LIGHT_GAP);
    out->weight = light->reference_distance_squared > 0.0f
                      ? m_divide(light->reference_distance_squared, squared)
                      : 1.0f;
}

MACULA_ALWAYS_INLINE void emit_cosine(MACULA_GLOBAL const Light* light, LightSample* out) {
    const float cosine = -dot3(out->unit_direction, vector_at(light->direction));
    out->weight = cosine > 0.0f ? out->weight * cosine : 0.0f;
    out->t_max = cosine > 0.0f ? out->t_max : -1.0f;
}

/* The sphere's radiance is colour / (pi r^2); times the solid angle 2 pi (1 - cos) of its cone:
 * pi cancels. */
MACULA_ALWAYS_INLINE void sample_sphere(MACULA_GLOBAL const Light* light, float3 from, float u,
                                        float v, LightSample* out) {
    const float3 offset = vector_at(light->position) - from;
    const float squared = dot3(offset, offset);
    const float radius_squared = light->radius * light->radius;
    if (!(squared > radius_squared))
        return; /* inside: no light reaches the inner side */
    const float sine_squared = m_divide(radius_squared, squared);
    const float cosine = m_sqrt(1.0f - sine_squared);
    const float height = m_divide(sine_squared, 1.0f + cosine); /* 1 - cos without cancellation */
    const float distance = m_sqrt(squared);
    const float3 axis = offset * m_divide(1.0f, distance);
    const float3 direction = cone_direction(axis, height, u, v);
    /* Nearer intersection of the direction with the sphere. */
    const float along = dot3(direction, offset);
    const float inside = fma(along, along, radius_squared - squared);
    const float reach = along - m_sqrt(inside > 0.0f ? inside : 0.0f);
    out->direction = direction;
    out->unit_direction = direction;
    out->t_max = reach * (1.0f - MACULA_LIGHT_GAP);
    const float falloff =
        light->reference_distance_squared > 0.0f ? light->reference_distance_squared : squared;
    out->weight = m_divide(2.0f * height, radius_squared) * falloff;
}

/* Sample `index` of the light's strata, make_strata(columns, samples); `sample` counts the samples
 * of the pixel. */
MACULA_ALWAYS_INLINE void sample_light(MACULA_GLOBAL const Light* light, const Strata* strata,
                                       float3 from, uint key, uint sample, uint dimension,
                                       uint index, LightSample* out) {
    out->direction = make3(0.0f, 0.0f, 1.0f);
    out->unit_direction = out->direction;
    out->t_max = -1.0f;
    out->weight = 0.0f;
    const float3 position = vector_at(light->position);
    if (light->kind == MACULA_LIGHT_DIRECTIONAL) {
        out->direction = -vector_at(light->direction);
        out->unit_direction = out->direction;
        out->t_max = MACULA_FAR_AWAY;
        out->weight = 1.0f;
    } else if (light->kind == MACULA_LIGHT_POINT || light->kind == MACULA_LIGHT_COSINE_POINT) {
        sample_towards_point(light, position, from, light->radius, out);
        if (light->kind == MACULA_LIGHT_COSINE_POINT)
            emit_cosine(light, out);
    } else {
        float u, v;
        stratified_point(key, sample * light->samples + index, dimension, index, strata, &u, &v);
        if (light->kind == MACULA_LIGHT_SPHERE) {
            sample_sphere(light, from, u, v, out);
        } else {
            const float3 target =
                scale_add3(vector_at(light->edge_u), u - 0.5f,
                           scale_add3(vector_at(light->edge_v), v - 0.5f, position));
            sample_towards_point(light, target, from, 0.0f, out);
            emit_cosine(light, out);
        }
    }
}

/* False only where no sample of the light can reach the front of a surface with unit normal n at
 * `from`: then no shadow ray is queued. */
MACULA_ALWAYS_INLINE bool light_may_reach(MACULA_GLOBAL const Light* light, float3 from, float3 n) {
    if (light->kind == MACULA_LIGHT_DIRECTIONAL)
        return dot3(n, vector_at(light->direction)) < 0.0f;
    const float3 offset = vector_at(light->position) - from;
    const float height = dot3(n, offset);
    const float3 normal = vector_at(light->direction);
    if (light->kind == MACULA_LIGHT_POINT)
        return height > 0.0f;
    if (light->kind == MACULA_LIGHT_SPHERE)
        return height > -light->radius * 1.0001f;
    const float in_front = -dot3(normal, offset);
    if (light->kind == MACULA_LIGHT_COSINE_POINT)
        return height > 0.0f && in_front > 0.0f;
    const float reach = fma(0.5f, fabs(dot3(n, vector_at(light->edge_u))),
                            0.5f * fabs(dot3(n, vector_at(light->edge_v))));
    return fma(reach, 1.0001f, height) > 0.0f && in_front > 0.0f;
}

MACULA_SHARED_END
#endif
