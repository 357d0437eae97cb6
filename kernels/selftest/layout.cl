/* Layout probe: writes, for every entry of the struct list in order, the struct's size or the
 * member's offset as this device's compiler lays it out. */
#include "selftest/struct_list.h"

#define WRITE_SIZE(type) out[i++] = (uint)sizeof(type);
#define WRITE_OFFSET(type, member)                                                                 \
    {                                                                                              \
        type probe;                                                                                \
        out[i++] = (uint)((private uchar*)&probe.member - (private uchar*)&probe);                 \
    }

kernel void layout(global uint* restrict out) {
    uint i = 0;
    MACULA_STRUCT_LIST(WRITE_SIZE, WRITE_OFFSET)
}
