#include "bench/embree_mask.hpp"

#include <algorithm>
#include <cmath>

#include <embree3/rtcore.h>

namespace macula::bench {
namespace {

// The texture and channel of a material's alpha; kNoTexture when there is none.
struct AlphaChannel {
    std::uint32_t texture = scene::kNoTexture;
    std::uint32_t channel = 3;
};

AlphaChannel alpha_channel(const scene::Material& material) {
    if (material.alpha_texture != scene::kNoTexture)
        return {material.alpha_texture, 0};
    return {material.diffuse_texture, 3};
}

} // namespace

float AlphaMask::texel(float coordinate, std::uint32_t size, scene::Wrap wrap) {
    const auto n = static_cast<float>(size);
    float fraction = std::clamp(coordinate, 0.0f, 1.0f);
    if (wrap == scene::Wrap::repeat)
        fraction = coordinate - std::floor(coordinate);
    if (wrap == scene::Wrap::mirror) {
        const float half = coordinate * 0.5f;
        const float folded = 2.0f * (half - std::floor(half));
        fraction = folded > 1.0f ? 2.0f - folded : folded;
    }
    return fraction * n;
}

bool AlphaMask::is_solid(float u, float v) const {
    const auto x = std::min(static_cast<std::uint32_t>(texel(u, width, wrap_u)), width - 1);
    const auto y = std::min(static_cast<std::uint32_t>(texel(v, height, wrap_v)), height - 1);
    return solid[std::size_t{y} * width + x] != 0;
}

bool is_masked(const scene::Scene& scene, const scene::Material& material) {
    if (material.alpha_mode != scene::AlphaMode::mask)
        return false;
    const AlphaChannel alpha = alpha_channel(material);
    if (alpha.texture == scene::kNoTexture)
        return false;
    return alpha.channel == 0 || scene.textures[alpha.texture].has_alpha;
}

AlphaMask make_mask(const scene::Scene& scene, const scene::Material& material) {
    const AlphaChannel alpha = alpha_channel(material);
    const scene::Texture& texture = scene.textures[alpha.texture];
    const scene::MipLevel& level = texture.levels.front();
    AlphaMask mask;
    mask.width = level.width;
    mask.height = level.height;
    mask.wrap_u = texture.wrap_u;
    mask.wrap_v = texture.wrap_v;
    mask.solid.resize(std::size_t{level.width} * level.height);
    for (std::size_t i = 0; i < mask.solid.size(); ++i) {
        const float value = static_cast<float>(level.rgba[4 * i + alpha.channel]) / 255.0f;
        mask.solid[i] = value >= material.alpha_cutoff ? 1 : 0;
    }
    return mask;
}

void filter_by_mask(const RTCFilterFunctionNArguments* arguments) {
    const auto& triangles = *static_cast<const MaskedTriangles*>(arguments->geometryUserPtr);
    const unsigned n = arguments->N;
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] == 0)
            continue;
        const auto& entry = triangles.entries[RTCHitN_primID(arguments->hit, n, i)];
        const float b = RTCHitN_u(arguments->hit, n, i), c = RTCHitN_v(arguments->hit, n, i);
        const float a = 1.0f - b - c;
        const float u = a * entry.uv[0][0] + b * entry.uv[1][0] + c * entry.uv[2][0];
        const float v = a * entry.uv[0][1] + b * entry.uv[1][1] + c * entry.uv[2][1];
        if (!(*triangles.masks)[entry.mask].is_solid(u, v))
            arguments->valid[i] = 0;
    }
}

} // namespace macula::bench
