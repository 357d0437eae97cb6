/* A bound of a packet's rays: the intervals of their origins and directions. It is tested against
 * eight boxes at once and may cull only what every lane's own test would cull. OpenCL C only. */
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
    float margin; /* pads a plane by more than any lane does, as a distance */
} Frustum;

/* Lanes pad by MACULA_RAY_MARGIN * reach and scale far planes by 1 + 2^-21: twice of both covers
 * that and the rounding of a test that is made of the bounds, 5 * 2^-24 of the terms. */
#define MACULA_FRUSTUM_MARGIN (2.0f * MACULA_RAY_MARGIN)
#define MACULA_FRUSTUM_SHRINK 0x1.ffffep-1f /* 1 - 2^-20 */
#define MACULA_FRUSTUM_GROW 0x1.00001p+0f   /* 1 + 2^-20 */
#define MACULA_FRUSTUM_FAR 0x1.fffffep+127f

/* t of a plane p is at least (p - o) * r, less the margin; r is of either sign. */
static inline void bound_near(float o, float margin, float r, float* near_r, float* near_b) {
    *near_r = r * MACULA_FRUSTUM_SHRINK;
    *near_b = fma(-o, *near_r, -fabs(*near_r) * margin);
}

static inline void bound_far(float o, float margin, float r, float* far_r, float* far_b) {
    *far_r = r * MACULA_FRUSTUM_GROW;
    *far_b = fma(-o, *far_r, fabs(*far_r) * margin);
}

/* r_of_lo, r_of_hi: reciprocals of the least and the greatest direction component. */
static inline void bound_axis(Frustum* f, uint axis, const PacketBounds* b, float r_of_lo,
                              float r_of_hi) {
    const float o_lo = b->o_lo[axis], o_hi = b->o_hi[axis];
    f->back_r[axis] = 0.0f;
    f->back_b[axis] = -MACULA_FRUSTUM_FAR;
    if (b->d_lo[axis] > 0.0f) {
        bound_near(o_hi, f->margin, r_of_hi, &f->near_r[axis], &f->near_b[axis]);
        bound_far(o_lo, f->margin, r_of_lo, &f->far_r[axis], &f->far_b[axis]);
    } else if (b->d_hi[axis] < 0.0f) {
        bound_near(o_lo, f->margin, r_of_lo, &f->near_r[axis], &f->near_b[axis]);
        bound_far(o_hi, f->margin, r_of_hi, &f->far_r[axis], &f->far_b[axis]);
    } else {
        bound_near(o_hi, f->margin, r_of_hi, &f->near_r[axis], &f->near_b[axis]);
        bound_near(o_lo, f->margin, r_of_lo, &f->back_r[axis], &f->back_b[axis]);
        f->far_r[axis] = 0.0f;
        f->far_b[axis] = MACULA_FRUSTUM_FAR;
    }
}

static inline Frustum make_frustum(const PacketBounds* b) {
    Frustum f;
    f.margin = MACULA_FRUSTUM_MARGIN * b->reach;
    for (uint axis = 0u; axis < 3u; ++axis)
        bound_axis(&f, axis, b, m_divide(1.0f, b->d_lo[axis]), m_divide(1.0f, b->d_hi[axis]));
    f.t_min = b->t_min;
    f.t_max = b->t_max;
    return f;
}

/* The eight boxes of a node, as near and far planes of an octant. */
typedef struct WidePlanes {
    float8 near[3], far[3];
} WidePlanes;

static inline WidePlanes load_planes(global const Wide8Node* node, uint octant) {
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

/* The children that some ray may enter, and a bound of the t at which one does. `mixed`: the rays
 * have several octants. */
static inline int8 enter_frustum8(const Frustum* f, bool mixed, const WidePlanes* w, float8* near) {
    const float8 nx = fma(w->near[0], (float8)(f->near_r[0]), (float8)(f->near_b[0]));
    const float8 ny = fma(w->near[1], (float8)(f->near_r[1]), (float8)(f->near_b[1]));
    const float8 nz = fma(w->near[2], (float8)(f->near_r[2]), (float8)(f->near_b[2]));
    const float8 fx = fma(w->far[0], (float8)(f->far_r[0]), (float8)(f->far_b[0]));
    const float8 fy = fma(w->far[1], (float8)(f->far_r[1]), (float8)(f->far_b[1]));
    const float8 fz = fma(w->far[2], (float8)(f->far_r[2]), (float8)(f->far_b[2]));
    *near = m_max8(m_max8(nx, ny), m_max8(nz, (float8)(f->t_min)));
    const float8 far = m_min8(m_min8(fx, fy), m_min8(fz, (float8)(f->t_max)));
    if (mixed) {
        const float8 bx = fma(w->far[0], (float8)(f->back_r[0]), (float8)(f->back_b[0]));
        const float8 by = fma(w->far[1], (float8)(f->back_r[1]), (float8)(f->back_b[1]));
        const float8 bz = fma(w->far[2], (float8)(f->back_r[2]), (float8)(f->back_b[2]));
        *near = m_max8(*near, m_max8(m_max8(bx, by), bz));
    }
    return *near <= far;
}

#endif
