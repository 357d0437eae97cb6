/* Reprojection (Weier et al. 2016, section 3.2) and the detection of its errors (3.3): last frame's
 * support G-buffer becomes a mesh, seen from this frame's camera and rasterised at full
 * resolution. Which cell a pixel belongs to is decided by an integer minimum, so that no order of
 * execution shows. */
#include "lib/camera.h"
#include "lib/reprojection.h"

/* View vector of a place in last frame's image with depth 1, in camera space. */
static inline float3 slope_at(global const Camera* camera, uint width, uint height, float x,
                              float y) {
    const float step_x = m_divide(camera->tan_right + camera->tan_left, (float)width);
    const float step_y = m_divide(camera->tan_up + camera->tan_down, (float)height);
    return (float3)(fma(x, step_x, -camera->tan_left), fma(y, -step_y, camera->tan_up), 1.0f);
}

static inline float3 to_world(global const Camera* camera, float3 v) {
    return scale_add3(vector_at(camera->right), v.x,
                      scale_add3(vector_at(camera->up), v.y, vector_at(camera->forward) * v.z));
}

/* The support sample's inverse depth, 0 where it is not a depth. */
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

/* What is not in front of the camera. */
#define NO_VERTEX ((float4)(0.0f, 0.0f, -1.0f, 0.0f))

/* The vertex (lib/reprojection.h) for a place in last frame's image and its inverse depth there. */
static inline float4 project_vertex(global const FrameParams* frame, float x, float y,
                                    float inverse) {
    const float depth = m_divide(1.0f, inverse);
    const uint width = frame->width, height = frame->height;
    global const Camera *past = &frame->previous_camera, *now = &frame->camera;
    const float3 direction = to_world(past, slope_at(past, width, height, x, y));
    const float3 view =
        scale_add3(direction, depth, vector_at(past->origin) - vector_at(now->origin));
    float new_x, new_y;
    if (!camera_project(now, width, height, view, &new_x, &new_y))
        return NO_VERTEX;
    const float new_depth = dot3(view, vector_at(now->forward));
    return (float4)(clamped(new_x, -1e6f, 1e6f), clamped(new_y, -1e6f, 1e6f),
                    m_divide(1.0f, new_depth), m_divide(depth, new_depth));
}

/* One work-item a support sample. `columns`, `rows`: where the samples lie, pixels;
 * `mesh_columns`, `mesh_rows`: the same with the outermost ones on the image's edge. */
kernel void project_mesh(global const FrameParams* restrict frame,
                         global const WeierParams* restrict weier,
                         global const float* restrict columns, global const float* restrict rows,
                         global const float* restrict mesh_columns,
                         global const float* restrict mesh_rows,
                         global const float4* restrict support, global float4* restrict vertices) {
    const uint index = (uint)get_global_id(0);
    const uint across = weier->support_width, down = weier->support_height;
    if (index >= across * down)
        return;
    const uint i = index % across, j = index / across;
    float inverse = inverse_depth_of(support[index]);
    if (!(inverse > 0.0f)) {
        vertices[index] = NO_VERTEX;
        return;
    }
    const float x = mesh_columns[i], y = mesh_rows[j];
    const uint inner_i = i == 0u ? 1u : (i + 1u == across ? i - 1u : i);
    const uint inner_j = j == 0u ? 1u : (j + 1u == down ? j - 1u : j);
    if (inner_i != i)
        inverse = carried_on(inverse, inverse_depth_of(support[j * across + inner_i]),
                             columns[i] - columns[inner_i], x - columns[i]);
    if (inner_j != j)
        inverse = carried_on(inverse, inverse_depth_of(support[inner_j * across + i]),
                             rows[j] - rows[inner_j], y - rows[j]);
    vertices[index] = project_vertex(frame, x, y, inverse);
}

/* A support sample as the detection of errors sees it. */
typedef struct Corner {
    float3 ray, normal; /* world space; the ray's depth is 1 */
    float inverse_depth, luminance;
    float along; /* normal . ray: below 0 */
} Corner;

static inline float luminance_of(float4 colour) {
    return clamped(fma(colour.x, 0.2126f, fma(colour.y, 0.7152f, colour.z * 0.0722f)), 0.0f, 1.0f);
}

static inline Corner corner_at(float3 ray, float4 geometry, float4 colour) {
    Corner corner;
    corner.ray = ray;
    corner.normal = geometry.xyz;
    corner.inverse_depth = inverse_depth_of(geometry);
    corner.luminance = luminance_of(colour);
    corner.along = dot3(corner.normal, ray);
    return corner;
}

/* How far `other` is from the plane of `corner`, as a part of the depth: along a plane the inverse
 * depth goes as normal . ray. The background's normal is 0; it fits itself alone. */
static inline float off_plane(const Corner* corner, const Corner* other) {
    if (corner->along > -1e-6f)
        return other->along > -1e-6f ? 0.0f : 1.0f;
    const float expected =
        corner->inverse_depth * m_divide(dot3(corner->normal, other->ray), corner->along);
    const float larger = m_max(expected, other->inverse_depth);
    return m_divide(fabs(expected - other->inverse_depth), larger);
}

/* The depth's difference beyond the surface's own slope, seen from both ends. */
static inline float jump_between(const Corner* a, const Corner* b) {
    return m_max(off_plane(a, b), off_plane(b, a));
}

/* edge_t of section 3.3. */
static inline float edge_of(const Corner* corner) {
    return -corner->along * m_inverse_sqrt(dot3(corner->ray, corner->ray));
}

static inline float length_ratio(float4 a, float4 b, float before) {
    const float2 now = b.xy - a.xy;
    return m_divide(m_sqrt(fma(now.x, now.x, now.y * now.y)), before);
}

/* MACULA_RESAMPLE_* of a cell whose corners are p[0..3] in rows. */
static inline uint errors_of(const Corner* c, const float4* v, float2 size,
                             global const WeierParams* weier) {
    const float jump = m_max(m_max(jump_between(c, c + 1), jump_between(c + 2, c + 3)),
                             m_max(jump_between(c, c + 2), jump_between(c + 1, c + 3)));
    const float across = m_max(jump_between(c, c + 3), jump_between(c + 1, c + 2));
    const float bright =
        m_max(m_max(c[0].luminance, c[1].luminance), m_max(c[2].luminance, c[3].luminance));
    const float dark =
        m_min(m_min(c[0].luminance, c[1].luminance), m_min(c[2].luminance, c[3].luminance));
    const float stretch =
        m_max(m_max(length_ratio(v[0], v[1], size.x), length_ratio(v[2], v[3], size.x)),
              m_max(length_ratio(v[0], v[2], size.y), length_ratio(v[1], v[3], size.y)));
    uint errors = m_max(jump, across) > weier->depth_threshold ? MACULA_RESAMPLE_DEPTH : 0u;
    errors |= bright - dark > weier->luminance_threshold ? MACULA_RESAMPLE_LUMINANCE : 0u;
    errors |= stretch > weier->stretch_threshold ? MACULA_RESAMPLE_STRETCHED : 0u;
    for (uint k = 0u; k < 4u; ++k)
        if (c[k].along < -1e-6f && edge_of(c + k) < weier->edge_threshold)
            errors |= MACULA_RESAMPLE_GRAZING;
    return errors;
}

/* Cells that span more pixels than this in x or y are not drawn: nothing is known there. */
#define MOST_PIXELS 64.0f
/* Pixels next to a cell that still count as its own, so that rounding leaves no gap. */
#define OVERLAP 0.002f

/* A triangle as three planes over the screen: two weights that lie in [0, 1] with their sum inside
 * it, and the inverse depth. */
typedef struct Plane2 {
    float at, per_x, per_y;
} Plane2;

typedef struct Raster {
    Plane2 b, c, inverse_depth;
} Raster;

/* False for a triangle that faces away or has no area. `turn`: 1 or -1, the sign of its area in the
 * last frame. */
static inline bool make_raster(float4 a, float4 b, float4 c, float turn, Raster* r) {
    const float2 side = b.xy - a.xy, diagonal = c.xy - a.xy;
    const float area = cross2(side, diagonal);
    if (!(area * turn > 1e-6f))
        return false;
    const float share = m_divide(1.0f, area);
    r->b.per_x = diagonal.y * share;
    r->b.per_y = -diagonal.x * share;
    r->b.at = 0.0f;
    r->c.per_x = -side.y * share;
    r->c.per_y = side.x * share;
    r->c.at = 0.0f;
    const float by_b = b.z - a.z, by_c = c.z - a.z;
    r->inverse_depth.at = a.z;
    r->inverse_depth.per_x = fma(by_b, r->b.per_x, by_c * r->c.per_x);
    r->inverse_depth.per_y = fma(by_b, r->b.per_y, by_c * r->c.per_y);
    return true;
}

static inline float8 along_row(const Plane2* plane, float8 x, float y) {
    return fma((float8)(plane->per_x), x, (float8)(fma(plane->per_y, y, plane->at)));
}

static inline int8 inside_triangle(const Raster* r, float8 x, float y) {
    const float8 b = along_row(&r->b, x, y), c = along_row(&r->c, x, y);
    return (b >= -OVERLAP) & (c >= -OVERLAP) & (b + c <= 1.0f + OVERLAP);
}

static inline uint8 ranks(float8 inverse_depth, uint depth_bits) {
    float8 kept = inverse_depth < MACULA_LEAST_INVERSE_DEPTH ? (float8)(MACULA_LEAST_INVERSE_DEPTH)
                                                             : inverse_depth;
    kept = kept > MACULA_GREATEST_INVERSE_DEPTH ? (float8)(MACULA_GREATEST_INVERSE_DEPTH) : kept;
    const uint8 steps =
        (as_uint8(kept) - as_uint(MACULA_LEAST_INVERSE_DEPTH)) >> (28u - depth_bits);
    const uint last = (1u << depth_bits) - 1u;
    return steps == 0u ? (uint8)(last - 1u) : last - steps;
}

typedef struct Cell {
    Raster upper, lower;
    bool has_upper, has_lower;
    uint key;  /* without the rank */
    bool torn; /* drawn behind everything else */
} Cell;

/* Keys of eight pixels of a row; x and y relative to the cell's first corner. */
static inline uint8 keys_of_row(const Cell* cell, global const WeierParams* weier, float8 x,
                                float y) {
    const int8 none = (int8)(0);
    const int8 in_upper = cell->has_upper ? inside_triangle(&cell->upper, x, y) : none;
    const int8 in_lower = cell->has_lower ? inside_triangle(&cell->lower, x, y) : none;
    const float8 depth = in_upper ? along_row(&cell->upper.inverse_depth, x, y)
                                  : along_row(&cell->lower.inverse_depth, x, y);
    const uint last = (1u << weier->depth_bits) - 1u;
    const uint8 rank = cell->torn ? (uint8)(last) : ranks(depth, weier->depth_bits);
    const uint8 key = rank << (32u - weier->depth_bits) | cell->key;
    return (in_upper | in_lower) ? key : (uint8)(MACULA_NO_KEY);
}

static inline void draw(const Cell* cell, global const FrameParams* frame,
                        global const WeierParams* weier, float2 origin, float4 box,
                        global uint* keys) {
    const int x_begin = max((int)rint(floor(box.x)), 0), y_begin = max((int)rint(floor(box.y)), 0);
    const int x_end = min((int)rint(floor(box.z)) + 1, (int)frame->width);
    const int y_end = min((int)rint(floor(box.w)) + 1, (int)frame->height);
    const float8 lanes = (float8)(0, 1, 2, 3, 4, 5, 6, 7) + (0.5f - origin.x);
    for (int y = y_begin; y < y_end; ++y) {
        global uint* row = keys + (uint)y * weier->pitch;
        for (int x = x_begin; x < x_end; x += 8) {
            const uint8 key =
                keys_of_row(cell, weier, lanes + (float)x, ((float)y + 0.5f) - origin.y);
            uint found[8];
            vstore8(key, 0, found);
            const int count = min(8, x_end - x);
            for (int lane = 0; lane < count; ++lane)
                /* Keys only fall: what is not below a key read now never will be. */
                if (found[lane] < row[x + lane])
                    atomic_min(row + x + lane, found[lane]);
        }
    }
}

static inline float4 box_of(const float4* v) {
    const float2 low = (float2)(m_min(m_min(v[0].x, v[1].x), m_min(v[2].x, v[3].x)),
                                m_min(m_min(v[0].y, v[1].y), m_min(v[2].y, v[3].y)));
    const float2 high = (float2)(m_max(m_max(v[0].x, v[1].x), m_max(v[2].x, v[3].x)),
                                 m_max(m_max(v[0].y, v[1].y), m_max(v[2].y, v[3].y)));
    return (float4)(low - 0.5f, high);
}

/* Nothing is drawn of a cell that lies outside of the view or spans too many pixels. */
static inline bool is_drawable(const float4* v, global const FrameParams* frame) {
    const float4 box = box_of(v);
    return v[0].z > 0.0f && v[1].z > 0.0f && v[2].z > 0.0f && v[3].z > 0.0f && box.z > 0.0f &&
           box.w > 0.0f && box.x < (float)frame->width && box.y < (float)frame->height &&
           box.z - box.x < MOST_PIXELS && box.w - box.y < MOST_PIXELS;
}

/* `place`: the key without its rank. */
static inline void draw_cell(const float4* v, uint place, bool torn,
                             global const FrameParams* frame, global const WeierParams* weier,
                             global uint* keys) {
    if (!is_drawable(v, frame))
        return;
    Cell cell;
    cell.has_upper = make_raster(v[0], v[1], v[3], 1.0f, &cell.upper);
    cell.has_lower = make_raster(v[0], v[2], v[3], -1.0f, &cell.lower);
    if (!cell.has_upper && !cell.has_lower)
        return;
    if (!cell.has_lower)
        cell.lower = cell.upper;
    cell.torn = torn;
    cell.key = place;
    draw(&cell, frame, weier, v[0].xy, box_of(v), keys);
}

/* One work-item a support sample; it draws the cell to the right of and below it. errors: the
 * resampling info, one word a support sample.
 *
 * A cell across a silhouette is drawn twice, both times for new samples. As it is, behind all else,
 * it covers what the front surface no longer hides. With all its corners moved to the front
 * surface's depth it covers the fringe between the last sample on that surface and its edge, which
 * the mesh would lose to whatever passes behind. */
kernel void draw_mesh(global const FrameParams* restrict frame,
                      global const WeierParams* restrict weier,
                      global const float* restrict mesh_columns,
                      global const float* restrict mesh_rows, global const float4* restrict support,
                      global const float4* restrict support_image,
                      global const float4* restrict vertices, global uint* restrict errors,
                      global uint* restrict keys) {
    const uint index = (uint)get_global_id(0);
    const uint across = weier->support_width, down = weier->support_height;
    if (index >= across * down)
        return;
    const uint i = index % across, j = index / across;
    errors[index] = 0u;
    if (i + 1u >= across || j + 1u >= down)
        return;
    const uint corners[4] = {index, index + 1u, index + across, index + across + 1u};
    float4 v[4];
    Corner c[4];
    for (uint k = 0u; k < 4u; ++k) {
        v[k] = vertices[corners[k]];
        const float3 slope = slope_at(&frame->previous_camera, frame->width, frame->height,
                                      mesh_columns[i + (k & 1u)], mesh_rows[j + (k >> 1)]);
        c[k] = corner_at(to_world(&frame->previous_camera, slope), support[corners[k]],
                         support_image[corners[k]]);
    }
    if (!is_drawable(v, frame))
        return;
    const float2 size =
        (float2)(mesh_columns[i + 1u] - mesh_columns[i], mesh_rows[j + 1u] - mesh_rows[j]);
    const uint found = errors_of(c, v, size, weier);
    errors[index] = found | MACULA_CELL_IN_VIEW;
    const uint place = (j << weier->cell_bits_x | i) << 1 | (found != 0u ? 1u : 0u);
    const bool torn = (found & MACULA_RESAMPLE_DEPTH) != 0u;
    draw_cell(v, place, torn, frame, weier, keys);
    if (!torn)
        return;
    const float front = m_max(m_max(c[0].inverse_depth, c[1].inverse_depth),
                              m_max(c[2].inverse_depth, c[3].inverse_depth));
    for (uint k = 0u; k < 4u; ++k)
        if (c[k].inverse_depth < fma(-0.5f, weier->depth_threshold, 1.0f) * front)
            v[k] =
                project_vertex(frame, mesh_columns[i + (k & 1u)], mesh_rows[j + (k >> 1)], front);
    draw_cell(v, place, false, frame, weier, keys);
}

/* A cut or a teleport shows less than half of what the last frame saw: then all of the history is
 * dropped. One work-group; partial: one word of local memory for each work-item. */
kernel void judge_history(global const WeierParams* restrict weier,
                          global const uint* restrict errors, local uint* restrict partial,
                          global uint* restrict history) {
    const uint me = (uint)get_local_id(0), group = (uint)get_local_size(0);
    const uint all = weier->support_width * weier->support_height;
    uint in_view = 0u;
    for (uint index = me; index < all; index += group)
        in_view += (errors[index] & MACULA_CELL_IN_VIEW) != 0u ? 1u : 0u;
    partial[me] = in_view;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (me == 0u) {
        uint sum = 0u;
        for (uint k = 0u; k < group; ++k)
            sum += partial[k];
        *history = sum * 2u >= (weier->support_width - 1u) * (weier->support_height - 1u);
    }
}
