/// Arbitrary output variables: the images of the renderer as channels of an EXR file.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace macula::app {

struct Aov {
    const char* name;                  // as --aov takes it
    const char* image;                 // of render::image_formats()
    std::vector<const char*> channels; // pbrt-v4's names where it has one
};

std::span<const Aov> aovs();

/// Throws std::invalid_argument that lists the known names.
const Aov& find_aov(const std::string& name);

} // namespace macula::app
