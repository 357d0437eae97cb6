#include "scenes/texture_set.hpp"

#include <new>

#include "scenes/error.hpp"
#include "scenes/image.hpp"

namespace macula::scene {
namespace {

// One full-range step of an 8-bit height map over this many texels is a slope of 45 degrees: MTL
// gives no length for -bm, and this keeps stone looking like stone.
constexpr float kBumpTexels = 4.0f;

void apply_use(Image& image, const TextureRequest& request) {
    if (request.first_row_is_top_of_v)
        flip_vertically(image);
    if (request.use == TextureUse::mask)
        to_mask(image);
    if (request.use == TextureUse::bump && !looks_like_normal_map(image))
        bump_to_normal(image, kBumpTexels * request.bump_multiplier);
    if (request.negate_green)
        for (std::size_t i = 1; i < image.rgba.size(); i += 4)
            image.rgba[i] = static_cast<std::uint8_t>(255 - image.rgba[i]);
}

Image solid(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    return {1, 1, {r, g, b, 255}, false, 1};
}

} // namespace

Texture fallback_texture(const std::string& name, TextureUse use) {
    Image image;
    if (use == TextureUse::mask) {
        image = solid(255, 255, 255);
    } else if (use != TextureUse::colour) {
        image = solid(128, 128, 255);
    } else {
        constexpr std::uint32_t kSide = 16, kCheck = 2;
        image = {kSide, kSide, {}, false, kSide};
        for (std::uint32_t y = 0; y < kSide; ++y)
            for (std::uint32_t x = 0; x < kSide; ++x) {
                const std::uint8_t on = (x / kCheck + y / kCheck) % 2 == 0 ? 255 : 0;
                image.rgba.insert(image.rgba.end(), {on, 0, on, 255});
            }
    }
    Texture texture;
    texture.name = name;
    texture.srgb = use == TextureUse::colour;
    texture.levels = build_mips(std::move(image), texture.srgb);
    return texture;
}

Texture TextureSet::load(const TextureRequest& request) {
    if (!decode_) {
        Texture blank = fallback_texture(request.name, TextureUse::mask);
        blank.srgb = request.use == TextureUse::colour;
        return blank;
    }
    try {
        if (request.file.empty() && request.bytes.empty())
            throw SceneError(request.missing.empty() ? "no such file" : request.missing);
        Image image = request.file.empty() ? decode_image(request.bytes, request.name)
                                           : decode_image(request.file);
        if (image.original_side > kMaxTextureSide)
            scene_.warnings.push_back(
                "texture " + request.name + ": " + std::to_string(image.original_side) +
                " texels a side, halved until it fits " + std::to_string(kMaxTextureSide));
        apply_use(image, request);
        Texture texture;
        texture.name = request.name;
        texture.srgb = request.use == TextureUse::colour;
        texture.has_alpha = image.has_alpha;
        texture.levels = build_mips(std::move(image), texture.srgb);
        return texture;
    } catch (const SceneError& error) {
        scene_.warnings.push_back("texture " + request.name +
                                  ": replaced by a visible stand-in: " + error.what());
    } catch (const std::bad_alloc&) {
        scene_.warnings.push_back("texture " + request.name +
                                  ": replaced by a visible stand-in: out of memory");
    }
    return fallback_texture(request.name, request.use);
}

std::uint32_t TextureSet::add(const TextureRequest& request) {
    const Key key{
        request.name,        request.use, request.wrap_u, request.wrap_v, request.bump_multiplier,
        request.negate_green};
    const auto found = known_.find(key);
    if (found != known_.end())
        return found->second;
    Texture texture = load(request);
    texture.wrap_u = request.wrap_u;
    texture.wrap_v = request.wrap_v;
    const auto index = static_cast<std::uint32_t>(scene_.textures.size());
    scene_.textures.push_back(std::move(texture));
    known_.emplace(key, index);
    return index;
}

} // namespace macula::scene
