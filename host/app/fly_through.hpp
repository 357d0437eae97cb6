/// The demo's fly-throughs: several methods along the same path with the same gaze.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "host/cl/device.hpp"

namespace macula::app {

struct FlyThrough {
    const char* scene;
    const char* display; // its middle eye
    const char* size;    // pixels
    const char* gaze;
    std::uint32_t first, frames;      // of the scene's path
    std::vector<const char*> methods; // the first is what the others are measured against
};

/// Writes PNG frames of each method, of all side by side (two in a row) with the gaze marked, and a
/// contact sheet into `out`, and prints what the methods took. `lowres` gets as many samples as
/// `weier` takes on average. Throws std::runtime_error where a file cannot be written.
void fly_through(const FlyThrough& flight, const compute::Device& device,
                 const std::filesystem::path& out);

} // namespace macula::app
