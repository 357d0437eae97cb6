// Materials and textures of the city.
#include "scenes/procedural/city.hpp"
#include "scenes/procedural/patterns.hpp"

namespace macula::scene::procedural {
namespace {

constexpr glm::uvec2 kSmall{256, 256}, kMedium{512, 512};

void paint_masonry(Scene& scene, CityPalette& p, std::uint32_t seed) {
    const auto add = [&](const char* name, float relief, float gloss, const Painter& painter) {
        return add_material(scene, name, add_maps(scene, name, kMedium, relief, painter), gloss,
                            16.0f);
    };
    const std::uint32_t clay[3] = {0x9a4f38, 0xb07a52, 0x7c4a42};
    const char* names[3] = {"red_brick", "tan_brick", "dark_brick"};
    for (std::uint32_t i = 0; i < 3; ++i)
        p.brick[i] = {add(names[i], 0.006f, 0.0f,
                          [=](glm::vec2 uv) { return bricks(uv, rgb(clay[i]), seed + 100 * i); }),
                      1.8f};
    p.stone = {add("facing_stone", 0.004f, 0.04f,
                   [=](glm::vec2 uv) { return ashlar(uv, rgb(0xcdc0a6), seed + 400); }),
               3.2f};
    p.concrete = {add("concrete", 0.003f, 0.02f,
                      [=](glm::vec2 uv) { return plaster(uv, rgb(0x9a9894), seed + 500); }),
                  4.0f};
    p.pale_concrete = {add("pale_concrete", 0.003f, 0.02f,
                           [=](glm::vec2 uv) { return plaster(uv, rgb(0xd6d1c6), seed + 600); }),
                       4.0f};
    p.pavement = {add("pavement", 0.004f, 0.03f,
                      [=](glm::vec2 uv) { return slabs(uv, rgb(0xa9a59c), seed + 700); }),
                  3.0f};
    p.asphalt = {add("asphalt", 0.002f, 0.05f,
                     [=](glm::vec2 uv) { return asphalt(uv, rgb(0x4b4c50), seed + 800); }),
                 4.0f};
    p.gravel = {add("roof_gravel", 0.004f, 0.0f,
                    [=](glm::vec2 uv) { return asphalt(uv, rgb(0x8d887e), seed + 900); }),
                3.0f};
    p.lawn = {add("lawn", 0.01f, 0.0f,
                  [=](glm::vec2 uv) {
                      Texel texel = asphalt(uv, rgb(0x56803a), seed + 950);
                      texel.colour *= 1.0f + 0.2f * tiled_fractal(uv, 3, 3, seed + 951);
                      return texel;
                  }),
              5.0f};
}

void paint_glass(Scene& scene, CityPalette& p) {
    const std::uint32_t tints[4] = {0x2f4250, 0x3b5266, 0x52697a, 0x8f8a72};
    for (std::uint32_t i = 0; i < 4; ++i) {
        p.glass[i] = add_material(scene, "window_" + std::to_string(i + 1), rgb(tints[i]));
        Material& glass = scene.materials[p.glass[i]];
        glass.specular = glm::vec3{0.7f};
        glass.shininess = 150.0f;
        glass.reflectivity = glm::vec3{0.25f};
    }
}

void paint_street(Scene& scene, CityPalette& p, std::uint32_t seed) {
    p.trim = {add_material(scene, "trim", rgb(0xd9d2c2)), 1.0f};
    p.marking = {add_material(scene, "road_marking", rgb(0xe6e4da)), 1.0f};
    p.metal = {add_material(scene, "zinc", rgb(0x9aa0a4)), 1.0f};
    p.dark_metal = {add_material(scene, "cast_iron", rgb(0x2e3338)), 1.0f};
    for (const Finish& finish : {p.metal, p.dark_metal})
        scene.materials[finish.material].specular = glm::vec3{0.3f};
    const std::uint32_t stripes[3] = {0xa33b34, 0x2f5d74, 0x3f6b43};
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::string name = "awning_" + std::to_string(i + 1);
        const std::uint32_t texture = add_texture(scene, name, kSmall, [=](glm::vec2 uv) {
            return striped_canvas(uv, rgb(0xe9e2d0), rgb(stripes[i]), seed + 1000 + i);
        });
        p.awning[i] = {add_material(scene, name, Maps{texture, kNoTexture}), 0.8f};
        p.sign[i] = add_material(scene, "sign_" + std::to_string(i + 1), rgb(stripes[i]));
    }
    p.country = add_material(scene, "country", rgb(0x848c70));
    p.lamp = add_material(scene, "street_lamp", rgb(0xfff0cc));
    scene.materials[p.lamp].emission = {0.9f, 0.8f, 0.6f};
    const Maps wood = add_maps(scene, "wood", kSmall, 0.006f, [=](glm::vec2 uv) {
        return planks(uv, rgb(0x7c5a3a), 5, seed + 1100);
    });
    p.wood = {add_material(scene, "wood", wood, 0.03f), 1.2f};
    const Maps trunk = add_maps(scene, "bark", kSmall, 0.02f,
                                [=](glm::vec2 uv) { return bark(uv, rgb(0x6a5a48), seed + 1200); });
    p.bark = {add_material(scene, "bark", trunk), 0.5f};
    const std::uint32_t greens[2] = {0x5a8038, 0x7d8f3c};
    for (std::uint32_t i = 0; i < 2; ++i) {
        const std::string name = "foliage_" + std::to_string(i + 1);
        const std::uint32_t texture = add_texture(
            scene, name, kSmall,
            [=](glm::vec2 uv) { return leaf_spray(uv, rgb(greens[i]), seed + 1300 + i); },
            Wrap::clamp);
        p.leaves[i] = add_material(scene, name, Maps{texture, kNoTexture});
        scene.materials[p.leaves[i]].alpha_mode = AlphaMode::mask;
    }
}

} // namespace

CityPalette paint_city(Scene& scene, std::uint32_t seed) {
    CityPalette p;
    paint_masonry(scene, p, seed);
    paint_glass(scene, p);
    paint_street(scene, p, seed);
    return p;
}

} // namespace macula::scene::procedural
