// Decoding of image files through OpenImageIO into 8-bit RGBA.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scenes/scene.hpp"

namespace macula::scene {

// Images are halved until they fit; beyond kMaxDecodeSide they are refused.
inline constexpr std::uint32_t kMaxTextureSide = 8192;
inline constexpr std::uint32_t kMaxDecodeSide = 65536;

// A decoded image: width * height * 4 bytes, top row first; grey is spread over RGB; alpha is
// unassociated and 255 where the file has none.
struct Image {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
    bool has_alpha = false;          // some alpha is below 255
    std::uint32_t original_side = 0; // the longer side in the file, before halving
};

// Throw SceneError (its message does not repeat `path`'s folder) when the image cannot be had.
Image decode_image(const std::filesystem::path& path);
Image decode_image(std::span<const unsigned char> bytes, const std::string& name);

void flip_vertically(Image& image);

// Replaces the colour by a grey mask: the alpha channel where the image has one and its colour
// does not vary, else the red channel (MTL's map_d). Alpha becomes 255.
void to_mask(Image& image);

// True for an image whose colours are those of unit vectors around +z: a normal map that an OBJ
// file declares as a bump map.
bool looks_like_normal_map(const Image& image);

// Replaces a height field (red channel, 0..1, repeating) by its tangent-space normal map, with y
// along increasing v, row 0 being v = 0. `strength`: height of a full-range step, in texels.
void bump_to_normal(Image& image, float strength);

// The mip chain down to 1 x 1, by an area-weighted box filter that also suits odd sizes. With
// `srgb` the colours are averaged in linear light; they are weighted by alpha, so that the colour
// of invisible texels does not bleed.
std::vector<MipLevel> build_mips(Image&& image, bool srgb);

} // namespace macula::scene
