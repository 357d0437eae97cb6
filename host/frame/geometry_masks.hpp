// Alpha masks as the kernels test them (shared/mask.h): thresholded once, one bit a texel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/frame/geometry.hpp"
#include "scenes/scene.hpp"
#include "shared/mask.h"

namespace macula::frame {

inline constexpr std::uint32_t kNoMask = 0xffffffffu;

struct MaskBitmaps {
    std::vector<shared::MaskTexture> textures;
    std::vector<std::uint32_t> words;
    std::vector<std::uint32_t> of_material; // index into textures, or kNoMask

    std::vector<std::uint8_t> masked_materials() const; // one a material, 1: masked
};

// A material has a mask when its alpha mode is `mask` (solid where alpha >= alpha_cutoff) or
// `blend` (solid where alpha >= 0.5), it has an alpha texture or a diffuse texture with alpha, and
// some texel of it is not solid. Throws std::invalid_argument for a texture index out of range, a
// level whose texels are missing, or more than 2^32 - 1 words of masks.
MaskBitmaps make_mask_bitmaps(const scene::Scene& scene);

struct MaskTriangles {
    std::vector<std::uint32_t> slots; // by entry of the per-mesh tables; read for masked ones only
    std::vector<shared::MaskTriangle> triangles;
};

MaskTriangles make_mask_triangles(const scene::Scene& scene, std::span<const MeshPart> parts,
                                  const MaskBitmaps& bitmaps);

} // namespace macula::frame
