/* Alpha masks, tested inside the traversal loop (Weier et al. 2016, section 3.1). The mask of a
 * material is thresholded when the scene is loaded and kept as one bit a texel, so that a test
 * costs one address and one word. Nearest texel of the finest level: the visible surface must not
 * depend on ray cones, or shadow and primary rays would disagree. */
#ifndef MACULA_SHARED_MASK_H
#define MACULA_SHARED_MASK_H

#include "shared/language.h"

MACULA_SHARED_BEGIN

#define MACULA_WRAP_REPEAT 0u
#define MACULA_WRAP_CLAMP 1u
#define MACULA_WRAP_MIRROR 2u

/* width x height bits, row-major from the row v = 0, starting at bit 0 of word `first_word`;
 * every row starts at a new word. A set bit is solid. wrap: u in bits 0..1, v in bits 2..3. */
typedef struct MaskTexture {
    uint first_word;
    uint width, height;
    uint wrap;
} MaskTexture;
MACULA_ASSERT_SIZE(MaskTexture, 16);

/* Texture coordinates of a masked triangle's vertices and its mask. */
typedef struct MaskTriangle {
    float uv[3][2];
    uint texture;
    uint pad;
} MaskTriangle;
MACULA_ASSERT_SIZE(MaskTriangle, 32);

MACULA_SHARED_END
#endif
