/* The alpha-mask test inside the traversal loop (Weier et al. 2016, section 3.1): one texel, one
 * bit, one word. A triangle with MACULA_MASKED_BIT is hit only where its texel is solid; the test
 * comes before a candidate may win, so the winner is the least (t, id) among the solid hits. */
#ifndef MACULA_LIB_MASK_H
#define MACULA_LIB_MASK_H

#include "shared/mask.h"

MACULA_SHARED_BEGIN

/* The four buffers of a masks' lookup; slots[mesh_triangle + id] indexes `triangles`. */
typedef struct MaskTables {
    MACULA_GLOBAL const uint* slots;
    MACULA_GLOBAL const MaskTriangle* triangles;
    MACULA_GLOBAL const MaskTexture* textures;
    MACULA_GLOBAL const uint* words;
} MaskTables;

/* Texture coordinates further out than this, and NaN, are taken for 0: beyond, a float holds no
 * texel's fraction any more. */
#define MACULA_MASK_UV_LIMIT 0x1p20f

/* The texel that coordinate x falls into along an axis of `size` texels (nearest filtering). */
MACULA_INLINE uint mask_texel(float x, uint size, uint wrap) {
    x = fabs(x) < MACULA_MASK_UV_LIMIT ? x : 0.0f;
    if (wrap == MACULA_WRAP_REPEAT) {
        x = x - floor(x);
    } else if (wrap == MACULA_WRAP_MIRROR) {
        x = fma(-2.0f, floor(x * 0.5f), x);
        x = x > 1.0f ? 2.0f - x : x;
    }
    x = x > 0.0f ? (x < 1.0f ? x : 1.0f) : 0.0f;
    const uint texel = (uint)(x * (float)size);
    return texel < size ? texel : size - 1u;
}

/* True when the texel at the barycentric weights (u, v) of a masked triangle is solid. `slot` is
 * Instance.mesh_triangle + the triangle's id within its mesh. */
MACULA_INLINE bool mask_is_solid(const MaskTables* tables, uint slot, float u, float v) {
    MACULA_GLOBAL const MaskTriangle* triangle = tables->triangles + tables->slots[slot];
    MACULA_GLOBAL const MaskTexture* texture = tables->textures + triangle->texture;
    const float w = (1.0f - u) - v;
    const float x = fma(w, triangle->uv[0][0], fma(u, triangle->uv[1][0], v * triangle->uv[2][0]));
    const float y = fma(w, triangle->uv[0][1], fma(u, triangle->uv[1][1], v * triangle->uv[2][1]));
    const uint column = mask_texel(x, texture->width, texture->wrap & 3u);
    const uint row = mask_texel(y, texture->height, (texture->wrap >> 2) & 3u);
    const uint words_in_row = (texture->width + 31u) >> 5;
    const uint word = tables->words[texture->first_word + row * words_in_row + (column >> 5)];
    return ((word >> (column & 31u)) & 1u) != 0u;
}

MACULA_SHARED_END
#endif
