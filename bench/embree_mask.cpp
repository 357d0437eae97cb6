#include "bench/embree_mask.hpp"

#include <numeric>

#include <embree3/rtcore.h>

namespace macula::bench {
namespace {

// Where a material's alpha lies; texture = kNoTexture when it has no mask.
struct AlphaChannel {
    std::uint32_t texture = scene::kNoTexture;
    std::uint32_t channel = 3;
};

AlphaChannel alpha_channel(const scene::Scene& scene, const scene::Material& material) {
    if (material.alpha_mode != scene::AlphaMode::mask)
        return {};
    if (material.alpha_texture != scene::kNoTexture)
        return {material.alpha_texture, 0};
    const std::uint32_t texture = material.diffuse_texture;
    const bool has_alpha = texture != scene::kNoTexture && scene.textures[texture].has_alpha;
    return {has_alpha ? texture : scene::kNoTexture, 3};
}

shared::uint wrap_code(scene::Wrap wrap) {
    switch (wrap) {
    case scene::Wrap::clamp:
        return MACULA_WRAP_CLAMP;
    case scene::Wrap::mirror:
        return MACULA_WRAP_MIRROR;
    case scene::Wrap::repeat:
        break;
    }
    return MACULA_WRAP_REPEAT;
}

void append_bits(std::vector<shared::uint>& words, const scene::MipLevel& level,
                 std::uint32_t channel, float cutoff) {
    for (std::uint32_t y = 0; y < level.height; ++y) {
        const std::size_t row = words.size();
        words.resize(row + (level.width + 31) / 32);
        for (std::uint32_t x = 0; x < level.width; ++x) {
            const std::size_t texel = std::size_t{y} * level.width + x;
            if (static_cast<float>(level.rgba[4 * texel + channel]) / 255.0f >= cutoff)
                words[row + x / 32] |= 1U << (x % 32);
        }
    }
}

} // namespace

AlphaMasks::AlphaMasks(const scene::Scene& scene) : of_material(scene.materials.size(), kNone) {
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const AlphaChannel alpha = alpha_channel(scene, scene.materials[m]);
        if (alpha.texture == scene::kNoTexture)
            continue;
        const scene::Texture& texture = scene.textures[alpha.texture];
        const scene::MipLevel& level = texture.levels.front();
        of_material[m] = static_cast<std::uint32_t>(textures.size());
        textures.push_back({static_cast<shared::uint>(words.size()), level.width, level.height,
                            wrap_code(texture.wrap_u) | (wrap_code(texture.wrap_v) << 2)});
        append_bits(words, level, alpha.channel, scene.materials[m].alpha_cutoff);
    }
}

shared::MaskTriangle masked_triangle(const AlphaMasks& masks, const scene::Mesh& mesh,
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

MaskFilter::MaskFilter(const AlphaMasks& masks, const scene::Mesh& mesh,
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
