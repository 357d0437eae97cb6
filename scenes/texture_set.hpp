// The textures of a scene being loaded: each file is decoded once for each way it is used, and a
// texture that cannot be had becomes a visible one, with a warning.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "scenes/scene.hpp"

namespace macula::scene {

enum class TextureUse : std::uint8_t {
    colour, // sRGB, alpha kept
    mask,   // the mask in R
    normal, // tangent-space normals
    bump,   // heights, or normals where the image looks like them
};

struct TextureRequest {
    std::string name;           // what the scene calls it; part of warnings
    std::filesystem::path file; // empty: `bytes` hold the encoded image, or it is missing
    std::span<const unsigned char> bytes;
    std::string missing; // why there is neither file nor bytes, when there is neither
    TextureUse use = TextureUse::colour;
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool first_row_is_top_of_v = true; // OBJ: the file's top row is v = 1
    bool negate_green = false;         // glTF: the map's +y points to decreasing v
    float bump_multiplier = 1.0f;      // MTL's -bm
};

class TextureSet {
  public:
    // Textures and warnings are appended to `scene`, which must outlive the set. With
    // `decode` false every texture is 1 x 1, white and opaque.
    TextureSet(Scene& scene, bool decode) : scene_(scene), decode_(decode) {}

    bool decodes() const { return decode_; }
    // Index of the texture in scene.textures.
    std::uint32_t add(const TextureRequest& request);

  private:
    using Key = std::tuple<std::string, TextureUse, Wrap, Wrap, float, bool>;
    Texture load(const TextureRequest& request);

    Scene& scene_;
    bool decode_;
    std::map<Key, std::uint32_t> known_;
};

// The magenta and black checks that stand for a missing texture; for masks and normal maps the
// neutral value instead (solid, flat), so that only the colour shouts.
Texture fallback_texture(const std::string& name, TextureUse use);

} // namespace macula::scene
