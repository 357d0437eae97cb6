// Alpha masks inside Embree's traversal: nearest texel of the finest level, as kernels/lib/mask.h.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/scene.hpp"

struct RTCFilterFunctionNArguments;

namespace macula::bench {

// A material's mask, thresholded: solid[y * width + x], row 0 at v = 0.
struct AlphaMask {
    std::uint32_t width = 0, height = 0;
    scene::Wrap wrap_u = scene::Wrap::repeat, wrap_v = scene::Wrap::repeat;
    std::vector<std::uint8_t> solid;

    // Coordinate in texels of u (or v) after wrapping: in [0, size].
    static float texel(float coordinate, std::uint32_t size, scene::Wrap wrap);
    bool is_solid(float u, float v) const;
};

// Whether hits on the material's triangles depend on a texel.
bool is_masked(const scene::Scene& scene, const scene::Material& material);
// The mask of a material for which is_masked() holds.
AlphaMask make_mask(const scene::Scene& scene, const scene::Material& material);

// The masked triangles of a mesh as one Embree geometry: what the filter needs of each.
struct MaskedTriangles {
    struct Entry {
        float uv[3][2];
        std::uint32_t mask; // index into `masks`
    };
    std::vector<Entry> entries; // by Embree's primitive id
    const std::vector<AlphaMask>* masks = nullptr;
};

// An RTCFilterFunctionN; the geometry's user pointer is a MaskedTriangles.
void filter_by_mask(const RTCFilterFunctionNArguments* arguments);

} // namespace macula::bench
