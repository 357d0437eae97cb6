/* One ray against the eight boxes of a Wide8Node, and masks of eight lanes. A lane mask has one
 * byte a lane, 0xff or 0, in a ulong: what as_ulong(convert_char8(comparison)) gives. */
#ifndef MACULA_LIB_TRAVERSE_WIDE8_H
#define MACULA_LIB_TRAVERSE_WIDE8_H

#include "lib/ray.h"
#include "shared/bvh.h"

static inline float8 m_min8(float8 a, float8 b) {
    return a < b ? a : b;
}
static inline float8 m_max8(float8 a, float8 b) {
    return a > b ? a : b;
}

static inline ulong lane_mask8(int8 comparison) {
    return as_ulong(convert_char8(comparison));
}
/* The lowest lane of a mask that is not 0. */
static inline uint first_lane8(ulong mask) {
    return (63u - (uint)clz(mask & (~mask + 1ul))) >> 3;
}
static inline ulong without_lane8(ulong mask, uint lane) {
    return mask & ~(0xfful << (8u * lane));
}

/* box_interval of lib/ray.h for eight boxes, given as near and far planes by the ray's octant. */
static inline void box_interval8(const TraceRay* r, float8 near_x, float8 near_y, float8 near_z,
                                 float8 far_x, float8 far_y, float8 far_z, float8* near,
                                 float8* far) {
    const float8 nx = fma(near_x, (float8)(r->rx), (float8)(r->nx));
    const float8 ny = fma(near_y, (float8)(r->ry), (float8)(r->ny));
    const float8 nz = fma(near_z, (float8)(r->rz), (float8)(r->nz));
    const float8 fx = fma(far_x, (float8)(r->qx), (float8)(r->fx));
    const float8 fy = fma(far_y, (float8)(r->qy), (float8)(r->fy));
    const float8 fz = fma(far_z, (float8)(r->qz), (float8)(r->fz));
    *near = m_max8(m_max8(nx, ny), m_max8(nz, (float8)(r->t_min)));
    *far = m_min8(m_min8(fx, fy), fz);
}

/* The children that the ray enters, and the t at which it does. */
static inline ulong enter_wide8(global const Wide8Node* node, const TraceRay* r, float8* near) {
    const uint sx = r->octant & 1u, sy = (r->octant >> 1) & 1u, sz = r->octant >> 2;
    float8 far;
    box_interval8(r, vload8(0, node->plane[0][sx]), vload8(0, node->plane[1][sy]),
                  vload8(0, node->plane[2][sz]), vload8(0, node->plane[0][sx ^ 1u]),
                  vload8(0, node->plane[1][sy ^ 1u]), vload8(0, node->plane[2][sz ^ 1u]), near,
                  &far);
    return lane_mask8(*near <= m_min8(far, (float8)(r->t_max)));
}

#endif
