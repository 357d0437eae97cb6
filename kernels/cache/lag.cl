/* How far the history lags behind what the view now shows: highlights and mirror images move over
 * surfaces, which reprojection cannot know. The support samples tell, each frame and everywhere. */
#include "lib/camera.h"
#include "cache/likeness.h"
#include "lib/reprojection.h"

/* lag[i]: the fresh support sample i minus its reprojected history; w: what that looks like
 * (look_of). 0 where there is none, and where the view stands still upon it; `moved`: 0 where all
 * else stands still, too. One work-item a support sample. */
kernel void
measure_lag(global const FrameParams* restrict frame, global const WeierParams* restrict weier,
            global const float* restrict columns, global const float* restrict rows,
            global const float* restrict mesh_columns, global const float* restrict mesh_rows,
            global const float4* restrict vertices, global const uint* restrict keys,
            global const uint* restrict history_kept, global const float4* restrict past_colour,
            global const float4* restrict support_image,
            global const float4* restrict support_geometry, uint moved,
            global float4* restrict lag) {
    const uint index = (uint)get_global_id(0);
    const uint across = weier->support_width, row = index / across;
    if (row >= weier->support_height)
        return;
    const float x = columns[index % across], y = rows[row];
    const uint key = keys[(uint)y * weier->pitch + (uint)x];
    lag[index] = (float4)(0.0f);
    if (*history_kept == 0u || (key & 1u) != 0u)
        return;
    const MeshTables mesh = {vertices, mesh_columns, mesh_rows};
    const History h = find_history(&mesh, weier, key, x, y);
    const float apart = fabs(fma(support_geometry[index].w, h.inverse_depth, -1.0f));
    const Footing f = footing_at(
        clamp(h.at, (float2)(0.0f), (float2)((float)frame->width, (float)frame->height)));
    const bool still = moved == 0u && f.to_x == 0.0f && f.to_y == 0.0f;
    if (!h.found || apart > weier->merge_threshold || still)
        return;
    const float4 past = bilinear4(past_colour, frame->width, frame->height, &f);
    const float4 difference = support_image[index] - past;
    if (is_finite3(difference.xyz))
        lag[index] = (float4)(difference.xyz, look_of(past.y));
}

/* Less than this of either sign is none, and far from denormal. */
#define LEAST_LAG 0x1p-20f
/* What nobody would see, and would cost each pixel time. */
#define LEAST_CORRECTION 0x1p-10f
/* Of the eight neighbours, those that must show the same surface for a lag to be believed. */
#define LEAST_PEERS 3u

/* correction[i]: the mean lag of sample i and those of its eight neighbours that look alike, where
 * all of them agree on its sign, in each colour: what only some of them show is detail that the
 * history lost, or noise, and what only some colours show would tint it. w: as that of the lag. One
 * work-item a support sample. */
kernel void agree_on_lag(global const WeierParams* restrict weier,
                         global const float4* restrict lag, global float4* restrict correction) {
    const uint index = (uint)get_global_id(0);
    const uint across = weier->support_width, down = weier->support_height;
    if (index >= across * down)
        return;
    const int x = (int)(index % across), y = (int)(index / across);
    const float4 here = lag[index];
    const float4 least = (float4)(LEAST_LAG);
    int4 more = here > least, less = here < -least;
    float4 sum = here;
    uint peers = 0u;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            const float4 there = lag[texel_index(x + i, y + j, across, down)];
            if ((i == 0 && j == 0) || !(likeness(here.w, there.w) > 0.0f))
                continue;
            more &= there > least;
            less &= there < -least;
            sum += there;
            ++peers;
        }
    const float4 mean = sum * m_divide(1.0f, (float)(peers + 1u));
    const int4 agreed = more | less;
    const int4 seen = fabs(mean) > LEAST_CORRECTION;
    const bool all = here.w > 0.0f && peers >= LEAST_PEERS &&
                     (agreed.x & agreed.y & agreed.z) != 0 && (seen.x | seen.y | seen.z) != 0;
    correction[index] = (float4)(all ? mean.xyz : (float3)(0.0f), here.w);
}
