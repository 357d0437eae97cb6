/* Reprojection (Weier et al. 2016, section 3.2): last frame's support G-buffer becomes a mesh, seen
 * from this frame's camera. cells.cl makes its cells, draw.cl draws them. */
#include "reproject/lanes.h"

static inline float inverse_depth_of(float4 sample) {
    const bool valid = sample.w > 0.0f && sample.w <= MACULA_BACKGROUND_DEPTH;
    return valid ? m_divide(1.0f, sample.w) : 0.0f;
}

/* The mesh reaches to the image's edge: its outermost vertices move there on the plane through
 * their neighbours, as long as that does not change the depth beyond twofold. */
static inline float carried_on(float here, float inner, float distance, float outside) {
    const float moved = fma(here - inner, m_divide(outside, distance), here);
    return inner > 0.0f && moved > 0.5f * here && moved < 2.0f * here ? moved : here;
}

/* Where the support samples lie, pixels; `mesh_`: the same with the outermost ones on the image's
 * edge. */
typedef struct Places {
    global const float *columns, *rows, *mesh_columns, *mesh_rows;
} Places;

/* The inverse depth of a sample on the mesh's edge, moved out to the image's. */
static inline float at_the_edge(global const WeierParams* weier, const Places* places,
                                global const float4* support, uint i, uint j) {
    const uint across = weier->support_width, down = weier->support_height;
    float inverse = inverse_depth_of(support[j * across + i]);
    if (!(inverse > 0.0f))
        return inverse;
    const uint inner_i = i == 0u ? 1u : (i + 1u == across ? i - 1u : i);
    const uint inner_j = j == 0u ? 1u : (j + 1u == down ? j - 1u : j);
    if (inner_i != i)
        inverse = carried_on(inverse, inverse_depth_of(support[j * across + inner_i]),
                             places->columns[i] - places->columns[inner_i],
                             places->mesh_columns[i] - places->columns[i]);
    if (inner_j != j)
        inverse = carried_on(inverse, inverse_depth_of(support[inner_j * across + i]),
                             places->rows[j] - places->rows[inner_j],
                             places->mesh_rows[j] - places->rows[j]);
    return inverse;
}

/* The motion numbers of sixteen support samples, which are kept for the cells. */
MACULA_ALWAYS_INLINE uint16 find_motions(const Motions* motions, global const uint* triangles,
                                         uint first, uint lanes, global uint* numbers) {
    uint found[16] = {0u};
    for (uint lane = 0u; motions->moved != 0u && lane < lanes; ++lane) {
        found[lane] = motion_of_triangle(motions, triangles[first + lane]);
        numbers[first + lane] = found[lane];
    }
    return vload16(0, found);
}

/* One work-item sixteen support samples of a row. triangles: what they hit, and motion: the motion
 * numbers of reproject/motion.h; where nothing moved, neither is touched. */
kernel void project_mesh(global const FrameParams* restrict frame,
                         global const WeierParams* restrict weier,
                         global const float* restrict columns, global const float* restrict rows,
                         global const float* restrict mesh_columns,
                         global const float* restrict mesh_rows,
                         global const float4* restrict support, uint moved, uint instance_count,
                         global const InstanceMotion* restrict instances,
                         global const float* restrict matrices,
                         global const uint* restrict triangles, global uint* restrict motion,
                         global float4* restrict vertices) {
    const uint across = weier->support_width, down = weier->support_height;
    const uint blocks = cell_blocks_across(across), block = (uint)get_global_id(0);
    const uint i = block % blocks * 16u, j = block / blocks;
    if (j >= down)
        return;
    const Places places = {columns, rows, mesh_columns, mesh_rows};
    const uint first = j * across + i, lanes = min(across - i, 16u);
    float inverse[16];
    vstore16(inverse_depths(load_quads(support, first, across * down).w), 0, inverse);
    const bool edge_row = j == 0u || j + 1u == down;
    for (uint lane = 0u; lane < lanes; ++lane)
        if (edge_row || i + lane == 0u || i + lane + 1u == across)
            inverse[lane] = at_the_edge(weier, &places, support, i + lane, j);
    const Vector16 ray = past_rays(frame, load_lanes(mesh_columns, i, across), mesh_rows[j]);
    const Motions motions = {moved, instance_count, instances, matrices};
    const uint16 numbers = find_motions(&motions, triangles, first, lanes, motion);
    const Quad16 v = project_vertices(frame, &motions, numbers, &ray, vload16(0, inverse));
    float x[16], y[16], z[16], w[16];
    vstore16(v.x, 0, x);
    vstore16(v.y, 0, y);
    vstore16(v.z, 0, z);
    vstore16(v.w, 0, w);
    for (uint lane = 0u; lane < lanes; ++lane)
        vertices[first + lane] = (float4)(x[lane], y[lane], z[lane], w[lane]);
}

/* The camera's way from the last frame to this one beyond which a sample tells nothing any more, as
 * a part of its depth: at 90 frames a second and 5 m that is faster than 100 m/s. */
#define MOST_WAY 0.25f

static inline uint is_left_behind(float4 sample, float way) {
    return way * inverse_depth_of(sample) > MOST_WAY ? 1u : 0u;
}

/* A cut or a teleport shows less than half of what the last frame saw, or it moves the eye by a
 * good part of the depth of half of it: then all of the history is dropped. One work-group;
 * partial: two words of local memory for each work-item. */
kernel void judge_history(global const FrameParams* restrict frame,
                          global const WeierParams* restrict weier,
                          global const uint* restrict errors, global const float4* restrict support,
                          local uint* restrict partial, global uint* restrict history) {
    const uint me = (uint)get_local_id(0), group = (uint)get_local_size(0);
    const uint all = weier->support_width * weier->support_height;
    const float3 moved =
        sub3(vector_at(frame->camera.origin), vector_at(frame->previous_camera.origin));
    const float way = m_sqrt(dot3(moved, moved));
    uint in_view = 0u, left_behind = 0u;
    for (uint index = me; index < all; index += group) {
        in_view += (errors[index] & MACULA_CELL_IN_VIEW) != 0u ? 1u : 0u;
        left_behind += is_left_behind(support[index], way);
    }
    partial[me] = in_view;
    partial[group + me] = left_behind;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (me == 0u) {
        uint seen = 0u, left = 0u;
        for (uint k = 0u; k < group; ++k) {
            seen += partial[k];
            left += partial[group + k];
        }
        const uint cells = (weier->support_width - 1u) * (weier->support_height - 1u);
        *history = seen * 2u >= cells && left * 2u <= all;
    }
}
