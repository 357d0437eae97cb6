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

/// Channels of one frame that belong together, pixel-interleaved, rows from the top.
struct Layer {
    /// As they are named in the file: R, G, B, Albedo.R, N.X, P.X, Z, ... (pbrt-v4's names).
    std::vector<std::string> channels;
    /// width * height * channels.size() floats.
    std::span<const float> pixels;
    /// Stored as 16-bit floats when true; positions and depths need 32.
    bool half = false;
};

using Metadata = std::vector<std::pair<std::string, std::string>>;

/// Writes all layers into one part. Metadata keys become string attributes "macula:<key>".
/// Throws std::runtime_error that names the file and the cause.
void write_exr(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
               std::span<const Layer> layers, const Metadata& metadata);

/// Linear RGB to 8-bit sRGB, clamped to [0, 1] after scaling by `exposure`.
/// `rgb`: width * height * 3 floats. Throws as write_exr does.
void write_png(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
               std::span<const float> rgb, float exposure, const Metadata& metadata);

/// The sRGB encoding of a linear value (IEC 61966-2-1), clamped to [0, 1], as 0..255.
std::uint8_t encode_srgb(float linear);

} // namespace macula::output
