/// Writing frames: multi-channel OpenEXR and tone-mapped PNG. A file appears whole or not at all:
/// it is written under a temporary name beside its target and renamed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace macula::output {

/// Channels of one frame that belong together, rows from the top, as the device left them.
struct Layer {
    /// As they are named in the file: R, G, B, Albedo.R, N.X, P.X, Z, ... (pbrt-v4's names).
    std::vector<std::string> channels;
    /// width * height pixels of `stride` 32-bit words; the first channels.size() are written.
    std::span<const std::uint32_t> words;
    std::uint32_t stride = 0;
    /// The words are unsigned integers rather than floats.
    bool integer = false;
};

using Metadata = std::vector<std::pair<std::string, std::string>>;

/// Writes all layers into one part. Metadata keys become string attributes "macula:<key>".
/// Throws std::runtime_error that names the file and the cause.
void write_exr(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
               std::span<const Layer> layers, const Metadata& metadata);

/// Linear RGB to 8-bit sRGB, clamped to [0, 1] after scaling by `exposure`.
/// `pixels`: width * height pixels of `stride` floats, R, G, B first. Throws as write_exr does.
void write_png(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
               std::span<const float> pixels, std::uint32_t stride, float exposure,
               const Metadata& metadata);

/// The sRGB encoding of a linear value (IEC 61966-2-1), clamped to [0, 1], as 0..255.
std::uint8_t encode_srgb(float linear);

} // namespace macula::output
