/* Refresh rate modulation: refreshed pixels go into the picture that persists, and tell their
 * groups whether they have changed. One lane. */
#include "refresh/places.h"

/* True where the pixel's group is to be refreshed more often. */
static inline bool is_busy(global const RefreshPlan* plan, float4 shown, float4 now,
                           global const float2* motion, uint slot) {
    const float red = clamped(shown.x, 0.0f, 1.0f) - clamped(now.x, 0.0f, 1.0f);
    const float green = clamped(shown.y, 0.0f, 1.0f) - clamped(now.y, 0.0f, 1.0f);
    const float blue = clamped(shown.z, 0.0f, 1.0f) - clamped(now.z, 0.0f, 1.0f);
    bool busy = plan->change > 0.0f && largest3(make3(red, green, blue)) > plan->change;
    if (motion) {
        const float2 m = motion[slot];
        busy = busy || (plan->motion_squared > 0.0f &&
                        fma(m.x, m.x, m.y * m.y) > plan->motion_squared);
    }
    return busy;
}

/* Adds sample `sample` of each slot to its pixel; after its last one the sum becomes the mean: the
 * same sum as average_samples() of shade/resolve.cl makes. One work-item a slot. busy_until: of
 * quads, a frame of the plan; all slots that write there write the same. Null: motion, busy_until
 * where nobody looks for busy groups. */
kernel void keep_refreshed(global const FrameParams* restrict frame,
                           global const RefreshPlan* restrict plan, uint sample,
                           global const uint* restrict ray_count,
                           global const uint* restrict pixels,
                           global const float4* restrict samples,
                           global const float2* restrict motion, global uint* restrict busy_until,
                           global float4* restrict image) {
    const uint slot = (uint)get_global_id(0);
    if (slot >= *ray_count || pixels[slot] == MACULA_NO_PIXEL)
        return;
    const uint pixel = pixels[slot];
    uint count = plan->samples;
    if (plan->foveal_samples > count || busy_until) {
        const uint row = pixel / frame->width, x = pixel % frame->width;
        const bool foveal = is_foveal(frame, plan, x, row);
        count = foveal ? plan->foveal_samples : count;
        if (busy_until && !foveal && sample == 0u && plan->frame > 0u &&
            is_busy(plan, image[pixel], samples[slot], motion, slot)) {
            const uint quad_row = row / (4u * plan->group_height);
            const uint quad_column = x / (4u * plan->group_width);
            busy_until[quad_row * plan->quads_across + quad_column] = plan->frame + plan->hold + 1u;
        }
    }
    float4 sum = samples[slot];
    sum = sample == 0u ? sum : image[pixel] + sum;
    image[pixel] = sample + 1u == count ? sum * m_divide(1.0f, (float)count) : sum;
}

/* One work-item a quad, in the order of the search. */
kernel void flag_busy(global const RefreshPlan* restrict plan,
                      global const uint* restrict busy_until, global uint* restrict flags) {
    const uint index = (uint)get_global_id(0);
    if (index < plan->quads)
        flags[index] = busy_until[quad_of_search(plan, index)] > plan->frame ? 1u : 0u;
}

/* refreshed_at: the frame of the plan after the one in which a pixel was refreshed; 0: none yet. */
kernel void note_refresh(global const RefreshPlan* restrict plan,
                         global const uint* restrict ray_count, global const uint* restrict pixels,
                         global uint* restrict refreshed_at) {
    const uint slot = (uint)get_global_id(0);
    if (slot < *ray_count && pixels[slot] != MACULA_NO_PIXEL)
        refreshed_at[pixels[slot]] = plan->frame + 1u;
}

#define NEVER 1048575u

/* One work-item a pixel. */
kernel void show_age(global const RefreshPlan* restrict plan, uint count,
                     global const uint* restrict refreshed_at, global uint* restrict age) {
    const uint pixel = (uint)get_global_id(0);
    if (pixel >= count)
        return;
    const uint at = refreshed_at[pixel];
    age[pixel] = at == 0u ? NEVER : plan->frame + 1u - at;
}
