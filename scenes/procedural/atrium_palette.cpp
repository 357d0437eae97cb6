// Materials and textures of the atrium.
#include "scenes/procedural/atrium.hpp"
#include "scenes/procedural/patterns.hpp"

namespace macula::scene::procedural {
namespace {

constexpr glm::uvec2 kSmall{256, 256}, kMedium{512, 512}, kLarge{1024, 1024};

std::uint32_t add_mask(Scene& scene, const char* name, glm::uvec2 size, const Painter& painter) {
    const std::uint32_t texture = add_texture(scene, name, size, painter, Wrap::clamp);
    const std::uint32_t index = add_material(scene, name, Maps{texture, kNoTexture}, 0.06f, 20.0f);
    scene.materials[index].alpha_mode = AlphaMode::mask;
    return index;
}

void paint_stone(Scene& scene, Palette& p, std::uint32_t seed) {
    const auto add = [&](const char* name, glm::uvec2 size, float relief, float gloss,
                         float shininess, const Painter& painter) {
        return add_material(scene, name, add_maps(scene, name, size, relief, painter), gloss,
                            shininess);
    };
    p.ashlar = {add("ashlar", kLarge, 0.006f, 0.03f, 12.0f,
                    [=](glm::vec2 uv) { return ashlar(uv, rgb(0xcdb893), seed + 1000); }),
                2.4f};
    p.stone = {add("limestone", kMedium, 0.004f, 0.06f, 20.0f,
                   [=](glm::vec2 uv) { return limestone(uv, rgb(0xdccbaa), seed + 1100); }),
               1.2f};
    p.plaster = {add("plaster", kMedium, 0.004f, 0.0f, 10.0f,
                     [=](glm::vec2 uv) { return plaster(uv, rgb(0xe6c79c), seed + 1200); }),
                 3.0f};
    p.vault = {add("vault_plaster", kMedium, 0.004f, 0.0f, 10.0f,
                   [=](glm::vec2 uv) { return plaster(uv, rgb(0xece4d2), seed + 1300); }),
               2.5f};
    p.floor = {add("marble_floor", kLarge, 0.002f, 0.22f, 60.0f,
                   [=](glm::vec2 uv) { return marble_floor(uv, seed + 1400); }),
               2.0f};
    p.slabs = {add("slabs", kLarge, 0.004f, 0.08f, 24.0f,
                   [=](glm::vec2 uv) { return slabs(uv, rgb(0xb9a98d), seed + 1500); }),
               2.4f};
    p.roof = {add("roof_tile", kSmall, 0.006f, 0.02f, 10.0f,
                  [=](glm::vec2 uv) { return terracotta(uv, seed + 1600); }),
              1.5f};
    p.clay = {p.roof.material, 0.8f};
    p.brick = {add("brick", kMedium, 0.006f, 0.0f, 10.0f,
                   [=](glm::vec2 uv) { return bricks(uv, rgb(0xa8603f), seed + 1700); }),
               1.6f};
}

void paint_wood_and_metal(Scene& scene, Palette& p, std::uint32_t seed) {
    const Maps wood = add_maps(scene, "oak", kMedium, 0.006f, [=](glm::vec2 uv) {
        return planks(uv, rgb(0x80562f), 4, seed + 2000);
    });
    p.wood = {add_material(scene, "oak", wood, 0.08f, 24.0f), 1.0f};
    const Maps bronze = add_maps(scene, "bronze", kSmall, 0.01f, [=](glm::vec2 uv) {
        return hammered_metal(uv, rgb(0x9a7440), seed + 2100);
    });
    p.bronze = {add_material(scene, "bronze", bronze, 0.45f, 40.0f), 0.5f};
    const Maps bark_maps = add_maps(scene, "bark", kSmall, 0.02f, [=](glm::vec2 uv) {
        return bark(uv, rgb(0x6f563d), seed + 2200);
    });
    p.bark = {add_material(scene, "bark", bark_maps, 0.0f), 0.4f};
    const Maps waves = add_maps(scene, "water", kSmall, 0.03f,
                                [=](glm::vec2 uv) { return water(uv, seed + 2300); });
    p.water = {add_material(scene, "water", waves, 0.6f, 120.0f), 1.6f};
    scene.materials[p.water.material].reflectivity = glm::vec3{0.25f};
    p.soil = {add_material(scene, "soil", rgb(0x4a382a)), 1.0f};
    p.flame = add_material(scene, "flame", rgb(0xffd890));
    scene.materials[p.flame].emission = {1.0f, 0.68f, 0.3f};
}

void paint_cloth(Scene& scene, Palette& p, std::uint32_t seed) {
    const glm::vec3 base[3] = {rgb(0x8c2026), rgb(0x27496f), rgb(0x3c5f36)};
    const char* names[3] = {"red_damask", "blue_damask", "green_damask"};
    for (std::uint32_t i = 0; i < 3; ++i) {
        const glm::vec3 colour = base[i];
        const Maps maps = add_maps(scene, names[i], kMedium, 0.003f, [=](glm::vec2 uv) {
            return damask(uv, colour, rgb(0xcfa24e), seed + 3000 + i);
        });
        p.cloth[i] = {add_material(scene, names[i], maps, 0.05f, 12.0f), 0.9f};
    }
    const Maps canvas = add_maps(scene, "canvas", kMedium, 0.002f, [=](glm::vec2 uv) {
        return striped_canvas(uv, rgb(0xece0c6), rgb(0xb5503a), seed + 3100);
    });
    p.canopy = {add_material(scene, "canvas", canvas, 0.0f), 1.0f};
}

} // namespace

Palette paint_atrium(Scene& scene, std::uint32_t seed) {
    Palette p;
    paint_stone(scene, p, seed);
    paint_wood_and_metal(scene, p, seed);
    paint_cloth(scene, p, seed);
    p.ivy = add_mask(scene, "ivy", kSmall, [=](glm::vec2 uv) { return ivy_leaf(uv, seed + 4000); });
    p.frond =
        add_mask(scene, "frond", kMedium, [=](glm::vec2 uv) { return frond(uv, seed + 4100); });
    p.spray = add_mask(scene, "leaf_spray", kMedium,
                       [=](glm::vec2 uv) { return leaf_spray(uv, rgb(0x5d8a3a), seed + 4200); });
    p.chain = add_mask(scene, "chain", {64, 128}, chain);
    scene.textures[scene.materials[p.chain].diffuse_texture].wrap_v = Wrap::repeat;
    scene.materials[p.chain].specular = glm::vec3{0.3f};
    return p;
}

} // namespace macula::scene::procedural
