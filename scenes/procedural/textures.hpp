// Painting of textures and their normal maps, with full mip chains.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "scenes/scene.hpp"

namespace macula::scene::procedural {

// Colours are chosen by eye, hence sRGB-encoded 0..1 here; materials hold linear ones.
struct Texel {
    glm::vec3 colour{0.5f};
    float height = 0.0f; // in units of the relief passed to add_maps()
    float alpha = 1.0f;
};
// The texel at (u, v) in [0, 1)^2; should be periodic unless the wrap mode is clamp.
using Painter = std::function<Texel(glm::vec2)>;

// Adds a texture of size.x * size.y texels; returns its index. Shapes cut out by alpha should have
// their colour outside too.
std::uint32_t add_texture(Scene& scene, const std::string& name, glm::uvec2 size,
                          const Painter& painter, Wrap wrap = Wrap::repeat);

// The colour texture and the normal map of its heights; `relief`: the height 1 in fractions of the
// texture's width.
struct Maps {
    std::uint32_t colour = kNoTexture, normal = kNoTexture;
};
Maps add_maps(Scene& scene, const std::string& name, glm::uvec2 size, float relief,
              const Painter& painter);

// Linear RGB of an sRGB-encoded colour (IEC 61966-2-1).
glm::vec3 linear_from_srgb(glm::vec3 colour);
// The sRGB-encoded colour 0xrrggbb.
glm::vec3 rgb(std::uint32_t hex);

// Adds a matte material of this sRGB colour; returns its index.
std::uint32_t add_material(Scene& scene, const std::string& name, glm::vec3 colour);
// Adds a material that takes its colour (and normals) from textures. `gloss`: specular weight.
std::uint32_t add_material(Scene& scene, const std::string& name, Maps maps, float gloss = 0.0f,
                           float shininess = 32.0f);

} // namespace macula::scene::procedural
