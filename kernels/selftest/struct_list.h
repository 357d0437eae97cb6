/* Every struct of kernels/shared with its members, as an X-macro: the layout probe expands it once
 * on the device and once on the host, and the two lists of sizes and offsets must be equal.
 * STRUCT(name) is followed by a MEMBER(name, member) for each member. */
#ifndef MACULA_SELFTEST_STRUCT_LIST_H
#define MACULA_SELFTEST_STRUCT_LIST_H

#include "shared/bvh.h"
#include "shared/camera.h"
#include "shared/lens.h"
#include "shared/log_polar.h"
#include "shared/mask.h"
#include "shared/ray.h"
#include "shared/rings.h"
#include "shared/rrm.h"
#include "shared/surface.h"
#include "shared/weier.h"

#define MACULA_STRUCT_LIST(STRUCT, MEMBER)                                                         \
    STRUCT(RayBlock)                                                                               \
    MEMBER(RayBlock, origin_x)                                                                     \
    MEMBER(RayBlock, origin_z)                                                                     \
    MEMBER(RayBlock, t_min)                                                                        \
    MEMBER(RayBlock, direction_x)                                                                  \
    MEMBER(RayBlock, t_max)                                                                        \
    STRUCT(HitBlock)                                                                               \
    MEMBER(HitBlock, t)                                                                            \
    MEMBER(HitBlock, u)                                                                            \
    MEMBER(HitBlock, v)                                                                            \
    MEMBER(HitBlock, triangle)                                                                     \
    STRUCT(Triangle)                                                                               \
    MEMBER(Triangle, v0)                                                                           \
    MEMBER(Triangle, id)                                                                           \
    MEMBER(Triangle, v1)                                                                           \
    MEMBER(Triangle, v2)                                                                           \
    STRUCT(TriangleBlock8)                                                                         \
    MEMBER(TriangleBlock8, v)                                                                      \
    MEMBER(TriangleBlock8, id)                                                                     \
    STRUCT(BinaryNode)                                                                             \
    MEMBER(BinaryNode, box)                                                                        \
    MEMBER(BinaryNode, child)                                                                      \
    STRUCT(Wide8Node)                                                                              \
    MEMBER(Wide8Node, plane)                                                                       \
    MEMBER(Wide8Node, child)                                                                       \
    STRUCT(SkipNode)                                                                               \
    MEMBER(SkipNode, lo)                                                                           \
    MEMBER(SkipNode, skip)                                                                         \
    MEMBER(SkipNode, hi)                                                                           \
    MEMBER(SkipNode, leaf)                                                                         \
    STRUCT(Quantized8Node)                                                                         \
    MEMBER(Quantized8Node, origin)                                                                 \
    MEMBER(Quantized8Node, exponent)                                                               \
    MEMBER(Quantized8Node, child)                                                                  \
    MEMBER(Quantized8Node, lo)                                                                     \
    MEMBER(Quantized8Node, hi)                                                                     \
    STRUCT(Instance)                                                                               \
    MEMBER(Instance, object_from_world)                                                            \
    MEMBER(Instance, world_from_object)                                                            \
    MEMBER(Instance, previous_world_from_object)                                                   \
    MEMBER(Instance, lo)                                                                           \
    MEMBER(Instance, first_triangle)                                                               \
    MEMBER(Instance, hi)                                                                           \
    MEMBER(Instance, mesh)                                                                         \
    MEMBER(Instance, root)                                                                         \
    MEMBER(Instance, mesh_triangle)                                                                \
    MEMBER(Instance, identity)                                                                     \
    STRUCT(MaskTexture)                                                                            \
    MEMBER(MaskTexture, first_word)                                                                \
    MEMBER(MaskTexture, wrap)                                                                      \
    STRUCT(MaskTriangle)                                                                           \
    MEMBER(MaskTriangle, uv)                                                                       \
    MEMBER(MaskTriangle, texture)                                                                  \
    STRUCT(Camera)                                                                                 \
    MEMBER(Camera, origin)                                                                         \
    MEMBER(Camera, tan_left)                                                                       \
    MEMBER(Camera, forward)                                                                        \
    MEMBER(Camera, tan_down)                                                                       \
    STRUCT(FrameParams)                                                                            \
    MEMBER(FrameParams, camera)                                                                    \
    MEMBER(FrameParams, previous_camera)                                                           \
    MEMBER(FrameParams, gaze)                                                                      \
    MEMBER(FrameParams, pixel_spread)                                                              \
    MEMBER(FrameParams, width)                                                                     \
    MEMBER(FrameParams, seed)                                                                      \
    MEMBER(FrameParams, gaze_widening)                                                             \
    MEMBER(FrameParams, lod_bias)                                                                  \
    MEMBER(FrameParams, ambient)                                                                   \
    MEMBER(FrameParams, jitter)                                                                    \
    STRUCT(SurfaceOptics)                                                                          \
    MEMBER(SurfaceOptics, index_of_refraction)                                                     \
    MEMBER(SurfaceOptics, transmission)                                                            \
    MEMBER(SurfaceOptics, opacity)                                                                 \
    MEMBER(SurfaceOptics, opacity_texture)                                                         \
    MEMBER(SurfaceOptics, diffuse_part)                                                            \
    STRUCT(WeierParams)                                                                            \
    MEMBER(WeierParams, p_min)                                                                     \
    MEMBER(WeierParams, support_width)                                                             \
    MEMBER(WeierParams, depth_bits)                                                                \
    MEMBER(WeierParams, first_frame_full)                                                          \
    STRUCT(InstanceMotion)                                                                         \
    MEMBER(InstanceMotion, motion)                                                                 \
    STRUCT(LensParams)                                                                             \
    MEMBER(LensParams, scale_x)                                                                    \
    MEMBER(LensParams, most)                                                                       \
    MEMBER(LensParams, k)                                                                          \
    STRUCT(LogPolarParams)                                                                         \
    MEMBER(LogPolarParams, alpha)                                                                  \
    MEMBER(LogPolarParams, pitch)                                                                  \
    MEMBER(LogPolarParams, thesis_lod)                                                             \
    STRUCT(Fovea)                                                                                  \
    MEMBER(Fovea, log_far)                                                                         \
    MEMBER(Fovea, first_column)                                                                    \
    STRUCT(RingParams)                                                                             \
    MEMBER(RingParams, blur)                                                                       \
    MEMBER(RingParams, grid)                                                                       \
    STRUCT(Rings)                                                                                  \
    MEMBER(Rings, top)                                                                             \
    MEMBER(Rings, bottom)                                                                          \
    STRUCT(RefreshRegion)                                                                          \
    MEMBER(RefreshRegion, period)                                                                  \
    STRUCT(RefreshPlan)                                                                            \
    MEMBER(RefreshPlan, group_blocks)                                                              \
    MEMBER(RefreshPlan, motion_squared)                                                            \
    MEMBER(RefreshPlan, region)

#endif
