/* Where the rings of pixel blocks lie (shared/rings.h), and which block a pixel belongs to. */
#ifndef MACULA_LIB_RINGS_H
#define MACULA_LIB_RINGS_H

#include "lib/vector.h"
#include "shared/camera.h"
#include "shared/rings.h"

MACULA_SHARED_BEGIN

/* Cosine of the angle at which the gaze is taken to leave the image for good. */
#define MACULA_LEAST_FORWARD 0.05f

/* Pixels along an axis. */
typedef struct PixelSpan {
    int first, end;
} PixelSpan;

/* The pixels between the directions whose tangents are the gaze's turned by an angle either way,
 * rounded outwards to a multiple of `block` and cut off not far beyond the image.
 * `gaze`: its tangent along the axis; `turn`: that of the angle; `edge`: the tangent of the image's
 * first edge; `scale`: pixels a unit of tangent; `size`: the image's pixels. */
MACULA_ALWAYS_INLINE PixelSpan span_around_gaze(float gaze, float turn, float edge, float scale,
                                                uint size, uint block) {
    /* tan(a -+ b); a turn past a right angle from the axis sees all of that side. */
    const float before = fma(gaze, turn, 1.0f), behind = fma(gaze, -turn, 1.0f);
    const float far = (float)(size + MACULA_WIDEST_BLOCK), least = 1e-6f;
    const float first = before > least ? (m_divide(gaze - turn, before) + edge) * scale : -far;
    const float last = behind > least ? (m_divide(gaze + turn, behind) + edge) * scale : far;
    const float inverse = block == 2u ? 0.5f : block == 4u ? 0.25f : 0.125f;
    const float outermost = (float)MACULA_WIDEST_BLOCK;
    PixelSpan span;
    span.first = (int)floor(clamped(first, -outermost, far) * inverse) * (int)block;
    span.end = -(int)floor(clamped(last, -outermost, far) * -inverse) * (int)block;
    return span;
}

/* All rectangles of a frame. */
MACULA_ALWAYS_INLINE void place_rings_of(MACULA_GLOBAL const FrameParams* frame,
                                         MACULA_GLOBAL const RingParams* params,
                                         MACULA_GLOBAL Rings* rings) {
    MACULA_GLOBAL const Camera* camera = &frame->camera;
    const float3 gaze = vector_at(frame->gaze);
    const float forward = m_max(dot3(gaze, vector_at(camera->forward)), MACULA_LEAST_FORWARD);
    const float right = m_divide(dot3(gaze, vector_at(camera->right)), forward);
    const float down = -m_divide(dot3(gaze, vector_at(camera->up)), forward);
    const float per_x = m_divide((float)frame->width, camera->tan_right + camera->tan_left);
    const float per_y = m_divide((float)frame->height, camera->tan_up + camera->tan_down);
    for (uint k = 0u; k < MACULA_RING_EDGES; ++k) {
        const float degrees = params->degrees[k] * frame->gaze_widening;
        const bool everything = degrees >= 89.9f;
        float cosine;
        const float sine = m_sin_cos_pi((everything ? 45.0f : degrees) * 0.00555555556f, &cosine);
        const float turn = m_divide(sine, cosine);
        const PixelSpan x =
            span_around_gaze(right, turn, camera->tan_left, per_x, frame->width, 2u << k);
        const PixelSpan y =
            span_around_gaze(down, turn, camera->tan_up, per_y, frame->height, 2u << k);
        const int outermost = MACULA_WIDEST_BLOCK;
        rings->left[k] = everything ? -outermost : x.first;
        rings->top[k] = everything ? -outermost : y.first;
        rings->right[k] = everything ? (int)(frame->width / 8u + 2u) * outermost : x.end;
        rings->bottom[k] = everything ? (int)(frame->height / 8u + 2u) * outermost : y.end;
    }
}

/* True where a rectangle of pixels touches the one within edge k. */
MACULA_ALWAYS_INLINE bool touches_ring(MACULA_GLOBAL const Rings* rings, uint k, int left, int top,
                                       int right, int bottom) {
    return left < rings->right[k] && right > rings->left[k] && top < rings->bottom[k] &&
           bottom > rings->top[k];
}

/* The width of the smallest block that a rectangle of pixels touches. */
MACULA_ALWAYS_INLINE int smallest_block(MACULA_GLOBAL const Rings* rings, int left, int top,
                                        int right, int bottom) {
    if (touches_ring(rings, 0u, left, top, right, bottom))
        return 1;
    if (touches_ring(rings, 1u, left, top, right, bottom))
        return 2;
    return touches_ring(rings, 2u, left, top, right, bottom) ? 4 : MACULA_WIDEST_BLOCK;
}

/* The width of the block that a pixel belongs to. It begins at the multiples of it. */
MACULA_ALWAYS_INLINE int block_of_pixel(MACULA_GLOBAL const Rings* rings, int x, int y) {
    return smallest_block(rings, x, y, x + 1, y + 1);
}

MACULA_SHARED_END
#endif
