/* One ray against the eight triangles of a TriangleBlock8. */
#ifndef MACULA_LIB_TRAVERSE_BLOCK8_H
#define MACULA_LIB_TRAVERSE_BLOCK8_H

#include "lib/traverse_query.h"
#include "lib/traverse_wide8.h"

static inline float8 difference_of_products8(float8 a, float8 b, float8 c, float8 d) {
    const float8 cd = c * d;
    return fma(a, b, -cd) + fma(-c, d, cd);
}

static inline float8 snap_tiny8(float8 x) {
    return fabs(x) < (float8)(0x1p-40f) ? (float8)(0.0f) : x;
}

static inline float8 sheared8(global const float* plane, float origin, float shear, float8 depth) {
    return snap_tiny8(fma((float8)(-shear), depth, vload8(0, plane) - (float8)(origin)));
}

/* The lanes whose triangle the ray's line crosses: the edge test of intersect_triangle, in its
 * very arithmetic. What is left of the test is done for these few lanes alone. */
static inline ulong crossed_lanes8(global const TriangleBlock8* block, const TraceRay* r) {
    const uint kx = r->kx, ky = r->ky, kz = r->kz;
    const float ox = pick_axis(kx, r->ox, r->oy, r->oz);
    const float oy = pick_axis(ky, r->ox, r->oy, r->oz);
    const float oz = pick_axis(kz, r->ox, r->oy, r->oz);
    const float8 az = vload8(0, block->v[0][kz]) - (float8)(oz);
    const float8 bz = vload8(0, block->v[1][kz]) - (float8)(oz);
    const float8 cz = vload8(0, block->v[2][kz]) - (float8)(oz);
    const float8 ax = sheared8(block->v[0][kx], ox, r->sx, az);
    const float8 ay = sheared8(block->v[0][ky], oy, r->sy, az);
    const float8 bx = sheared8(block->v[1][kx], ox, r->sx, bz);
    const float8 by = sheared8(block->v[1][ky], oy, r->sy, bz);
    const float8 cx = sheared8(block->v[2][kx], ox, r->sx, cz);
    const float8 cy = sheared8(block->v[2][ky], oy, r->sy, cz);
    const float8 wa = difference_of_products8(cx, by, cy, bx);
    const float8 wb = difference_of_products8(ax, cy, ay, cx);
    const float8 wc = difference_of_products8(bx, ay, by, ax);
    const float8 zero = (float8)(0.0f);
    const int8 any_negative = (wa < zero) | (wb < zero) | (wc < zero);
    const int8 any_positive = (wa > zero) | (wb > zero) | (wc > zero);
    return lane_mask8((any_negative ^ any_positive) & (((wa + wb) + wc) != zero));
}

/* True when the query is answered. */
static inline bool test_block8(const TraceScene* scene, TraceQuery* query,
                               global const TriangleBlock8* block) {
    ulong lanes = crossed_lanes8(block, &query->ray);
    while (lanes != 0ul) {
        const uint i = first_lane8(lanes);
        lanes = without_lane8(lanes, i);
        float t, u, v;
        if (intersect_triangle(&query->ray, block->v[0][0][i], block->v[0][1][i], block->v[0][2][i],
                               block->v[1][0][i], block->v[1][1][i], block->v[1][2][i],
                               block->v[2][0][i], block->v[2][1][i], block->v[2][2][i], &t, &u,
                               &v) &&
            accept_hit(scene, query, block->id[i], t, u, v))
            return true;
    }
    return false;
}

static inline bool test_leaf_of_blocks(const TraceScene* scene, TraceQuery* query, int leaf) {
    global const TriangleBlock8* blocks = (global const TriangleBlock8*)scene->triangles;
    const uint bits = (uint)~leaf;
    const uint first = bits >> MACULA_LEAF_COUNT_BITS;
    const uint end = first + (bits & MACULA_LEAF_MAX);
    for (uint i = first; i < end; ++i)
        if (test_block8(scene, query, blocks + i))
            return true;
    return false;
}

#endif
