#include "host/frame/geometry_masks.hpp"

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>

namespace macula::frame {
namespace {

struct MaskSource {
    std::uint32_t texture = 0;
    std::uint32_t channel = 0; // byte of a texel
    float cutoff = 0.5f;
    bool operator<(const MaskSource& other) const {
        return std::tie(texture, channel, cutoff) <
               std::tie(other.texture, other.channel, other.cutoff);
    }
};

const scene::Texture& texture_of(const scene::Scene& scene, std::uint32_t index,
                                 const scene::Material& material) {
    if (index >= scene.textures.size())
        throw std::invalid_argument("alpha mask of material \"" + material.name + "\": texture " +
                                    std::to_string(index) + " of " +
                                    std::to_string(scene.textures.size()));
    return scene.textures[index];
}

std::optional<MaskSource> source_of(const scene::Scene& scene, const scene::Material& material) {
    if (material.alpha_mode == scene::AlphaMode::opaque)
        return std::nullopt;
    const float cutoff =
        material.alpha_mode == scene::AlphaMode::mask ? material.alpha_cutoff : 0.5f;
    if (material.alpha_texture != scene::kNoTexture)
        return MaskSource{material.alpha_texture, 0, cutoff};
    if (material.diffuse_texture != scene::kNoTexture &&
        texture_of(scene, material.diffuse_texture, material).has_alpha)
        return MaskSource{material.diffuse_texture, 3, cutoff};
    return std::nullopt;
}

std::uint32_t wrap_of(scene::Wrap wrap) {
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

// Sets the bits of the solid texels; true when all are.
bool threshold(const scene::MipLevel& level, const MaskSource& source, std::uint32_t* words) {
    const std::uint32_t row_words = (level.width + 31) / 32;
    const float least = source.cutoff * 255.0f;
    bool all_solid = true;
    for (std::uint32_t y = 0; y < level.height; ++y) {
        const std::uint8_t* texels = level.rgba.data() + std::size_t{4} * y * level.width;
        std::uint32_t* row = words + std::size_t{y} * row_words;
        for (std::uint32_t x = 0; x < level.width; ++x) {
            const bool solid =
                static_cast<float>(texels[std::size_t{4} * x + source.channel]) >= least;
            row[x / 32] |= (solid ? 1u : 0u) << (x % 32);
            all_solid = all_solid && solid;
        }
    }
    return all_solid;
}

std::uint32_t add_bitmap(const scene::Texture& texture, const MaskSource& source,
                         MaskBitmaps& bitmaps) {
    const scene::MipLevel empty;
    const scene::MipLevel& level = texture.levels.empty() ? empty : texture.levels[0];
    if (level.width == 0 || level.height == 0 || level.rgba.size() / 4 / level.width < level.height)
        throw std::invalid_argument("alpha mask: texture \"" + texture.name + "\" has " +
                                    std::to_string(level.rgba.size()) + " bytes for " +
                                    std::to_string(level.width) + " x " +
                                    std::to_string(level.height) + " texels");
    const std::uint64_t first = bitmaps.words.size();
    const std::uint64_t count = std::uint64_t{(level.width + 31) / 32} * level.height;
    if (first + count > 0xffffffffu)
        throw std::invalid_argument("alpha masks: more than 2^32 - 1 words");
    bitmaps.words.resize(first + count);
    if (threshold(level, source, bitmaps.words.data() + first)) {
        bitmaps.words.resize(first);
        return kNoMask;
    }
    bitmaps.textures.push_back({static_cast<std::uint32_t>(first), level.width, level.height,
                                wrap_of(texture.wrap_u) | wrap_of(texture.wrap_v) << 2});
    return static_cast<std::uint32_t>(bitmaps.textures.size() - 1);
}

shared::MaskTriangle mask_triangle(const scene::Mesh& mesh, const glm::uvec3& triangle,
                                   std::uint32_t texture) {
    shared::MaskTriangle result{};
    result.texture = texture;
    for (int corner = 0; corner < 3 && !mesh.uvs.empty(); ++corner) {
        const glm::vec2 uv = mesh.uvs[triangle[corner]];
        result.uv[corner][0] = uv.x;
        result.uv[corner][1] = uv.y;
    }
    return result;
}

} // namespace

std::vector<std::uint8_t> MaskBitmaps::masked_materials() const {
    std::vector<std::uint8_t> masked;
    for (const std::uint32_t mask : of_material)
        masked.push_back(mask == kNoMask ? 0 : 1);
    return masked;
}

MaskBitmaps make_mask_bitmaps(const scene::Scene& scene) {
    MaskBitmaps bitmaps;
    std::map<MaskSource, std::uint32_t> known;
    for (const scene::Material& material : scene.materials) {
        const std::optional<MaskSource> source = source_of(scene, material);
        if (!source) {
            bitmaps.of_material.push_back(kNoMask);
            continue;
        }
        const auto [entry, is_new] = known.try_emplace(*source, kNoMask);
        if (is_new)
            entry->second =
                add_bitmap(texture_of(scene, source->texture, material), *source, bitmaps);
        bitmaps.of_material.push_back(entry->second);
    }
    return bitmaps;
}

MaskTriangles make_mask_triangles(const scene::Scene& scene, std::span<const MeshPart> parts,
                                  const MaskBitmaps& bitmaps) {
    MaskTriangles result;
    if (bitmaps.textures.empty())
        return result;
    for (const MeshPart& part : parts) {
        const scene::Mesh& mesh = scene.meshes[part.mesh];
        result.slots.resize(std::size_t{part.first_entry} + part.triangle_count);
        for (std::uint32_t i = 0; i < part.triangle_count; ++i) {
            const std::uint32_t texture = bitmaps.of_material[mesh.triangle_material[i]];
            if (texture == kNoMask)
                continue;
            result.slots[part.first_entry + i] =
                static_cast<std::uint32_t>(result.triangles.size());
            result.triangles.push_back(mask_triangle(mesh, mesh.triangles[i], texture));
        }
    }
    return result;
}

} // namespace macula::frame
