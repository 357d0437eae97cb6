// Alpha masks inside Embree's traversal: the test of kernels/lib/mask.h on tables made here.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/mask.h"
#include "scenes/scene.hpp"

struct RTCFilterFunctionNArguments;

namespace macula::bench {

// The thresholded masks of a scene's materials.
struct AlphaMasks {
    static constexpr std::uint32_t kNone = 0xffffffffu;

    explicit AlphaMasks(const scene::Scene& scene);

    std::vector<shared::MaskTexture> textures;
    std::vector<shared::uint> words;
    std::vector<std::uint32_t> of_material; // index into `textures`, or kNone
};

// Texture coordinates and mask of a triangle whose material has a mask.
shared::MaskTriangle masked_triangle(const AlphaMasks& masks, const scene::Mesh& mesh,
                                     std::uint32_t triangle);

// The masked triangles of a mesh, by Embree's primitive id: the user data of filter_by_mask.
class MaskFilter {
  public:
    MaskFilter(const AlphaMasks& masks, const scene::Mesh& mesh,
               std::span<const std::uint32_t> triangles);
    MaskFilter(const MaskFilter&) = delete;
    MaskFilter& operator=(const MaskFilter&) = delete;

    bool is_solid(std::uint32_t primitive, float u, float v) const {
        return shared::mask_is_solid(&tables_, primitive, u, v);
    }

  private:
    std::vector<shared::uint> slots_;
    std::vector<shared::MaskTriangle> triangles_;
    shared::MaskTables tables_;
};

// An RTCFilterFunctionN; the geometry's user pointer is a MaskFilter.
void filter_by_mask(const RTCFilterFunctionNArguments* arguments);

} // namespace macula::bench
