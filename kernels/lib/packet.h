/* Sixteen rays side by side, each lane in the very arithmetic of lib/ray.h. OpenCL C only. */
#ifndef MACULA_LIB_PACKET_H
#define MACULA_LIB_PACKET_H

#include "lib/ray.h"
#include "lib/simd.h"
#include "shared/bvh.h"

/* Sixteen rays as they lie in the queue. A lane that is not active has t_max = -1 and the origin
 * and direction of one that is, so that it enters no box and widens no frustum. */
typedef struct QueuedPacket {
    float16 ox, oy, oz, t_min;
    float16 dx, dy, dz, t_max;
} QueuedPacket;

/* TraceRay, sixteen times. t_max is the bound for culling: -1 in a lane that is inactive, that
 * misses the instance being traversed or whose any-hit query is answered. */
typedef struct Packet {
    float16 o[3];
    float16 t_min, t_max;
    float16 rx, ry, rz, nx, ny, nz;
    float16 qx, qy, qz, fx, fy, fz;
    float16 sx, sy, sz;
    int16 kz;
    uint axes;   /* bit k: some lane has kz = k */
    uint octant; /* that of all lanes; of no meaning when mixed */
    bool mixed;  /* the lanes have several octants */
} Packet;

/* False when no lane is active. `count`: rays of the queue from the block's first one on. */
static inline bool load_packet(global const RayBlock *block, uint count, QueuedPacket *p) {
    const uint lanes = count < MACULA_RAY_BLOCK ? count : MACULA_RAY_BLOCK;
    uint source = 0u;
    while (source < lanes && !ray_is_active(block->t_min[source], block->t_max[source]))
        ++source;
    if (source == lanes)
        return false;
    p->t_min = vload16(0, block->t_min);
    p->t_max = vload16(0, block->t_max);
    const int16 active = (MACULA_LANES16 < (int16)((int)lanes)) & (p->t_min >= 0.0f) &
                         (p->t_min <= p->t_max);
    p->ox = active ? vload16(0, block->origin_x) : (float16)(block->origin_x[source]);
    p->oy = active ? vload16(0, block->origin_y) : (float16)(block->origin_y[source]);
    p->oz = active ? vload16(0, block->origin_z) : (float16)(block->origin_z[source]);
    p->dx = active ? vload16(0, block->direction_x) : (float16)(block->direction_x[source]);
    p->dy = active ? vload16(0, block->direction_y) : (float16)(block->direction_y[source]);
    p->dz = active ? vload16(0, block->direction_z) : (float16)(block->direction_z[source]);
    p->t_min = active ? p->t_min : (float16)(block->t_min[source]);
    p->t_max = active ? p->t_max : (float16)(-1.0f);
    return true;
}

static inline float16 bounded_direction16(float16 d) {
    const float16 least = d < 0.0f ? (float16)(-MACULA_MIN_DIRECTION) : MACULA_MIN_DIRECTION;
    return fabs(d) < MACULA_MIN_DIRECTION ? least : d;
}

static inline float16 pick_axis16(int16 axis, float16 x, float16 y, float16 z) {
    return axis == 0 ? x : (axis == 1 ? y : z);
}

/* The octants of the lanes, and the axes along which they are dominant. */
static inline void classify_packet(Packet *p, float16 dx, float16 dy, float16 dz) {
    const float16 ax = fabs(dx), ay = fabs(dy), az = fabs(dz);
    const int16 is_x = (ax >= ay) & (ax >= az);
    p->kz = is_x ? (int16)(0) : (ay >= az ? (int16)(1) : (int16)(2));
    p->axes = (any_lane16(p->kz == 0) ? 1u : 0u) | (any_lane16(p->kz == 1) ? 2u : 0u) |
              (any_lane16(p->kz == 2) ? 4u : 0u);
    const bool some_x = any_lane16(dx < 0.0f), all_x = !any_lane16(dx >= 0.0f);
    const bool some_y = any_lane16(dy < 0.0f), all_y = !any_lane16(dy >= 0.0f);
    const bool some_z = any_lane16(dz < 0.0f), all_z = !any_lane16(dz >= 0.0f);
    p->mixed = some_x != all_x || some_y != all_y || some_z != all_z;
    p->octant = (all_x ? 1u : 0u) | (all_y ? 2u : 0u) | (all_z ? 4u : 0u);
}

/* make_trace_ray. */
static inline Packet make_packet(float16 ox, float16 oy, float16 oz, float16 dx, float16 dy,
                                 float16 dz, float16 t_min, float16 t_max) {
    Packet p;
    dx = bounded_direction16(dx);
    dy = bounded_direction16(dy);
    dz = bounded_direction16(dz);
    p.o[0] = ox;
    p.o[1] = oy;
    p.o[2] = oz;
    p.t_min = t_min;
    p.t_max = t_max;
    p.rx = m_divide16(1.0f, dx);
    p.ry = m_divide16(1.0f, dy);
    p.rz = m_divide16(1.0f, dz);
    const float16 px = ox * p.rx, py = oy * p.ry, pz = oz * p.rz;
    const float16 reach =
        m_max16(m_max16(fabs(ox), fabs(oy)), m_max16(fabs(oz), (float16)(0x1p-20f)));
    const float16 margin = MACULA_RAY_MARGIN * reach;
    p.nx = fma(fabs(p.rx), -margin, -px);
    p.ny = fma(fabs(p.ry), -margin, -py);
    p.nz = fma(fabs(p.rz), -margin, -pz);
    p.qx = p.rx * MACULA_FAR_SCALE;
    p.qy = p.ry * MACULA_FAR_SCALE;
    p.qz = p.rz * MACULA_FAR_SCALE;
    p.fx = fma(fabs(p.rx), margin, -px) * MACULA_FAR_SCALE;
    p.fy = fma(fabs(p.ry), margin, -py) * MACULA_FAR_SCALE;
    p.fz = fma(fabs(p.rz), margin, -pz) * MACULA_FAR_SCALE;
    classify_packet(&p, dx, dy, dz);
    p.sz = pick_axis16(p.kz, p.rx, p.ry, p.rz);
    p.sx = pick_axis16(p.kz, dy, dz, dx) * p.sz;
    p.sy = pick_axis16(p.kz, dz, dx, dy) * p.sz;
    return p;
}

/* box_interval of the box that is the same for all lanes, given as near and far planes. */
static inline int16 enter_planes16(const Packet *p, float near_x, float near_y, float near_z,
                                   float far_x, float far_y, float far_z) {
    const float16 near =
        m_max16(m_max16(fma((float16)(near_x), p->rx, p->nx), fma((float16)(near_y), p->ry, p->ny)),
                m_max16(fma((float16)(near_z), p->rz, p->nz), p->t_min));
    const float16 far =
        m_min16(m_min16(fma((float16)(far_x), p->qx, p->fx), fma((float16)(far_y), p->qy, p->fy)),
                m_min16(fma((float16)(far_z), p->qz, p->fz), p->t_max));
    return near <= far;
}

/* box_interval, each lane picking its planes by its own octant. */
static inline void box_interval16(const Packet *p, float lo_x, float lo_y, float lo_z, float hi_x,
                                  float hi_y, float hi_z, float16 *near, float16 *far) {
    const float16 lx = lo_x, ly = lo_y, lz = lo_z, hx = hi_x, hy = hi_y, hz = hi_z;
    const int16 sx = p->rx < 0.0f, sy = p->ry < 0.0f, sz = p->rz < 0.0f;
    const float16 nx = fma(sx ? hx : lx, p->rx, p->nx), fx = fma(sx ? lx : hx, p->qx, p->fx);
    const float16 ny = fma(sy ? hy : ly, p->ry, p->ny), fy = fma(sy ? ly : hy, p->qy, p->fy);
    const float16 nz = fma(sz ? hz : lz, p->rz, p->nz), fz = fma(sz ? lz : hz, p->qz, p->fz);
    *near = m_max16(m_max16(nx, ny), m_max16(nz, p->t_min));
    *far = m_min16(m_min16(fx, fy), fz);
}

/* The lanes that enter a box and are not beyond their t_max in it. */
static inline int16 enter_box16(const Packet *p, float lo_x, float lo_y, float lo_z, float hi_x,
                                float hi_y, float hi_z) {
    float16 near, far;
    box_interval16(p, lo_x, lo_y, lo_z, hi_x, hi_y, hi_z, &near, &far);
    return near <= m_min16(far, p->t_max);
}

#endif
