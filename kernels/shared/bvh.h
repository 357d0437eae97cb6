/* Node and triangle layouts of the lower level (one BVH for each mesh, in object space), and the
 * upper level over instances. All meshes of a scene lie one after another in one node buffer and
 * one triangle buffer of a layout; child references are absolute within these buffers.
 *
 * A child reference c >= 0 is the index of an inner node. c < 0 is a leaf: ~c holds
 * (first << 4) | count, count in 1..15, counted in triangles or in triangle blocks as the layout
 * says. An unused child slot has an inverted box (lo = +MACULA_EMPTY, hi = -MACULA_EMPTY), which
 * no ray enters as long as near and far planes are chosen by the direction's sign, and child -1, a
 * leaf of nothing. A root is always an inner node, of a mesh without triangles too. */
#ifndef MACULA_SHARED_BVH_H
#define MACULA_SHARED_BVH_H

#include "shared/language.h"

MACULA_SHARED_BEGIN

#define MACULA_EMPTY 1e30f
#define MACULA_LEAF_COUNT_BITS 4u
#define MACULA_LEAF_MAX 15
/* Deepest tree that a builder may return; traversal stacks are sized by these. */
#define MACULA_MAX_DEPTH 64
/* In a stored triangle id: the triangle has an alpha mask (shared/mask.h). */
#define MACULA_MASKED_BIT 0x80000000u
#define MACULA_ID_MASK 0x7fffffffu

/* One triangle for scalar and packet leaves. `id` is the id within the mesh, with
 * MACULA_MASKED_BIT. */
typedef struct Triangle {
    float v0[3];
    uint id;
    float v1[3];
    uint pad0;
    float v2[3];
    uint pad1;
} Triangle;
MACULA_ASSERT_SIZE(Triangle, 48);

/* Eight triangles, structure of arrays: v[vertex][axis][lane]. Unused lanes have all vertices at
 * the origin (never hit: zero determinant) and id = MACULA_NO_TRIANGLE. */
typedef struct TriangleBlock8 {
    float v[3][3][8];
    uint id[8];
} TriangleBlock8;
MACULA_ASSERT_SIZE(TriangleBlock8, 320);

/* Layout `binary` (Aila and Laine 2009): both children's boxes in the parent.
 * box[child][axis][lo, hi]; leaves count Triangles. */
typedef struct BinaryNode {
    float box[2][3][2];
    int child[2];
    uint pad[2];
} BinaryNode;
MACULA_ASSERT_SIZE(BinaryNode, 64);

/* Layout `wide8`: eight children, plane[axis][lo, hi][child]. Leaves count TriangleBlock8
 * (`wide8` with block leaves) or Triangles (`wide8` with single leaves, for packets). */
typedef struct Wide8Node {
    float plane[3][2][8];
    int child[8];
    uint pad[8];
} Wide8Node;
MACULA_ASSERT_SIZE(Wide8Node, 256);

/* Layout `skip` (Thrane and Simonsen 2005): nodes in depth-first order. After a miss, or after a
 * leaf, go on at `skip`; after a hit inner node at the next one. count = 0 marks an inner node;
 * a leaf holds Triangles first .. first + count - 1. skip = MACULA_SKIP_END ends the traversal. */
#define MACULA_SKIP_END 0xffffffffu
typedef struct SkipNode {
    float lo[3];
    uint skip;
    float hi[3];
    uint leaf; /* (first << 4) | count, 0 for an inner node */
} SkipNode;
MACULA_ASSERT_SIZE(SkipNode, 32);

/* Layout `quantized8` (after Ylitie et al. 2017): boxes as 8-bit offsets on a grid of the node's
 * own box: lo = fma(q, scale, origin). Quantised boxes contain the exact ones as evaluated by this
 * very expression in fp32. `scale` is a power of two. child as above; leaves count Triangles. */
typedef struct Quantized8Node {
    float origin[3];
    uint exponent; /* biased exponents of scale x, y, z in bytes 0..2; byte 3: used child mask */
    int child[8];
    uchar lo[3][8];
    uchar hi[3][8];
} Quantized8Node;
MACULA_ASSERT_SIZE(Quantized8Node, 96);

/* One placed mesh. Rows of 3 x 4 matrices: p' = m[0..2] . p + m[3]. `box` is the world box that
 * every hit on the instance must also pass (docs/arithmetic.md): all variants and the brute-force
 * oracle test it with the same code as any node, then raise t to its near (lib/instance.h). */
typedef struct Instance {
    float object_from_world[3][4];
    float world_from_object[3][4];
    float previous_world_from_object[3][4]; /* last frame's, for motion vectors */
    float lo[3];
    uint first_triangle; /* scene-wide id of the mesh's triangle 0 */
    float hi[3];
    uint mesh;          /* index into the mesh table */
    int root;           /* child reference of the lower level's root in the layout in use */
    uint mesh_triangle; /* index of the mesh's triangle 0 in the per-mesh triangle tables */
    uint triangle_count;
    uint identity; /* 1: the matrices are exactly the identity */
} Instance;
MACULA_ASSERT_SIZE(Instance, 192);

/* The upper level is a BinaryNode tree whose leaves hold instance indices: count is 1 and first is
 * the instance. It is rebuilt on the host for each frame in which something moved. */

MACULA_SHARED_END
#endif
