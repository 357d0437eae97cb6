/* Trilinear texture filtering by hand from one buffer of RGBA8 texels: samplers of devices differ
 * in their last bits, this does not. */
#ifndef MACULA_LIB_TEXTURE_H
#define MACULA_LIB_TEXTURE_H

#include "lib/lanes.h"
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
MACULA_ALWAYS_INLINE Real wrapped_coordinate(Real x, Uint wrap) {
    const Real in_period = fma(splat(-2.0f), floor(0.5f * x), x);
    const Real mirrored = in_period > splat(1.0f) ? 2.0f - in_period : in_period;
    const Real repeated = x - floor(x);
    const Real kept = clamped(x, splat(0.0f), splat(1.0f));
    return wrap == MACULA_WRAP_CLAMP ? kept : (wrap == MACULA_WRAP_REPEAT ? repeated : mirrored);
}

/* Index of a texel one step outside [0, size): repeat comes back at the other end; the mirrored
 * neighbour of an edge texel is that texel itself, as with clamp. */
MACULA_ALWAYS_INLINE Uint wrapped_texel(Int i, Uint size, Uint wrap) {
    const Uint last = size - 1u;
    const Mask repeats = wrap == MACULA_WRAP_REPEAT;
    const Uint before = repeats ? last : splat_uint(0u);
    const Uint behind = repeats ? splat_uint(0u) : last;
    const Uint at = int_to_uint(i);
    return i < 0 ? before : (at > last ? behind : at);
}

MACULA_ALWAYS_INLINE Real3 decoded_texel(const TextureTables* tables, Uint texel, Uint decode) {
    const Uint red = decode + (texel & 255u), green = decode + ((texel >> 8) & 255u);
    const Uint blue = decode + ((texel >> 16) & 255u);
    return make3(MACULA_GATHER(float, tables->decode, red, ),
                 MACULA_GATHER(float, tables->decode, green, ),
                 MACULA_GATHER(float, tables->decode, blue, ));
}

/* Of the texture that a lane samples. */
typedef struct TextureAt {
    Uint first_level, last_level;
    Uint wrap_u, wrap_v;
    Uint decode;
    Real log2_size;
    Real u, v; /* wrapped */
} TextureAt;

/* Bilinear in one level. Texel (i, j) is centred at (i + 0.5, j + 0.5). */
MACULA_ALWAYS_INLINE Real3 bilinear(const TextureTables* tables, const TextureAt* t, Uint level) {
    const Uint index = t->first_level + level;
    const Uint width = MACULA_GATHER(uint, tables->levels, index, .width);
    const Uint height = MACULA_GATHER(uint, tables->levels, index, .height);
    const Uint first = MACULA_GATHER(uint, tables->levels, index, .first_texel);
    const Real x = fma(t->u, uint_to_real(width), splat(-0.5f));
    const Real y = fma(t->v, uint_to_real(height), splat(-0.5f));
    const Real x_floor = floor(x), y_floor = floor(y);
    const Int i = to_int(x_floor), j = to_int(y_floor);
    const Uint x0 = wrapped_texel(i, width, t->wrap_u);
    const Uint x1 = wrapped_texel(i + 1, width, t->wrap_u);
    const Uint row0 = first + wrapped_texel(j, height, t->wrap_v) * width;
    const Uint row1 = first + wrapped_texel(j + 1, height, t->wrap_v) * width;
    const Uint a = MACULA_GATHER(uint, tables->texels, row0 + x0, );
    const Uint b = MACULA_GATHER(uint, tables->texels, row0 + x1, );
    const Uint c = MACULA_GATHER(uint, tables->texels, row1 + x0, );
    const Uint d = MACULA_GATHER(uint, tables->texels, row1 + x1, );
    const Real3 above = lerp3(decoded_texel(tables, a, t->decode),
                              decoded_texel(tables, b, t->decode), x - x_floor);
    const Real3 below = lerp3(decoded_texel(tables, c, t->decode),
                              decoded_texel(tables, d, t->decode), x - x_floor);
    return lerp3(above, below, y - y_floor);
}

MACULA_ALWAYS_INLINE TextureAt texture_at(const TextureTables* tables, Uint index, Real u, Real v) {
    const Uint wrap = MACULA_GATHER(uint, tables->textures, index, .wrap);
    TextureAt t;
    t.first_level = MACULA_GATHER(uint, tables->textures, index, .first_level);
    t.last_level = MACULA_GATHER(uint, tables->textures, index, .level_count) - 1u;
    t.wrap_u = wrap & 3u;
    t.wrap_v = (wrap >> 2) & 3u;
    t.decode = MACULA_GATHER(uint, tables->textures, index, .decode);
    t.log2_size = MACULA_GATHER(float, tables->textures, index, .log2_size);
    t.u = wrapped_coordinate(u, t.wrap_u);
    t.v = wrapped_coordinate(v, t.wrap_v);
    return t;
}

/* The image's RGB at (u, v). `lod` is log2 of the footprint in units of the whole image, so that
 * adding log2_size gives the level. */
MACULA_ALWAYS_INLINE Real3 sample_texture(const TextureTables* tables, Uint index, Real u, Real v,
                                          Real lod) {
    const TextureAt t = texture_at(tables, index, u, v);
    const Real level = clamped(lod + t.log2_size, splat(0.0f), uint_to_real(t.last_level));
    const Real fine = floor(level), blend = level - fine;
    const Uint finer = to_uint(fine);
    const Real3 first = bilinear(tables, &t, finer);
    if (!any_lane(blend > splat(0.0f)))
        return first;
    const Uint coarser = finer < t.last_level ? finer + 1u : finer;
    return lerp3(first, bilinear(tables, &t, coarser), blend);
}

/* One channel as it is stored, 0..1; `shift`: its first bit in a texel. Bilinear in the nearest
 * level: for the shapes of alpha. */
MACULA_ALWAYS_INLINE Real sample_channel(const TextureTables* tables, Uint index, uint shift,
                                         Real u, Real v, Real lod) {
    const TextureAt t = texture_at(tables, index, u, v);
    const Real level = clamped(lod + t.log2_size, splat(0.0f), uint_to_real(t.last_level));
    const Uint at = t.first_level + to_uint(level + 0.5f);
    const Uint width = MACULA_GATHER(uint, tables->levels, at, .width);
    const Uint height = MACULA_GATHER(uint, tables->levels, at, .height);
    const Uint first = MACULA_GATHER(uint, tables->levels, at, .first_texel);
    const Real x = fma(t.u, uint_to_real(width), splat(-0.5f));
    const Real y = fma(t.v, uint_to_real(height), splat(-0.5f));
    const Real x_floor = floor(x), y_floor = floor(y);
    const Int i = to_int(x_floor), j = to_int(y_floor);
    const Uint x0 = wrapped_texel(i, width, t.wrap_u), x1 = wrapped_texel(i + 1, width, t.wrap_u);
    const Uint row0 = first + wrapped_texel(j, height, t.wrap_v) * width;
    const Uint row1 = first + wrapped_texel(j + 1, height, t.wrap_v) * width;
    const Real a = uint_to_real((MACULA_GATHER(uint, tables->texels, row0 + x0, ) >> shift) & 255u);
    const Real b = uint_to_real((MACULA_GATHER(uint, tables->texels, row0 + x1, ) >> shift) & 255u);
    const Real c = uint_to_real((MACULA_GATHER(uint, tables->texels, row1 + x0, ) >> shift) & 255u);
    const Real d = uint_to_real((MACULA_GATHER(uint, tables->texels, row1 + x1, ) >> shift) & 255u);
    const Real above = fma(b - a, x - x_floor, a), below = fma(d - c, x - x_floor, c);
    return fma(below - above, y - y_floor, above) * m_divide(1.0f, 255.0f);
}

MACULA_SHARED_END
#endif
