/* Trilinear texture filtering by hand from one buffer of RGBA8 texels: samplers of devices differ
 * in their last bits, this does not. */
#ifndef MACULA_LIB_TEXTURE_H
#define MACULA_LIB_TEXTURE_H

#include "lib/vector.h"
#include "shared/mask.h"
#include "shared/surface.h"

MACULA_SHARED_BEGIN

typedef struct TextureTables {
    MACULA_GLOBAL const ImageTexture* textures;
    MACULA_GLOBAL const ImageLevel* levels;
    MACULA_GLOBAL const uint* texels;
    MACULA_GLOBAL const float* decode; /* 512: byte / 255, then sRGB byte to linear */
} TextureTables;

/* The coordinate brought into [0, 1] as the wrap mode says. */
MACULA_ALWAYS_INLINE float wrapped_coordinate(float x, uint wrap) {
    if (wrap == MACULA_WRAP_CLAMP)
        return clamped(x, 0.0f, 1.0f);
    if (wrap == MACULA_WRAP_REPEAT)
        return x - floor(x);
    const float in_period = fma(-2.0f, floor(0.5f * x), x);
    return in_period > 1.0f ? 2.0f - in_period : in_period;
}

/* Index of a texel one step outside [0, size): repeat comes back at the other end; the mirrored
 * neighbour of an edge texel is that texel itself, as with clamp. */
MACULA_ALWAYS_INLINE uint wrapped_texel(int i, uint size, uint wrap) {
    const int last = (int)size - 1;
    if (i < 0)
        return wrap == MACULA_WRAP_REPEAT ? (uint)last : 0u;
    if (i > last)
        return wrap == MACULA_WRAP_REPEAT ? 0u : (uint)last;
    return (uint)i;
}

MACULA_ALWAYS_INLINE float3 decoded_texel(const TextureTables* tables, uint texel, uint decode) {
    return make3(tables->decode[decode + (texel & 255u)],
                 tables->decode[decode + ((texel >> 8) & 255u)],
                 tables->decode[decode + ((texel >> 16) & 255u)]);
}

/* Bilinear in one level; (u, v) already wrapped. Texel (i, j) is centred at (i + 0.5, j + 0.5). */
MACULA_ALWAYS_INLINE float3 bilinear(const TextureTables* tables, const ImageTexture* texture,
                                     uint level, float u, float v) {
    const ImageLevel l = tables->levels[texture->first_level + level];
    const uint wrap_u = texture->wrap & 3u, wrap_v = (texture->wrap >> 2) & 3u;
    const float x = fma(u, (float)l.width, -0.5f), y = fma(v, (float)l.height, -0.5f);
    const float x_floor = floor(x), y_floor = floor(y);
    const float fx = x - x_floor, fy = y - y_floor;
    const uint x0 = wrapped_texel((int)x_floor, l.width, wrap_u);
    const uint x1 = wrapped_texel((int)x_floor + 1, l.width, wrap_u);
    const uint row0 = l.first_texel + wrapped_texel((int)y_floor, l.height, wrap_v) * l.width;
    const uint row1 = l.first_texel + wrapped_texel((int)y_floor + 1, l.height, wrap_v) * l.width;
    const uint decode = texture->decode;
    const float3 above = lerp3(decoded_texel(tables, tables->texels[row0 + x0], decode),
                               decoded_texel(tables, tables->texels[row0 + x1], decode), fx);
    const float3 below = lerp3(decoded_texel(tables, tables->texels[row1 + x0], decode),
                               decoded_texel(tables, tables->texels[row1 + x1], decode), fx);
    return lerp3(above, below, fy);
}

/* The image's RGB at (u, v). `lod` is log2 of the footprint in units of the whole image, so that
 * adding log2_size gives the level. */
MACULA_ALWAYS_INLINE float3 sample_texture(const TextureTables* tables, uint index, float u,
                                           float v, float lod) {
    const ImageTexture texture = tables->textures[index];
    const float coarsest = (float)(texture.level_count - 1u);
    const float level = clamped(lod + texture.log2_size, 0.0f, coarsest);
    const float fine = floor(level), blend = level - fine;
    const float wu = wrapped_coordinate(u, texture.wrap & 3u);
    const float wv = wrapped_coordinate(v, (texture.wrap >> 2) & 3u);
    const float3 first = bilinear(tables, &texture, (uint)fine, wu, wv);
    if (blend == 0.0f)
        return first;
    return lerp3(first, bilinear(tables, &texture, (uint)fine + 1u, wu, wv), blend);
}

MACULA_SHARED_END
#endif
