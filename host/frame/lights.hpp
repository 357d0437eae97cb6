// The ways to light a scene: three of Weier et al. 2016 (section 4.1 and table 1), and Mrad's soft
// shadows (2022, section 4.1.1).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "scenes/scene.hpp"
#include "shared/light.h"

namespace macula::frame {

enum class LightMode : std::uint8_t {
    point,             // one shadow ray a light: area lights shrink to their centres
    area,              // several samples of each area light
    soft,              // few of them, from blue noise, and directional lights as wide as they are
    ambient_occlusion, // no direct light: white ambient light, where it is not occluded
};
// "point", "area", "soft", "ao".
const char* name(LightMode mode);
std::optional<LightMode> parse_light_mode(std::string_view text);

// Rays for each area light unless somebody asks for more: 3 of soft ones (Mrad), else 8 (Weier).
std::uint32_t default_light_samples(LightMode mode);

// The scene's lights for a mode; none for ambient occlusion. `samples`: rays for each area light,
// 1..4096. Lights without colour are left out. Throws std::invalid_argument for a number of samples
// out of range.
std::vector<shared::Light> make_lights(const scene::Scene& scene, LightMode mode,
                                       std::uint32_t samples);

// The radius of ambient occlusion where the scene names none: 15 % of its diagonal.
float ambient_occlusion_radius(const scene::Scene& scene);

} // namespace macula::frame
