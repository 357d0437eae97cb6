/* Sixteen rays side by side, each lane in the very arithmetic of lib/ray.h. OpenCL C only. */
#ifndef MACULA_LIB_PACKET_H
#define MACULA_LIB_PACKET_H

#include "lib/plain_hit.h"
#include "lib/ray16.h"
#include "shared/bvh.h"

/* Sixteen rays as they lie in the queue. A lane that is not active has t_max = -1 and the origin
 * and direction of one that is, so that it enters no box and widens no frustum. */
typedef struct QueuedPacket {
    float16 ox, oy, oz, t_min;
    float16 dx, dy, dz, t_max;
} QueuedPacket;

/* The least and greatest values of the lanes, of the rays as they are or as seen from their other
 * ends (see bound_from_ends). */
typedef struct PacketBounds {
    float o_lo[3], o_hi[3]; /* origin */
    float d_lo[3], d_hi[3]; /* bounded direction */
    float t_min, t_max;
    float reach; /* largest origin component, of either end, in size */
} PacketBounds;

/* TraceRay, sixteen times; vectors are [axis]. t_max is the bound for culling: -1 in a lane that is
 * inactive, that misses the instance being traversed or whose any-hit query is answered. */
typedef struct Packet {
    float16 r[3], n[3]; /* near planes */
    float16 t_max;
    float16 t_min;
    float16 o[3];
    float16 sx, sy, sz;
    int16 kz;            /* of no meaning when all lanes have the same one */
    uint axes;           /* bit k: some lane has kz = k */
    uint octant;         /* of all lanes; an axis with directions of both signs has bit 0 */
    bool mixed;          /* the lanes have several octants */
    bool turned;         /* the bounds are those of the rays as seen from their other ends, */
    uint frustum_octant; /* and this is the octant of the rays as seen so */
    float margin;        /* more than what lanes pad planes by, as a distance */
    bool plain;          /* small enough for plain hits (lib/plain_hit.h) */
} Packet;

/* False when no lane is active. `count`: rays of the queue from the block's first one on. */
static inline bool load_packet(global const RayBlock* block, uint count, QueuedPacket* p) {
    const uint lanes = count < MACULA_RAY_BLOCK ? count : MACULA_RAY_BLOCK;
    uint source = 0u;
    while (source < lanes && !ray_is_active(block->t_min[source], block->t_max[source]))
        ++source;
    if (source == lanes)
        return false;
    p->t_min = vload16(0, block->t_min);
    p->t_max = vload16(0, block->t_max);
    const int16 active =
        (MACULA_LANES16 < (int16)((int)lanes)) & (p->t_min >= 0.0f) & (p->t_min <= p->t_max);
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

MACULA_ALWAYS_INLINE PacketBounds bound_packet(const float16 o[3], const float16 d[3],
                                               float16 t_min, float16 t_max) {
    const float16 up[8] = {o[0], o[1], o[2], d[0], d[1], d[2], t_min, t_min};
    const float16 down[8] = {-o[0], -o[1], -o[2], -d[0], -d[1], -d[2], -t_max, -t_max};
    float lo[8], hi[8];
    vstore8(least_lanes16(up), 0, lo);
    vstore8(-least_lanes16(down), 0, hi);
    PacketBounds b;
    for (uint axis = 0u; axis < 3u; ++axis) {
        b.o_lo[axis] = lo[axis];
        b.o_hi[axis] = hi[axis];
        b.d_lo[axis] = lo[3u + axis];
        b.d_hi[axis] = hi[3u + axis];
    }
    b.t_min = lo[6];
    b.t_max = hi[6];
    b.reach = 0x1p-20f;
    for (uint axis = 0u; axis < 3u; ++axis)
        b.reach = m_max(b.reach, m_max(-b.o_lo[axis], b.o_hi[axis]));
    return b;
}

#if MACULA_ANY_HIT
static inline float origin_spread(const PacketBounds* b) {
    return (b->o_hi[0] - b->o_lo[0]) + (b->o_hi[1] - b->o_lo[1]) + (b->o_hi[2] - b->o_lo[2]);
}

/* Keeps a bound of a direction component away from 0, on the side where the interval grows. */
static inline float grown(float bound, float towards) {
    return fabs(bound) < MACULA_MIN_DIRECTION ? towards : bound;
}

/* Rays towards a light have several origins and, nearly, one end: seen from there, with directions
 * as long as the rays, so that all begin at 1, their bounds are tighter. Returns whether *b was
 * replaced. */
MACULA_ALWAYS_INLINE bool bound_from_ends(const float16 o[3], const float16 d[3], float16 t_max,
                                          PacketBounds* b) {
    if (!(b->t_max <= MACULA_EMPTY))
        return false;
    const float16 length = t_max < 0.0f ? (float16)(b->t_max) : t_max;
    const float16 back[3] = {-d[0] * length, -d[1] * length, -d[2] * length};
    const float16 end[3] = {o[0] - back[0], o[1] - back[1], o[2] - back[2]};
    PacketBounds ends = bound_packet(end, back, (float16)(0.0f), (float16)(1.0f));
    ends.reach = m_max(ends.reach, b->reach);
    if (!(fma(ends.reach - b->reach, 0x1p-15f, origin_spread(&ends)) < origin_spread(b)))
        return false;
    for (uint axis = 0u; axis < 3u; ++axis) {
        ends.d_lo[axis] = grown(ends.d_lo[axis], -MACULA_MIN_DIRECTION);
        ends.d_hi[axis] = grown(ends.d_hi[axis], MACULA_MIN_DIRECTION);
    }
    *b = ends;
    return true;
}
#endif

static inline uint octant_of(const PacketBounds* b) {
    return (b->d_hi[0] < 0.0f ? 1u : 0u) | (b->d_hi[1] < 0.0f ? 2u : 0u) |
           (b->d_hi[2] < 0.0f ? 4u : 0u);
}

static inline bool has_both_signs(const PacketBounds* b) {
    bool both = false;
    for (uint axis = 0u; axis < 3u; ++axis)
        both |= b->d_lo[axis] < 0.0f && b->d_hi[axis] > 0.0f;
    return both;
}

/* The dominant axis that the bounds show all lanes to have, or 3. */
static inline uint common_axis(const PacketBounds* b) {
    float least[3], greatest[3];
    for (uint axis = 0u; axis < 3u; ++axis) {
        least[axis] = m_max(m_max(b->d_lo[axis], -b->d_hi[axis]), 0.0f);
        greatest[axis] = m_max(-b->d_lo[axis], b->d_hi[axis]);
    }
    if (least[0] >= greatest[1] && least[0] >= greatest[2])
        return 0u;
    if (least[1] > greatest[0] && least[1] >= greatest[2])
        return 1u;
    return least[2] > greatest[0] && least[2] > greatest[1] ? 2u : 3u;
}

static inline void shear_packet(Packet* p, const float16 d[3], const PacketBounds* b) {
    const uint kz = common_axis(b);
    if (kz < 3u) {
        const uint kx = kz == 2u ? 0u : kz + 1u, ky = kx == 2u ? 0u : kx + 1u;
        p->axes = 1u << kz;
        p->sz = p->r[kz];
        p->sx = d[kx] * p->sz;
        p->sy = d[ky] * p->sz;
        return;
    }
    p->kz = dominant_axis16(d[0], d[1], d[2]);
    p->axes = (any_lane16(p->kz == 0) ? 1u : 0u) | (any_lane16(p->kz == 1) ? 2u : 0u) |
              (any_lane16(p->kz == 2) ? 4u : 0u);
    p->sz = pick_axis16(p->kz, p->r[0], p->r[1], p->r[2]);
    p->sx = pick_axis16(p->kz, d[1], d[2], d[0]) * p->sz;
    p->sy = pick_axis16(p->kz, d[2], d[0], d[1]) * p->sz;
}

static inline bool is_plain(const PacketBounds* b) {
    float size = b->reach;
    for (uint axis = 0u; axis < 3u; ++axis)
        size = m_max(size, m_max(-b->d_lo[axis], b->d_hi[axis]));
    return size <= MACULA_PLAIN_SIZE;
}

/* make_trace_ray. */
static inline PacketBounds make_packet(const QueuedPacket* q, Packet* p) {
    const float16 d[3] = {bounded_direction16(q->dx), bounded_direction16(q->dy),
                          bounded_direction16(q->dz)};
    p->o[0] = q->ox;
    p->o[1] = q->oy;
    p->o[2] = q->oz;
    p->t_min = q->t_min;
    p->t_max = q->t_max;
    const float16 margin = MACULA_RAY_MARGIN * reach16(q->ox, q->oy, q->oz);
    for (uint axis = 0u; axis < 3u; ++axis) {
        const float16 r = m_divide((float16)(1.0f), d[axis]);
        p->r[axis] = r;
        p->n[axis] = fma(fabs(r), -margin, -(p->o[axis] * r));
    }
    PacketBounds b = bound_packet(p->o, d, q->t_min, q->t_max);
    p->octant = octant_of(&b);
    p->mixed = has_both_signs(&b);
    shear_packet(p, d, &b);
    p->plain = is_plain(&b);
    p->margin = 2.0f * MACULA_RAY_MARGIN * b.reach;
    p->turned = false;
#if MACULA_ANY_HIT
    p->turned = bound_from_ends(p->o, d, q->t_max, &b);
    p->mixed |= has_both_signs(&b);
#endif
    p->frustum_octant = octant_of(&b);
    return b;
}

/* box_interval, each lane picking its planes by its own octant. */
static inline void box_interval16(const Packet* p, const float lo[3], const float hi[3],
                                  float16* near, float16* far) {
    const float16 margin = MACULA_RAY_MARGIN * reach16(p->o[0], p->o[1], p->o[2]);
    float16 n[3], f[3];
    for (uint axis = 0u; axis < 3u; ++axis) {
        const float16 below = lo[axis], above = hi[axis], r = p->r[axis];
        const int16 negative = r < 0.0f;
        const float16 far_offset = fma(fabs(r), margin, -(p->o[axis] * r)) * MACULA_FAR_SCALE;
        n[axis] = fma(negative ? above : below, r, p->n[axis]);
        f[axis] = fma(negative ? below : above, r * MACULA_FAR_SCALE, far_offset);
    }
    *near = m_max(m_max(n[0], n[1]), m_max(n[2], p->t_min));
    *far = m_min(m_min(f[0], f[1]), f[2]);
}

/* The lanes that enter a box no later than their t_max. */
static inline int16 enter_box16(const Packet* p, const float lo[3], const float hi[3]) {
    float16 near, far;
    box_interval16(p, lo, hi, &near, &far);
    return near <= m_min(far, p->t_max);
}

#endif
