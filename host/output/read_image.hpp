/// Reading frames back for the scores. Strict: what a score cannot judge truly is refused.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host/metric/picture.hpp"
#include "host/metric/temporal.hpp"

namespace macula::output {

enum class ImageKind { png, exr };

struct ReadPicture {
    metric::Picture picture; // linear, see docs/metrics.md
    ImageKind kind = ImageKind::png;
    unsigned bits = 8; // a channel, in the file
    /// The channels Motion.X and Motion.Y of an EXR file that has them.
    std::optional<metric::MotionField> motion;
};

/// PNG (8 or 16 bits a channel, RGB, or RGBA without transparency, sRGB) or EXR (half or float, the
/// channels R, G and B by name, linear). Throws std::runtime_error that names the file and what is
/// wrong: missing, truncated or unsuitable file, channels or bit depth, size beyond
/// metric::kMaxPixels, a value that is not finite (with its pixel).
ReadPicture read_picture(const std::filesystem::path& path);

/// The motion of an EXR file; throws as read_picture does, also when it has none.
metric::MotionField read_motion(const std::filesystem::path& path);

} // namespace macula::output
