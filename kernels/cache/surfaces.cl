/* What each pixel shows, for what gathers frames: the samples' own surfaces are placed by
 * upscale/surfaces.cl; here are those of the histories, from the mesh. */
#include "lib/camera.h"
#include "lib/reprojection_packet.h"
#include "shared/planes.h"

/* One work-item a packet of 4 x 4 pixels. planes: depth and motion of the reprojected mesh, the
 * background without motion where there is none; no normal is known. fresh: 1 where a pixel is this
 * frame's sample, which has the frame's jitter, 0 where it is a mean of many; may be null. */
kernel void place_mesh_surfaces(global const FrameParams* restrict frame,
                                global const WeierParams* restrict weier,
                                global const float* restrict mesh_columns,
                                global const float* restrict mesh_rows,
                                global const float* restrict cells,
                                global const uint* restrict keys,
                                global const uint* restrict history_kept,
                                global const uint* restrict masks, global float* restrict planes,
                                global float* restrict fresh) {
    const uint packet = (uint)get_global_id(0);
    const uint width = frame->width, height = frame->height, pixels = width * height;
    uint x0, y0;
    pixel_of_slot(packet * 16u, width, &x0, &y0);
    if (x0 >= width || y0 >= height)
        return;
    global const uint* row = keys + y0 * weier->pitch + x0;
    const uint pitch = weier->pitch;
    const uint16 key = (uint16)(vload4(0, row), vload4(0, row + pitch), vload4(0, row + 2u * pitch),
                                vload4(0, row + 3u * pitch));
    const uint known = *history_kept != 0u ? bits_of_lanes16(key != MACULA_NO_KEY) : 0u;
    const float16 x = (float)x0 + (convert_float16(MACULA_LANES16 & 3) + 0.5f);
    const float16 y = (float)y0 + (convert_float16(MACULA_LANES16 >> 2) + 0.5f);
    const CellTables mesh = {cells, mesh_columns, mesh_rows};
    HistoryPacket history;
    find_histories(&mesh, weier, key, known, x, y, &history);
    const int16 found = lanes_of(known) & (history.inverse_depth > 1e-30f);
    const float16 inverse = found ? history.inverse_depth : (float16)(1.0f);
    const float16 none = (float16)(MACULA_NO_MOTION);
    float depth[16], motion_x[16], motion_y[16];
    vstore16(found ? m_divide((float16)(1.0f), inverse) : (float16)(MACULA_BACKGROUND_DEPTH), 0,
             depth);
    vstore16(found ? history.x - x : none, 0, motion_x);
    vstore16(found ? history.y - y : none, 0, motion_y);
    for (uint lane = 0u; lane < 16u; ++lane) {
        const uint column = x0 + (lane & 3u), line = y0 + (lane >> 2);
        const uint pixel = line * width + column;
        if (column >= width || line >= height)
            continue;
        planes[MACULA_PLANE_DEPTH * pixels + pixel] = depth[lane];
        planes[MACULA_PLANE_MOTION_X * pixels + pixel] = motion_x[lane];
        planes[MACULA_PLANE_MOTION_Y * pixels + pixel] = motion_y[lane];
        planes[MACULA_PLANE_NORMAL * pixels + pixel] = 0.0f;
        if (fresh)
            fresh[pixel] = (masks[packet] >> (lane + 16u) & 1u) != 0u ? 1.0f : 0.0f;
    }
}
