/* A bound of a packet's rays: the intervals of their origins and reciprocal directions. It is
 * tested against eight boxes at once and may cull only what every lane's own test would cull. */
#ifndef MACULA_LIB_PACKET_FRUSTUM_H
#define MACULA_LIB_PACKET_FRUSTUM_H

#include "lib/packet.h"
#include "lib/traverse_wide8.h"

/* Per axis: t of the near plane is fma(plane, near_r, near_b) at least, that of the far plane
 * fma(plane, far_r, far_b) at most. Where directions of both signs occur, the far plane bounds
 * nothing, and both planes are near bounds: the rays of the wrong sign miss boxes that lie ahead
 * of all origins. */
typedef struct Frustum {
    float near_r[3], near_b[3];
    float far_r[3], far_b[3];
    float back_r[3], back_b[3]; /* the other near bound of an axis with both signs */
    float t_min, t_max;
    uint octant; /* bit a: the near plane of axis a is the upper one */
    bool both_signs;
} Frustum;

/* Lanes pad by MACULA_RAY_MARGIN * reach and scale far planes by 1 + 2^-21: four times the pad and
 * twice the scale cover that and the frustum's own rounding (a few 2^-24 of the terms). */
#define MACULA_FRUSTUM_MARGIN (4.0f * MACULA_RAY_MARGIN)
#define MACULA_FRUSTUM_SHRINK 0x1.ffffep-1f /* 1 - 2^-20 */
#define MACULA_FRUSTUM_GROW 0x1.00001p+0f   /* 1 + 2^-20 */
#define MACULA_FRUSTUM_FAR 0x1.fffffep+127f

/* Bounds t of a plane p from below by (p - o) * r, r of either sign. */
static inline void bound_near(float o, float margin, float r, float *near_r, float *near_b) {
    *near_r = r * MACULA_FRUSTUM_SHRINK;
    *near_b = fma(-o, *near_r, -fabs(*near_r) * margin);
}

static inline void bound_far(float o, float margin, float r, float *far_r, float *far_b) {
    *far_r = r * MACULA_FRUSTUM_GROW;
    *far_b = fma(-o, *far_r, fabs(*far_r) * margin);
}

/* One axis, from the lanes' origins and reciprocal directions. */
static inline void bound_axis(Frustum *f, uint axis, float16 o, float16 r, float margin) {
    const float o_lo = least_lane16(o), o_hi = greatest_lane16(o);
    const float r_lo = least_lane16(r), r_hi = greatest_lane16(r);
    f->back_r[axis] = 0.0f;
    f->back_b[axis] = -MACULA_FRUSTUM_FAR;
    if (r_lo > 0.0f) {
        bound_near(o_hi, margin, r_lo, &f->near_r[axis], &f->near_b[axis]);
        bound_far(o_lo, margin, r_hi, &f->far_r[axis], &f->far_b[axis]);
    } else if (r_hi < 0.0f) {
        f->octant |= 1u << axis;
        bound_near(o_lo, margin, r_hi, &f->near_r[axis], &f->near_b[axis]);
        bound_far(o_hi, margin, r_lo, &f->far_r[axis], &f->far_b[axis]);
    } else {
        f->both_signs = true;
        const float ahead = least_lane16(r > 0.0f ? r : (float16)(r_hi));
        const float back = greatest_lane16(r < 0.0f ? r : (float16)(r_lo));
        bound_near(o_hi, margin, ahead, &f->near_r[axis], &f->near_b[axis]);
        bound_near(o_lo, margin, back, &f->back_r[axis], &f->back_b[axis]);
        f->far_r[axis] = 0.0f;
        f->far_b[axis] = MACULA_FRUSTUM_FAR;
    }
}

static inline void bound_t_max(Frustum *f, const Packet *p) {
    f->t_max = greatest_lane16(p->t_max) * MACULA_FRUSTUM_GROW;
}

static inline float reach16(float16 x, float16 y, float16 z) {
    return greatest_lane16(m_max16(m_max16(fabs(x), fabs(y)), m_max16(fabs(z), 0x1p-20f)));
}

static inline Frustum make_frustum(const Packet *p) {
    Frustum f;
    f.octant = 0u;
    f.both_signs = false;
    const float margin = MACULA_FRUSTUM_MARGIN * reach16(p->o[0], p->o[1], p->o[2]);
    bound_axis(&f, 0u, p->o[0], p->rx, margin);
    bound_axis(&f, 1u, p->o[1], p->ry, margin);
    bound_axis(&f, 2u, p->o[2], p->rz, margin);
    f.t_min = least_lane16(p->t_min);
    bound_t_max(&f, p);
    return f;
}

/* The eight boxes of a node, as near and far planes. */
typedef struct WidePlanes {
    float8 near[3], far[3];
} WidePlanes;

static inline WidePlanes load_planes(global const Wide8Node *node, uint octant) {
    const uint sx = octant & 1u, sy = (octant >> 1) & 1u, sz = octant >> 2;
    WidePlanes w;
    w.near[0] = vload8(0, node->plane[0][sx]);
    w.near[1] = vload8(0, node->plane[1][sy]);
    w.near[2] = vload8(0, node->plane[2][sz]);
    w.far[0] = vload8(0, node->plane[0][sx ^ 1u]);
    w.far[1] = vload8(0, node->plane[1][sy ^ 1u]);
    w.far[2] = vload8(0, node->plane[2][sz ^ 1u]);
    return w;
}

/* The children that some ray may enter, and a bound of the t at which one does. */
static inline int8 enter_frustum8(const Frustum *f, const WidePlanes *w, float8 *near) {
    const float8 nx = fma(w->near[0], (float8)(f->near_r[0]), (float8)(f->near_b[0]));
    const float8 ny = fma(w->near[1], (float8)(f->near_r[1]), (float8)(f->near_b[1]));
    const float8 nz = fma(w->near[2], (float8)(f->near_r[2]), (float8)(f->near_b[2]));
    const float8 fx = fma(w->far[0], (float8)(f->far_r[0]), (float8)(f->far_b[0]));
    const float8 fy = fma(w->far[1], (float8)(f->far_r[1]), (float8)(f->far_b[1]));
    const float8 fz = fma(w->far[2], (float8)(f->far_r[2]), (float8)(f->far_b[2]));
    *near = m_max8(m_max8(nx, ny), m_max8(nz, (float8)(f->t_min)));
    const float8 far = m_min8(m_min8(fx, fy), m_min8(fz, (float8)(f->t_max)));
    if (f->both_signs) {
        const float8 bx = fma(w->far[0], (float8)(f->back_r[0]), (float8)(f->back_b[0]));
        const float8 by = fma(w->far[1], (float8)(f->back_r[1]), (float8)(f->back_b[1]));
        const float8 bz = fma(w->far[2], (float8)(f->back_r[2]), (float8)(f->back_b[2]));
        *near = m_max8(*near, m_max8(m_max8(bx, by), bz));
    }
    return *near <= far;
}

#endif
