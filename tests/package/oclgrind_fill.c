/* Oclgrind 21.10 does not count memory filled by clEnqueueFillBuffer as initialised, so that its
 * check for uninitialised reads raises false alarms. Preloaded before it, this turns a fill into a
 * write of the same bytes. */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <stdlib.h>
#include <string.h>

CL_API_ENTRY cl_int CL_API_CALL clEnqueueFillBuffer(cl_command_queue queue, cl_mem buffer,
                                                    const void* pattern, size_t pattern_size,
                                                    size_t offset, size_t size, cl_uint wait_count,
                                                    const cl_event* wait_list, cl_event* event) {
    char* bytes = malloc(size);
    if (bytes == NULL)
        return CL_OUT_OF_HOST_MEMORY;
    for (size_t i = 0; i < size; i += pattern_size)
        memcpy(bytes + i, pattern, pattern_size);
    const cl_int status = clEnqueueWriteBuffer(queue, buffer, CL_TRUE, offset, size, bytes,
                                               wait_count, wait_list, event);
    free(bytes);
    return status;
}
