// A town of blocks like the Minecraft map Rungholt of the paper: 6.7 million triangles by default.
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/procedural/builtin.hpp"
#include "scenes/procedural/path.hpp"
#include "scenes/procedural/textures.hpp"
#include "scenes/procedural/voxel.hpp"

namespace macula::scene::procedural {
namespace {

constexpr std::uint32_t kDefaultSize = 858;
constexpr std::uint32_t kSmallest = 32, kLargest = 2048;

struct Paint {
    const char* name;
    std::uint32_t colour; // sRGB
    float variation;      // of the tones' brightness
};

constexpr std::array kPaints{
    Paint{"grass", 0x6d9a45, 0.12f},         Paint{"dirt", 0x80603f, 0.12f},
    Paint{"rock", 0x82807c, 0.10f},          Paint{"sand", 0xd6c694, 0.06f},
    Paint{"water", 0x32628f, 0.05f},         Paint{"snow", 0xeef2f6, 0.02f},
    Paint{"gravel", 0x9d948a, 0.10f},        Paint{"cobble", 0x8d8880, 0.14f},
    Paint{"paving", 0xb0a898, 0.08f},        Paint{"field", 0x6c4c2c, 0.10f},
    Paint{"wheat", 0xcdb04e, 0.14f},         Paint{"oak_leaves", 0x4c8236, 0.18f},
    Paint{"pine_leaves", 0x2f5e3a, 0.15f},   Paint{"autumn_leaves", 0xc0782c, 0.16f},
    Paint{"log", 0x5c4630, 0.12f},           Paint{"timber", 0x4d3826, 0.10f},
    Paint{"planks", 0xa57f4d, 0.10f},        Paint{"white_plaster", 0xe6e0d2, 0.04f},
    Paint{"ochre_plaster", 0xdcb26a, 0.06f}, Paint{"rose_plaster", 0xd29a86, 0.06f},
    Paint{"blue_plaster", 0x9db4c4, 0.06f},  Paint{"brick", 0x9c5640, 0.14f},
    Paint{"stone_brick", 0x8f8d88, 0.10f},   Paint{"pale_stone", 0xd2c8b2, 0.06f},
    Paint{"red_roof", 0xa8462f, 0.16f},      Paint{"slate_roof", 0x4e5866, 0.14f},
    Paint{"copper_roof", 0x5fa08c, 0.10f},   Paint{"glass", 0x7fa6c0, 0.12f},
    Paint{"stained_glass", 0x6a4fa0, 0.35f}, Paint{"lamp", 0xffd88a, 0.02f},
    Paint{"canvas", 0xeae0c8, 0.05f},        Paint{"iron", 0x3c3e42, 0.06f},
};
static_assert(kPaints.size() + 1 == static_cast<std::size_t>(Block::count));

void add_materials(Scene& scene) {
    for (const Paint& paint : kPaints)
        for (std::uint32_t tone = 0; tone < kTones; ++tone) {
            const float shade = 1.0f + paint.variation * (static_cast<float>(tone) - 1.0f);
            add_material(scene, paint.name + std::string("_") + std::to_string(tone + 1),
                         glm::min(rgb(paint.colour) * shade, glm::vec3{1.0f}));
        }
    const auto tones = [&](Block block) {
        return std::span(scene.materials)
            .subspan((static_cast<std::size_t>(block) - 1) * kTones, kTones);
    };
    for (Material& m : tones(Block::lamp))
        m.emission = m.diffuse;
    for (const Block block : {Block::water, Block::glass, Block::stained_glass})
        for (Material& m : tones(block)) {
            m.specular = glm::vec3{0.5f};
            m.shininess = 80.0f;
            m.reflectivity = glm::vec3{0.2f};
        }
}

// The highest ground or roof within `reach` blocks.
float highest(const VoxelGrid& grid, glm::vec2 at, int reach) {
    const int x = static_cast<int>(at.x), z = static_cast<int>(at.y);
    int top = kWaterLevel;
    for (int dz = -reach; dz <= reach; ++dz)
        for (int dx = -reach; dx <= reach; ++dx)
            top = std::max(top, grid.top(x + dx, z + dz));
    return static_cast<float>(top);
}

// Along the avenue through the town, then back in a wide turn over its roofs.
CameraPath tour(const VoxelGrid& grid) {
    const float size = static_cast<float>(grid.size()), middle = 0.5f * size + 0.5f;
    constexpr int kStreet = 24, kSky = 24;
    std::vector<Waypoint> waypoints;
    for (int i = 0; i < kStreet; ++i) {
        const float t = static_cast<float>(i) / (kStreet - 1);
        const glm::vec2 at{size * (0.1f + 0.8f * t), middle};
        const int spacing = static_cast<int>(0.8f * size / kStreet);
        float top = 0.0f;
        for (int d = -spacing; d <= spacing; d += 2)
            top = std::max(top, highest(grid, at + glm::vec2{static_cast<float>(d), 0.0f}, 2));
        const float eye = top + 3.5f + 5.0f * sin_cos_turns(t).x * sin_cos_turns(t).x;
        const glm::vec2 sway = sin_cos_turns(2.5f * t);
        waypoints.push_back(
            {{at.x, eye, at.y},
             {at.x + 0.16f * size, eye - 1.0f + 4.0f * t, at.y + 0.05f * size * sway.y}});
    }
    for (int i = 1; i < kSky; ++i) {
        const float t = static_cast<float>(i) / kSky;
        const glm::vec2 turn = sin_cos_turns(0.5f * t);
        const glm::vec2 at{middle + 0.4f * size * turn.x, middle + 0.33f * size * turn.y};
        const float eye =
            highest(grid, at, 4 + static_cast<int>(0.05f * size)) + 8.0f + 0.06f * size * turn.y;
        const glm::vec2 ahead = sin_cos_turns(0.5f * t + 0.14f);
        const float look = 0.25f * turn.y;
        const glm::vec3 target{glm::mix(middle + 0.4f * size * ahead.x, middle, look), 34.0f,
                               glm::mix(middle + 0.33f * size * ahead.y, middle, look)};
        waypoints.push_back({{at.x, eye, at.y}, target});
    }
    return fly_through(waypoints, true);
}

void light(Scene& scene, float size) {
    Light sun;
    sun.kind = LightKind::point;
    sun.position = {-1.1f * size, 1.9f * size, -0.8f * size};
    sun.colour = {1.05f, 0.98f, 0.86f};
    sun.radius = 0.03f * size;
    scene.lights.push_back(sun);
    scene.ambient = {0.30f, 0.34f, 0.40f};
    scene.ambient_occlusion_radius = 12.0f;
    scene.background = linear_from_srgb(rgb(0x9cc6f0));
}

} // namespace

Scene make_voxel_city(const SceneParams& params) {
    const std::uint32_t size = params.size == 0 ? kDefaultSize : params.size;
    if (size < kSmallest || size > kLargest)
        throw std::invalid_argument("voxel_city: size " + std::to_string(size) +
                                    " is not between " + std::to_string(kSmallest) + " and " +
                                    std::to_string(kLargest) + " blocks");
    const TownPlan plan = plan_town(static_cast<int>(size), fold_seed(params.seed));
    VoxelGrid grid(plan.size, kVoxelHeight);
    build_terrain(grid, plan);
    Random lots(params.seed, 1), houses(params.seed, 2), landmarks(params.seed, 3),
        nature(params.seed, 4);
    for (const Lot& lot : plan_lots(plan, lots))
        build_house(grid, plan, lot, houses);
    build_landmarks(grid, plan, landmarks);
    build_nature(grid, plan, nature);

    Scene scene;
    add_materials(scene);
    scene.path = tour(grid);
    scene.meshes.push_back(voxel_surface(grid));
    light(scene, static_cast<float>(size));
    scene.cameras.push_back(
        {"over_the_roofs",
         {0.12f * static_cast<float>(size), 78.0f, 0.2f * static_cast<float>(size)},
         {0.5f * static_cast<float>(size), 18.0f, 0.5f * static_cast<float>(size)},
         {0, 1, 0},
         60.0f});
    return scene;
}

} // namespace macula::scene::procedural
