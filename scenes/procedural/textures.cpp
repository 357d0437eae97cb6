#include "scenes/procedural/textures.hpp"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>
#include <vector>

#include "lib/math.h"
#include "scenes/image.hpp"

namespace macula::scene::procedural {
namespace {

std::uint8_t encode(float x) {
    const float scaled = std::floor(glm::clamp(x, 0.0f, 1.0f) * 255.0f + 0.5f);
    return static_cast<std::uint8_t>(scaled);
}

void put(Image& image, std::size_t texel, glm::vec3 colour, float alpha) {
    for (int c = 0; c < 3; ++c)
        image.rgba[texel * 4 + static_cast<std::size_t>(c)] = encode(colour[c]);
    image.rgba[texel * 4 + 3] = encode(alpha);
    image.has_alpha = image.has_alpha || image.rgba[texel * 4 + 3] < 255;
}

Image blank(glm::uvec2 size) {
    Image image;
    image.width = size.x;
    image.height = size.y;
    image.rgba.resize(std::size_t{size.x} * size.y * 4);
    return image;
}

std::uint32_t add(Scene& scene, const std::string& name, Image&& image, bool srgb, Wrap wrap) {
    Texture texture;
    texture.name = name;
    texture.srgb = srgb;
    texture.wrap_u = texture.wrap_v = wrap;
    texture.has_alpha = image.has_alpha;
    texture.levels = build_mips(std::move(image), srgb);
    scene.textures.push_back(std::move(texture));
    return static_cast<std::uint32_t>(scene.textures.size() - 1);
}

// Calls row(y) for all rows, on all cores: textures are most of a scene's making.
void for_rows(std::uint32_t rows, const std::function<void(std::uint32_t)>& row) {
    const std::uint32_t threads = std::clamp(std::thread::hardware_concurrency(), 1u, 16u);
    std::vector<std::jthread> pool;
    for (std::uint32_t t = 0; t < threads; ++t)
        pool.emplace_back([&, t] {
            for (std::uint32_t y = t; y < rows; y += threads)
                row(y);
        });
}

// Paints all texels; heights are kept when asked for.
Image paint(glm::uvec2 size, const Painter& painter, std::vector<float>* heights) {
    std::vector<Texel> texels(std::size_t{size.x} * size.y);
    const glm::vec2 step = 1.0f / glm::vec2(size);
    for_rows(size.y, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < size.x; ++x)
            texels[std::size_t{y} * size.x + x] = painter((glm::vec2(x, y) + 0.5f) * step);
    });
    Image image = blank(size);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        put(image, i, texels[i].colour, texels[i].alpha);
        if (heights != nullptr)
            heights->push_back(texels[i].height);
    }
    return image;
}

Image normals_of(glm::uvec2 size, const std::vector<float>& heights, float relief) {
    Image image = blank(size);
    const auto height = [&](std::uint32_t x, std::uint32_t y) {
        return heights[std::size_t{y % size.y} * size.x + x % size.x];
    };
    const float strength = 0.5f * relief * static_cast<float>(size.x);
    std::size_t i = 0;
    for (std::uint32_t y = 0; y < size.y; ++y)
        for (std::uint32_t x = 0; x < size.x; ++x, ++i) {
            const float du = height(x + 1, y) - height(x + size.x - 1, y),
                        dv = height(x, y + 1) - height(x, y + size.y - 1);
            const glm::vec3 n = glm::normalize(glm::vec3{-strength * du, -strength * dv, 1.0f});
            put(image, i, 0.5f * n + 0.5f, 1.0f);
        }
    return image;
}

} // namespace

std::uint32_t add_texture(Scene& scene, const std::string& name, glm::uvec2 size,
                          const Painter& painter, Wrap wrap) {
    return add(scene, name, paint(size, painter, nullptr), true, wrap);
}

Maps add_maps(Scene& scene, const std::string& name, glm::uvec2 size, float relief,
              const Painter& painter) {
    std::vector<float> heights;
    heights.reserve(std::size_t{size.x} * size.y);
    Maps maps;
    maps.colour = add(scene, name, paint(size, painter, &heights), true, Wrap::repeat);
    maps.normal =
        add(scene, name + "_normal", normals_of(size, heights, relief), false, Wrap::repeat);
    return maps;
}

glm::vec3 linear_from_srgb(glm::vec3 colour) {
    for (int c = 0; c < 3; ++c)
        colour[c] = colour[c] <= 0.04045f ? colour[c] / 12.92f
                                          : shared::m_pow((colour[c] + 0.055f) / 1.055f, 2.4f);
    return colour;
}

glm::vec3 rgb(std::uint32_t hex) {
    return glm::vec3{static_cast<float>((hex >> 16) & 255u), static_cast<float>((hex >> 8) & 255u),
                     static_cast<float>(hex & 255u)} /
           255.0f;
}

std::uint32_t add_material(Scene& scene, const std::string& name, glm::vec3 colour) {
    Material material;
    material.name = name;
    material.diffuse = linear_from_srgb(colour);
    scene.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

std::uint32_t add_material(Scene& scene, const std::string& name, Maps maps, float gloss,
                           float shininess) {
    Material material;
    material.name = name;
    material.diffuse = glm::vec3{1.0f};
    material.specular = glm::vec3{gloss};
    material.shininess = shininess;
    material.diffuse_texture = maps.colour;
    material.normal_texture = maps.normal;
    scene.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

} // namespace macula::scene::procedural
