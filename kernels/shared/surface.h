/* What shading reads of the scene: triangle attributes, materials, images. */
#ifndef MACULA_SHARED_SURFACE_H
#define MACULA_SHARED_SURFACE_H

#include "shared/language.h"

MACULA_SHARED_BEGIN

#define MACULA_NO_TEXTURE 0xffffffffu
/* Depth of a ray that missed, and the motion of what the last frame could not see. */
#define MACULA_BACKGROUND_DEPTH 1e30f
#define MACULA_NO_MOTION 1e6f

/* Indices into the vertex table and the material table. Entry Instance.mesh_triangle + k of the
 * triangle table belongs to triangle k of the instance's mesh. */
typedef struct SurfaceTriangle {
    uint vertex[3];
    uint material;
} SurfaceTriangle;
MACULA_ASSERT_SIZE(SurfaceTriangle, 16);

/* In the space of the mesh. A zero normal: the triangle's own is used. */
typedef struct SurfaceVertex {
    float position[3];
    float normal[3];
    float uv[2];
} SurfaceVertex;
MACULA_ASSERT_SIZE(SurfaceVertex, 32);

/* Colours in linear RGB; a texture multiplies its colour. */
typedef struct SurfaceMaterial {
    float diffuse[3];
    uint diffuse_texture;
    float specular[3];
    uint specular_texture;
    float emission[3];
    uint emission_texture;
    float shininess;
    uint normal_texture;
    uint pad[2];
} SurfaceMaterial;
MACULA_ASSERT_SIZE(SurfaceMaterial, 64);

#define MACULA_ALPHA_CHANNEL 0x80000000u

/* What a material does besides Phong shading (lib/optics.h). One a material. */
typedef struct SurfaceOptics {
    float reflectivity[3]; /* weight of a mirrored ray at all angles */
    float index_of_refraction;
    float transmission[3]; /* weight that Fresnel's equations split into two rays */
    float opacity;         /* of blended materials, without their texture */
    /* Factor on the diffuse colour: where colour, reflectivity and transmission sum to more than
     * one, less is left to be diffuse. */
    float diffuse_part[3];
    /* Texture that opacity is multiplied by, or MACULA_NO_TEXTURE: its red channel, or with
     * MACULA_ALPHA_CHANNEL added its alpha. */
    uint opacity_texture;
} SurfaceOptics;
MACULA_ASSERT_SIZE(SurfaceOptics, 48);

/* An image with its mip chain: levels first_level .. first_level + level_count - 1 of the level
 * table, finest first. wrap: u in bits 0..1, v in bits 2..3 (MACULA_WRAP_* of shared/mask.h).
 * decode: first entry of the decoding table, 0 for linear and 256 for sRGB bytes. */
typedef struct ImageTexture {
    uint first_level, level_count;
    uint wrap;
    uint decode;
    float log2_size; /* log2(width * height) / 2 of the finest level */
    uint pad[3];
} ImageTexture;
MACULA_ASSERT_SIZE(ImageTexture, 32);

/* width * height texels from first_texel on, rows from v = 0; a texel is R | G << 8 | B << 16 |
 * A << 24. */
typedef struct ImageLevel {
    uint first_texel;
    uint width, height;
    uint pad;
} ImageLevel;
MACULA_ASSERT_SIZE(ImageLevel, 16);

MACULA_SHARED_END
#endif
