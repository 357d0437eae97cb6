/* The picture of temporal upscaling, sharpened: what a history loses when it is read between its
 * pixels. The history itself stays as it is. */
#include "lib/camera.h"
#include "shared/planes.h"
#include "upscale/fovea.h"

/* Away from the mean of its four neighbours, the less the nearer to black or white they come, and
 * not beyond what they span. */
static inline Real sharpened(global const float* plane, const Strip* s, float strength) {
    const Real middle = plane_at(plane, s, 0, 0);
    const Real a = plane_at(plane, s, -1, 0), b = plane_at(plane, s, 1, 0);
    const Real c = plane_at(plane, s, 0, -1), d = plane_at(plane, s, 0, 1);
    const Real low = m_min(m_min(m_min(a, b), m_min(c, d)), middle);
    const Real high = m_max(m_max(m_max(a, b), m_max(c, d)), middle);
    const Real room = m_max(m_min(low, splat(1.0f) - high), splat(0.0f));
    const Real part = m_sqrt(m_min(m_divide(room, m_max(high, splat(1e-4f))), splat(1.0f)));
    const Real away = fma((a + b) + (c + d), splat(-0.25f), middle);
    return clamped(fma(away, part * splat(strength), middle), low, high);
}

/* One work-item a strip of the picture, which holds what lies beyond the disk already. */
kernel void sharpen(global const FrameParams* restrict frame, uint target_width, uint target_height,
                    uint beyond, float strength, global const Fovea* restrict fovea,
                    global const float* restrict upscaled, global float4* restrict picture) {
    const Strip s = strip_of_item(target_width, target_height);
    if (s.y >= s.height)
        return;
    const uint all = target_width * target_height;
    const float across = m_divide((float)frame->width, (float)s.width);
    const float down = m_divide((float)frame->height, (float)s.height);
    Real part = splat(1.0f);
    if (beyond == MACULA_BEYOND_SMOOTH) {
        if (is_far_from_gaze(fovea, &s, across, down, fovea->radius))
            return;
        part = part_of_disk(fovea, distance_in_picture(fovea, &s, across, down));
        if (!any_lane(part > splat(0.0f)))
            return;
    }
    Real3 result;
    if (strength > 0.0f)
        result = make3(sharpened(upscaled, &s, strength), sharpened(upscaled + all, &s, strength),
                       sharpened(upscaled + 2u * all, &s, strength));
    else
        result = make3(plane_at(upscaled, &s, 0, 0), plane_at(upscaled + all, &s, 0, 0),
                       plane_at(upscaled + 2u * all, &s, 0, 0));
    if (any_lane(part < splat(1.0f))) {
        /* Beyond the disk nothing was gathered. */
        const Real3 smooth = colours_at(picture, &s, 0, 0).xyz;
        const Real3 mixed = select3(part > splat(0.0f), lerp3(smooth, result, part), smooth);
        result = select3(part < splat(1.0f), mixed, result);
    }
    store_colours(picture, &s, result);
}
