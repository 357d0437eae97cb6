/* A pixel of the light buffer. MACULA_LIGHT: its components, 0 where the method has none, 1
 * (openness) or 4 (irradiance). */
#ifndef MACULA_CACHE_LIGHT_VALUE_H
#define MACULA_CACHE_LIGHT_VALUE_H

#include "shared/language.h"

#if MACULA_LIGHT == 4
typedef float4 LightValue;
static inline bool is_lit(LightValue v) {
    return v.x >= 0.0f && v.x < 1e30f && v.y >= 0.0f && v.y < 1e30f && v.z >= 0.0f && v.z < 1e30f;
}
#else
typedef float LightValue;
static inline bool is_lit(LightValue v) {
    return v >= 0.0f && v < 1e30f;
}
#endif
/* The light's strength. */
#if MACULA_LIGHT == 4
static inline float strength_of(LightValue v) {
    return fma(v.x, 0.2126f, fma(v.y, 0.7152f, v.z * 0.0722f));
}
#else
static inline float strength_of(LightValue v) {
    return v;
}
#endif

/* Of a pixel that has had no sample: no light is below 0. */
#define UNLIT ((LightValue)(-1.0f))

static inline LightValue kept_light(LightValue v) {
    return is_lit(v) ? v : UNLIT;
}

/* Four neighbours, and the same for each of them. */
#if MACULA_LIGHT == 4
typedef float16 LightRow;
#define STORE_LIGHTS(row, to) vstore16(row, 0, to)
static inline LightRow kept_lights(LightRow v) {
    int16 lit = (v >= 0.0f) & (v < 1e30f);
    lit.s37bf = (int4)(-1);
    lit &= lit.s1032547698badcfe;
    lit &= lit.s23016745ab89efcd;
    return lit ? v : (LightRow)(-1.0f);
}
#else
typedef float4 LightRow;
#define STORE_LIGHTS(row, to) vstore4(row, 0, to)
static inline LightRow kept_lights(LightRow v) {
    return ((v >= 0.0f) & (v < 1e30f)) ? v : (LightRow)(-1.0f);
}
#endif

#endif
