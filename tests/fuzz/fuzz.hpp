// What the fuzz targets share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "scenes/validate.hpp"

namespace macula::scene::fuzz {

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

// validate() without the slow search for a default view.
inline void validate_with_view(Scene& scene) {
    scene.cameras = {Camera{}};
    scene.lights = {Light{}};
    validate(scene);
}

} // namespace macula::scene::fuzz
