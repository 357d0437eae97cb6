/* Sampling of light sources. Irradiance: rectangle and point lights by area, spheres and wide
 * directional lights by the solid angle that they fill. */
#ifndef MACULA_LIB_LIGHT_H
#define MACULA_LIB_LIGHT_H

#include "lib/blue_noise.h"
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
    Real3 direction;
    Real t_max;
    Real3 unit_direction;
    Real weight;
} LightSample;

MACULA_ALWAYS_INLINE void sample_towards_point(MACULA_GLOBAL const Light* light, Real3 target,
                                               Real3 from, float margin, LightSample* out) {
    const Real3 offset = sub3(target, from);
    const Real squared = dot3(offset, offset);
    const Mask apart = squared > splat(1e-30f);
    const Real inverse = m_inverse_sqrt(squared);
    const Real t_max = fma(splat(-margin), inverse, splat(1.0f - MACULA_LIGHT_GAP));
    const float reference = light->reference_distance_squared;
    const Real weight =
        reference > 0.0f ? m_divide(splat(reference), apart ? squared : splat(1.0f)) : splat(1.0f);
    out->direction = select3(apart, offset, out->direction);
    out->unit_direction = select3(apart, scale3(offset, inverse), out->unit_direction);
    out->t_max = apart ? t_max : splat(-1.0f);
    out->weight = apart ? weight : splat(0.0f);
}

MACULA_ALWAYS_INLINE void emit_cosine(MACULA_GLOBAL const Light* light, LightSample* out) {
    const Real cosine = -dot3(out->unit_direction, splat_vector(vector_at(light->direction)));
    const Mask in_front = cosine > splat(0.0f);
    out->weight = in_front ? out->weight * cosine : splat(0.0f);
    out->t_max = in_front ? out->t_max : splat(-1.0f);
}

/* The sphere's radiance is colour / (pi r^2); times the solid angle 2 pi (1 - cos) of its cone:
 * pi cancels. */
MACULA_ALWAYS_INLINE void sample_sphere(MACULA_GLOBAL const Light* light, Real3 from, Real u,
                                        Real v, LightSample* out) {
    const Real3 offset = sub3(splat_vector(vector_at(light->position)), from);
    const float radius_squared = light->radius * light->radius;
    const Real from_centre = dot3(offset, offset);
    /* Inside no light reaches the inner side. */
    const Mask outside = from_centre > splat(radius_squared);
    const Real squared = outside ? from_centre : splat(radius_squared + 1.0f);
    const Real sine_squared = m_divide(splat(radius_squared), squared);
    const Real cosine = m_sqrt(1.0f - sine_squared);
    const Real height = m_divide(sine_squared, 1.0f + cosine); /* 1 - cos without cancellation */
    const Real distance = m_sqrt(squared);
    const Real3 axis = scale3(offset, m_divide(splat(1.0f), distance));
    const Real3 direction = cone_direction(axis, height, u, v);
    /* Nearer intersection of the direction with the sphere. */
    const Real along = dot3(direction, offset);
    const Real inside = fma(along, along, radius_squared - squared);
    const Real reach = along - m_sqrt(inside > splat(0.0f) ? inside : splat(0.0f));
    const Real falloff = light->reference_distance_squared > 0.0f
                             ? splat(light->reference_distance_squared)
                             : squared;
    const Real weight = m_divide(2.0f * height, splat(radius_squared)) * falloff;
    out->direction = select3(outside, direction, out->direction);
    out->unit_direction = select3(outside, direction, out->unit_direction);
    out->t_max = outside ? reach * (1.0f - MACULA_LIGHT_GAP) : splat(-1.0f);
    out->weight = outside ? weight : splat(0.0f);
}

/* A light as wide as the cone of height `light->radius` about its direction. Its mean cosine with a
 * surface that faces it is 1 - height / 2, which the weight makes 1. */
MACULA_ALWAYS_INLINE void sample_wide(MACULA_GLOBAL const Light* light, Real u, Real v,
                                      LightSample* out) {
    const float height = light->radius;
    const Real3 axis = splat_vector(-vector_at(light->direction));
    out->direction = cone_direction(axis, splat(height), u, v);
    out->unit_direction = out->direction;
    out->t_max = splat(MACULA_FAR_AWAY);
    out->weight = splat(m_divide(2.0f, 2.0f - height));
}

/* Where a pixel's samples of one light come from. */
typedef struct LightDraw {
    Strata strata;  /* of stratified lights */
    uint dimension; /* of random numbers */
    uint first;     /* rays that the pixel's samples before this one sent to the light */
    uint earlier;   /* and what the mask's earlier rounds of frames sent: of blue noise alone */
    Uint key;       /* the pixel's random_key() */
    Uint texel;     /* and its texel of the blue noise, where the light takes that */
} LightDraw;

/* For sample `sample` of the pixel. */
MACULA_ALWAYS_INLINE LightDraw make_light_draw(MACULA_GLOBAL const Light* light,
                                               MACULA_GLOBAL const FrameParams* frame, uint sample,
                                               uint dimension, Uint key, Uint texel) {
    const uint columns = light->columns > 0u ? light->columns : 1u;
    const uint round = frame->frame / MACULA_NOISE_SLICES;
    LightDraw draw;
    draw.strata = make_strata(columns, light->samples);
    draw.dimension = dimension;
    draw.first = sample * light->samples;
    draw.earlier = round * frame->samples_per_pixel * light->samples;
    draw.key = key;
    draw.texel = texel;
    return draw;
}

MACULA_ALWAYS_INLINE void light_point(MACULA_GLOBAL const Light* light, const LightDraw* draw,
                                      Uint index, Real* u, Real* v) {
    if (light->columns == 0u)
        blue_point(draw->texel, index + (draw->earlier + draw->first), u, v);
    else
        stratified_point(draw->key, index + draw->first, draw->dimension, index, &draw->strata, u,
                         v);
}

/* Sample `index` of light->samples. */
MACULA_ALWAYS_INLINE void sample_light(MACULA_GLOBAL const Light* light, const LightDraw* draw,
                                       Real3 from, Uint index, LightSample* out) {
    out->direction = splat_vector(make3(0.0f, 0.0f, 1.0f));
    out->unit_direction = out->direction;
    out->t_max = splat(-1.0f);
    out->weight = splat(0.0f);
    const Real3 position = splat_vector(vector_at(light->position));
    if (light->kind == MACULA_LIGHT_DIRECTIONAL && light->radius == 0.0f) {
        out->direction = splat_vector(-vector_at(light->direction));
        out->unit_direction = out->direction;
        out->t_max = splat(MACULA_FAR_AWAY);
        out->weight = splat(1.0f);
    } else if (light->kind == MACULA_LIGHT_POINT || light->kind == MACULA_LIGHT_COSINE_POINT) {
        sample_towards_point(light, position, from, light->radius, out);
        if (light->kind == MACULA_LIGHT_COSINE_POINT)
            emit_cosine(light, out);
    } else {
        Real u, v;
        light_point(light, draw, index, &u, &v);
        if (light->kind == MACULA_LIGHT_DIRECTIONAL) {
            sample_wide(light, u, v, out);
        } else if (light->kind == MACULA_LIGHT_SPHERE) {
            sample_sphere(light, from, u, v, out);
        } else {
            const Real3 edge_u = splat_vector(vector_at(light->edge_u));
            const Real3 edge_v = splat_vector(vector_at(light->edge_v));
            const Real3 target =
                scale_add3(edge_u, u - 0.5f, scale_add3(edge_v, v - 0.5f, position));
            sample_towards_point(light, target, from, 0.0f, out);
            emit_cosine(light, out);
        }
    }
}

/* False only where no sample of the light can reach the front of a surface with unit normal n at
 * `from`: then no shadow ray is queued. */
MACULA_ALWAYS_INLINE Mask light_may_reach(MACULA_GLOBAL const Light* light, Real3 from, Real3 n) {
    const Real zero = splat(0.0f);
    const Real3 normal = splat_vector(vector_at(light->direction));
    if (light->kind == MACULA_LIGHT_DIRECTIONAL) {
        const float sine = m_sqrt(light->radius * (2.0f - light->radius));
        return dot3(n, normal) < splat(sine * 1.0001f);
    }
    const Real3 offset = sub3(splat_vector(vector_at(light->position)), from);
    const Real height = dot3(n, offset);
    if (light->kind == MACULA_LIGHT_POINT)
        return height > zero;
    if (light->kind == MACULA_LIGHT_SPHERE)
        return height > splat(-light->radius * 1.0001f);
    const Real in_front = -dot3(normal, offset);
    if (light->kind == MACULA_LIGHT_COSINE_POINT)
        return (height > zero) & (in_front > zero);
    const Real along_u = fabs(dot3(n, splat_vector(vector_at(light->edge_u))));
    const Real along_v = fabs(dot3(n, splat_vector(vector_at(light->edge_v))));
    const Real reach = fma(splat(0.5f), along_u, 0.5f * along_v);
    return (fma(reach, splat(1.0001f), height) > zero) & (in_front > zero);
}

MACULA_SHARED_END
#endif
