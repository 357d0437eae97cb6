#include "bench/embree_mask.hpp"

#include <numeric>

#include <embree3/rtcore.h>

namespace macula::bench {
shared::MaskTriangle masked_triangle(const frame::MaskBitmaps& masks, const scene::Mesh& mesh,
                                     std::uint32_t triangle) {
    shared::MaskTriangle result{};
    result.texture = masks.of_material[mesh.triangle_material[triangle]];
    for (int corner = 0; corner < 3 && !mesh.uvs.empty(); ++corner) {
        const glm::vec2 uv = mesh.uvs[mesh.triangles[triangle][corner]];
        result.uv[corner][0] = uv.x;
        result.uv[corner][1] = uv.y;
    }
    return result;
}

MaskFilter::MaskFilter(const frame::MaskBitmaps& masks, const scene::Mesh& mesh,
                       std::span<const std::uint32_t> triangles)
    : slots_(triangles.size()) {
    std::iota(slots_.begin(), slots_.end(), 0U);
    for (const std::uint32_t triangle : triangles)
        triangles_.push_back(masked_triangle(masks, mesh, triangle));
    tables_ = {slots_.data(), triangles_.data(), masks.textures.data(), masks.words.data()};
}

void filter_by_mask(const RTCFilterFunctionNArguments* arguments) {
    const auto& filter = *static_cast<const MaskFilter*>(arguments->geometryUserPtr);
    const unsigned n = arguments->N;
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] != 0 &&
            !filter.is_solid(RTCHitN_primID(arguments->hit, n, i), RTCHitN_u(arguments->hit, n, i),
                             RTCHitN_v(arguments->hit, n, i)))
            arguments->valid[i] = 0;
    }
}

} // namespace macula::bench
