/* Persistent threads: Aila and Laine 2009, section 5, with the work fetching of Aila, Laine and
 * Karras 2012. Just enough work-groups to fill the device stay resident; each takes the next batch
 * of neighbouring rays from a counter until none is left, so that no SIMD unit waits for the
 * slowest ray of a whole queue. A ray's result depends on the ray alone, and so not on who takes
 * it. The lower level is traversed as in while_while. */
#include "lib/traverse_while_while.h"

#include "lib/traverse_scene.h"

kernel void trace(TRACE_ARGUMENTS) {
    const TraceScene scene = MACULA_TRACE_SCENE;
    const uint count = *ray_count;
    const uint batch = (uint)get_local_size(0) * MACULA_RAYS_PER_FETCH;
    local uint first;
    for (;;) {
        if (get_local_id(0) == 0)
            first = atomic_add(work_counter, batch);
        barrier(CLK_LOCAL_MEM_FENCE);
        const uint begin = first;
        barrier(CLK_LOCAL_MEM_FENCE);
        if (begin >= count)
            return;
        const uint end = count - begin < batch ? count : begin + batch;
        for (uint i = begin + (uint)get_local_id(0); i < end; i += (uint)get_local_size(0))
            trace_ray(&scene, rays, i, results);
    }
}
