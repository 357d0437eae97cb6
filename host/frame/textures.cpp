#include <cstring>
#include <limits>
#include <stdexcept>

#include "host/frame/blended.hpp"
#include "host/frame/surfaces.hpp"
#include "lib/texture.h"

namespace macula::frame {
namespace {

std::uint32_t wrap_bits(scene::Wrap wrap) {
    switch (wrap) {
    case scene::Wrap::repeat:
        return MACULA_WRAP_REPEAT;
    case scene::Wrap::clamp:
        return MACULA_WRAP_CLAMP;
    case scene::Wrap::mirror:
        return MACULA_WRAP_MIRROR;
    }
    throw std::invalid_argument("unknown texture wrap mode");
}

std::vector<bool> textures_in_use(const scene::Scene& scene) {
    std::vector<bool> used(scene.textures.size(), false);
    for (const scene::Material& m : scene.materials) {
        if (is_blended(m) && m.alpha_texture < used.size())
            used[m.alpha_texture] = true;
        for (const std::uint32_t texture :
             {m.diffuse_texture, m.specular_texture, m.emission_texture, m.normal_texture})
            if (texture < used.size())
                used[texture] = true;
    }
    return used;
}

void append_level(const scene::MipLevel& level, TextureData& data) {
    const std::uint64_t count = std::uint64_t{level.width} * level.height;
    if (count == 0 || level.rgba.size() != 4 * count)
        throw std::invalid_argument("a texture level's size is not that of its texels");
    if (data.texels.size() + count > std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument("the scene's textures have more than 2^32 texels together");
    const auto first = static_cast<std::uint32_t>(data.texels.size());
    data.levels.push_back({first, level.width, level.height, 0});
    data.texels.resize(data.texels.size() + static_cast<std::size_t>(count));
    // RGBA bytes in memory are the little-endian word that the kernels take apart.
    std::memcpy(data.texels.data() + first, level.rgba.data(), level.rgba.size());
}

} // namespace

TextureData::TextureData(const scene::Scene& scene)
    : slot_of(scene.textures.size(), scene::kNoTexture) {
    const std::vector<bool> used = textures_in_use(scene);
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        const scene::Texture& texture = scene.textures[i];
        if (!used[i] || texture.levels.empty())
            continue;
        slot_of[i] = static_cast<std::uint32_t>(textures.size());
        shared::ImageTexture out{};
        out.first_level = static_cast<std::uint32_t>(levels.size());
        out.level_count = static_cast<std::uint32_t>(texture.levels.size());
        out.wrap = wrap_bits(texture.wrap_u) | (wrap_bits(texture.wrap_v) << 2);
        out.decode = texture.srgb ? 256 : 0;
        const scene::MipLevel& finest = texture.levels.front();
        out.log2_size = 0.5f * (shared::m_log2(static_cast<float>(finest.width)) +
                                shared::m_log2(static_cast<float>(finest.height)));
        textures.push_back(out);
        for (const scene::MipLevel& level : texture.levels)
            append_level(level, *this);
    }
}

std::vector<float> decoding_table() {
    std::vector<float> table(512);
    for (int i = 0; i < 256; ++i) {
        const float encoded = static_cast<float>(i) / 255.0f;
        table[static_cast<std::size_t>(i)] = encoded;
        table[static_cast<std::size_t>(i) + 256] =
            encoded <= 0.04045f ? encoded / 12.92f
                                : shared::m_pow((encoded + 0.055f) / 1.055f, 2.4f);
    }
    return table;
}

} // namespace macula::frame
