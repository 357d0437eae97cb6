// Alpha masks inside Embree's traversal: the bitmaps and the test of the
// engine, so that both sides let the same rays through.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/frame/geometry_masks.hpp"
#include "lib/mask.h"
#include "scenes/scene.hpp"

struct RTCFilterFunctionNArguments;

namespace macula::bench {

// Texture coordinates and mask of a triangle whose material has a mask.
shared::MaskTriangle masked_triangle(const frame::MaskBitmaps& masks, const scene::Mesh& mesh,
                                     std::uint32_t triangle);

// The masked triangles of a mesh, by Embree's primitive id: the user data of filter_by_mask.
class MaskFilter {
  public:
    MaskFilter(const frame::MaskBitmaps& masks, const scene::Mesh& mesh,
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
