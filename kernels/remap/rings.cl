/* From the blocks of the rings around the gaze to the image: a box as wide as the blocks runs over
 * them (Smith et al. 2014, section 3.2.1: the blur that hides pixelation and seams). Over blocks of
 * its own width a box is the interpolation between their middles. */
#include "lib/camera.h"
#include "lib/lane_memory.h"
#include "lib/rings.h"
#include "shared/ray.h"

/* How far a pixel's middle lies beyond the rectangle within edge k; not above 0 in it. */
static inline Real beyond_edge(global const Rings* rings, uint k, Real x, Real y) {
    const Real across =
        m_max(splat((float)rings->left[k]) - x, x - splat((float)rings->right[k]));
    const Real down = m_max(splat((float)rings->top[k]) - y, y - splat((float)rings->bottom[k]));
    return m_max(across, down);
}

/* The box's width: a pixel in the fovea; from each edge on it grows by half a pixel a pixel until
 * it is the blocks' there. */
static inline Real blur_width(global const Rings* rings, Real x, Real y) {
    Real width = splat(1.0f);
    for (uint k = 0u; k < MACULA_RING_EDGES; ++k) {
        const Real beyond = 0.5f * beyond_edge(rings, k, x, y);
        width = width + clamped(beyond, splat(0.0f), splat((float)(1u << k)));
    }
    return width;
}

/* The same for the whole of a packet: the widest box in it. */
static inline float widest_box(global const Rings* rings, int x0, int y0) {
    float width = 1.0f;
    for (uint k = 0u; k < MACULA_RING_EDGES; ++k) {
        const int across = max(rings->left[k] - x0, x0 + 4 - rings->right[k]);
        const int down = max(rings->top[k] - y0, y0 + 4 - rings->bottom[k]);
        const float beyond = 0.5f * (float)max(across, down);
        width += clamped(beyond, 0.0f, (float)(1u << k));
    }
    return width;
}

/* A box around each lane's pixel, cut off at the image's edges. */
typedef struct Boxes {
    Real left, right, top, bottom;
} Boxes;

/* Cells of which every lane's box is made, each a part of one block. */
typedef struct Cells {
    int left, right, top, bottom; /* pixels */
    int size;
} Cells;

static inline Cells cells_of_packet(global const FrameParams* frame, global const Rings* rings,
                                    bool blur, int x0, int y0) {
    const int reach = blur ? (int)(0.5f * widest_box(rings, x0, y0) + 0.5f) : 0;
    Cells cells;
    cells.left = max(x0 - reach, 0);
    cells.top = max(y0 - reach, 0);
    cells.right = min(x0 + 4 + reach, (int)frame->width);
    cells.bottom = min(y0 + 4 + reach, (int)frame->height);
    cells.size = smallest_block(rings, cells.left, cells.top, cells.right, cells.bottom);
    cells.left &= -cells.size;
    cells.top &= -cells.size;
    return cells;
}

/* How much of a cell lies in each lane's box, along an axis. */
static inline Real overlap(Real first, Real last, int cell, int size) {
    const Real from = m_max(first, splat((float)cell));
    const Real to = m_min(last, splat((float)(cell + size)));
    return m_max(to - from, splat(0.0f));
}

static inline Real3 mean_of_blocks(global const Rings* rings, uint width, const Cells cells,
                                   const Boxes box, global const float4* blocks) {
    Real3 sum = splat_vector(splat3(0.0f));
    for (int y = cells.top; y < cells.bottom; y += cells.size) {
        const Real down = overlap(box.top, box.bottom, y, cells.size);
        for (int x = cells.left; x < cells.right; x += cells.size) {
            const int block = block_of_pixel(rings, x, y);
            const float4 colour = blocks[(uint)(y & -block) * width + (uint)(x & -block)];
            const Real weight = overlap(box.left, box.right, x, cells.size) * down;
            sum = scale_add3(splat_vector(colour.xyz), weight, sum);
        }
    }
    const Real area = (box.right - box.left) * (box.bottom - box.top);
    return scale3(sum, m_divide(splat(1.0f), m_max(area, splat(1e-6f))));
}

/* Edges white, the first row and column of wide blocks dark, the first pixel of those of 2 x 2. */
static inline Real3 with_grid(global const Rings* rings, Uint across, Uint down, Real x, Real y,
                              Real3 colour) {
    Mask edge = x < 0.0f;
    Uint block = splat_uint(1u);
    for (uint k = 0u; k < MACULA_RING_EDGES; ++k) {
        const Real beyond = beyond_edge(rings, k, x, y);
        edge = edge | ((beyond > 0.0f) & (beyond < 1.0f));
        block = beyond > 0.0f ? splat_uint(2u << k) : block;
    }
    const Mask column = (across & (block - 1u)) == 0u, row = (down & (block - 1u)) == 0u;
    const Mask wide = (block > 2u) & (column | row), narrow = (block == 2u) & column & row;
    const Real3 dark = scale3(colour, splat(0.25f));
    return select3(edge, splat_vector(splat3(1.0f)), select3(wide | narrow, dark, colour));
}

/* One work-item for MACULA_LANES slots: 4 x 4 pixels, or one. `blocks` holds the colour of each
 * block at its first pixel. */
kernel void show_rings(global const FrameParams* restrict frame,
                       global const RingParams* restrict params, global const Rings* restrict rings,
                       global const float4* restrict blocks, global float4* restrict image) {
    const uint first = first_of_item(), width = frame->width, height = frame->height;
    uint x0, y0;
    pixel_of_slot(first / MACULA_RAY_BLOCK * MACULA_RAY_BLOCK, width, &x0, &y0);
    if (x0 >= width || y0 >= height)
        return;
    const Uint slot = lanes_from(first);
    const Uint across = x0 + (slot & 3u), down = y0 + (slot >> 2 & 3u);
    const Mask inside = (across < width) & (down < height);
    const Real x = uint_to_real(across) + 0.5f, y = uint_to_real(down) + 0.5f;
    const bool blur = params->blur != 0u;
    const Real half_box = 0.5f * (blur ? blur_width(rings, x, y) : splat(1.0f));
    const Real zero = splat(0.0f);
    const Boxes box = {m_max(x - half_box, zero), m_min(x + half_box, splat((float)width)),
                       m_max(y - half_box, zero), m_min(y + half_box, splat((float)height))};
    const Cells cells = cells_of_packet(frame, rings, blur, (int)x0, (int)y0);
    Real3 colour = mean_of_blocks(rings, width, cells, box, blocks);
    if (params->grid != 0u)
        colour = with_grid(rings, across, down, x, y, colour);
#if MACULA_LANES == 16
    if (x0 + 4u <= width && y0 + 4u <= height) {
        const Slots4 rows = slots_of(colour, splat(1.0f));
        for (uint row = 0u; row < 4u; ++row)
            vstore16(rows.part[row], 0, (global float*)(image + (y0 + row) * width + x0));
        return;
    }
#endif
    scatter4(image, inside ? down * width + across : splat_uint(0u), inside, colour, splat(1.0f));
}
