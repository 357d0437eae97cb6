/* Where what moves changed what is seen: its shadow or its mirror image passes, or it was nowhere
 * in the last frame, so that the history shows what is no longer so. The support samples tell, each
 * frame and everywhere; the next frame samples the cells about them. */
#include "lib/camera.h"
#include "lib/reprojection.h"

static inline float luminance_of(float4 colour) {
    const float value = fma(colour.x, 0.2126f, fma(colour.y, 0.7152f, colour.z * 0.0722f));
    return value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
}

/* How much brighter `fresh` is than anything of the history about it, as a part of the larger of
 * the two; below 0 where it is darker. Black is as bright as what nobody tells from it. */
static inline float difference_from(global const float4* past, uint width, uint height,
                                    const Footing* f, float fresh) {
    const int right = f->to_x != 0.0f ? 1 : 0, below = f->to_y != 0.0f ? 1 : 0;
    const float a = luminance_of(past[texel_index(f->x, f->y, width, height)]);
    const float b = luminance_of(past[texel_index(f->x + right, f->y, width, height)]);
    const float c = luminance_of(past[texel_index(f->x, f->y + below, width, height)]);
    const float d = luminance_of(past[texel_index(f->x + right, f->y + below, width, height)]);
    const float low = m_min(m_min(a, b), m_min(c, d)), high = m_max(m_max(a, b), m_max(c, d));
    const float kept = fresh < low ? low : (fresh > high ? high : fresh);
    return m_divide(fresh - kept, m_max(fresh, kept) + 0x1p-5f);
}

/* Of what is another surface altogether. */
#define ANOTHER_SURFACE 4.0f
/* A change is remembered for as many frames: the edge of a shadow may take them to the next sample.
 */
#define CHANGE_FRAMES 16u

/* What is remembered of the change that was found where a history lay. */
static inline uint remembered_at(global const WeierParams* weier, global const FrameParams* frame,
                                 global const uint* past_change, float2 at) {
    const uint across = weier->support_width, down = weier->support_height;
    const float x = place_in_support((uint)m_max(at.x, 0.0f), frame->width, across);
    const float y = place_in_support((uint)m_max(at.y, 0.0f), frame->height, down);
    const uint found = past_change[texel_index((int)x, (int)y, across, down)];
    if ((found & MACULA_CHANGE_NOW) != 0u)
        return MACULA_CHANGE_FRAME * CHANGE_FRAMES;
    return found != 0u ? found - MACULA_CHANGE_FRAME : 0u;
}

/* difference[i]: of the fresh support sample i from its history, 0 where there is none to compare
 * with and at silhouettes, which are sampled anyway. change[i]: what is remembered there. One
 * work-item a support sample. */
kernel void
measure_change(global const FrameParams* restrict frame, global const WeierParams* restrict weier,
               global const float* restrict columns, global const float* restrict rows,
               global const float* restrict mesh_columns, global const float* restrict mesh_rows,
               global const float4* restrict vertices, global const uint* restrict keys,
               global const uint* restrict errors, global const uint* restrict history_kept,
               global const float4* restrict past_colour, global const uint* restrict past_change,
               global const float4* restrict support_image,
               global const float4* restrict support_geometry, global float* restrict difference,
               global uint* restrict change) {
    const uint index = (uint)get_global_id(0);
    const uint across = weier->support_width, row = index / across;
    if (row >= weier->support_height)
        return;
    const float x = columns[index % across], y = rows[row];
    const uint key = keys[(uint)y * weier->pitch + (uint)x];
    difference[index] = 0.0f;
    change[index] = 0u;
    if (*history_kept == 0u || key == MACULA_NO_KEY)
        return;
    const uint cell = cell_of_key(key, weier);
    const uint i = cell & ((1u << weier->cell_bits_x) - 1u), j = cell >> weier->cell_bits_x;
    if ((errors[j * across + i] & MACULA_RESAMPLE_DEPTH) != 0u)
        return;
    const MeshTables mesh = {vertices, mesh_columns, mesh_rows};
    const History h = find_history(&mesh, weier, key, x, y);
    if (!h.found)
        return;
    change[index] = remembered_at(weier, frame, past_change, h.at);
    if (fabs(fma(support_geometry[index].w, h.inverse_depth, -1.0f)) > weier->merge_threshold) {
        difference[index] = ANOTHER_SURFACE;
        return;
    }
    const float2 at = h.at + (float2)(frame->jitter[0], frame->jitter[1]);
    const Footing f = footing_at(
        clamp(at, (float2)(0.0f), (float2)((float)frame->width, (float)frame->height)));
    difference[index] = difference_from(past_colour, frame->width, frame->height, &f,
                                        luminance_of(support_image[index]));
}

/* What is seen as a change, as a part of the brightness. */
#define LEAST_CHANGE 0x1p-3f

/* The differences of a sample and its eight neighbours may be noise, whose squares add up: the
 * square of their sum must be MACULA_NOISE times as large, 0 where there is none. */
static inline bool is_significant(global const float* difference, int x, int y, uint across,
                                  uint down) {
    float sum = 0.0f, squares = 0.0f;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            const float from = difference[texel_index(x + i, y + j, across, down)];
            const float there = from >= ANOTHER_SURFACE ? 0.0f : from; /* says nothing of light */
            sum += there;
            squares = fma(there, there, squares);
        }
    return sum * sum >= (float)MACULA_NOISE * squares;
}

/* change[i]: MACULA_CHANGE_* of support sample i. One work-item a support sample. */
kernel void find_change(global const WeierParams* restrict weier,
                        global const float* restrict difference, global uint* restrict change) {
    const uint index = (uint)get_global_id(0);
    const uint across = weier->support_width, down = weier->support_height;
    if (index >= across * down)
        return;
    const float here = fabs(difference[index]);
    const int x = (int)(index % across), y = (int)(index / across);
    if (here >= ANOTHER_SURFACE)
        change[index] = MACULA_CHANGE_OF_SURFACE;
    else if (here > LEAST_CHANGE && is_significant(difference, x, y, across, down))
        change[index] = MACULA_CHANGE_OF_LIGHT;
}
