/// The demo's fly-through: `full`, `weier`, `lowres` and `logpolar+taa+upscale` along the same path
/// with the same gaze.
#pragma once

#include <cstdint>
#include <filesystem>

#include "host/cl/device.hpp"

namespace macula::app {

struct FlyThrough {
    const char* scene = "atrium";
    const char* display = "dk2";  // its middle eye
    const char* size = "394x488"; // pixels: a third of the display's
    const char* gaze = "target:speed=60";
    std::uint32_t first = 60, frames = 48; // of the scene's path
};

/// Writes PNG frames of each method, of the four side by side with the gaze marked, and a contact
/// sheet into `out`, and prints what the methods took. `lowres` gets as many samples as `weier`
/// took on average. Throws std::runtime_error where a file cannot be written.
void fly_through(const FlyThrough& flight, const compute::Device& device,
                 const std::filesystem::path& out);

} // namespace macula::app
