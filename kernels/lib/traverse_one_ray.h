/* The kernel of the variants that trace one ray a work-item; includes follow traverse_scene.h. */
#include "lib/traverse_scene.h"

kernel void trace(TRACE_ARGUMENTS) {
    const uint i = (uint)get_global_id(0);
    if (i >= *ray_count)
        return;
    const TraceScene scene = MACULA_TRACE_SCENE;
    trace_ray(&scene, rays, i, results);
}
