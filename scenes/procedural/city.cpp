// A city like the paper's Urban Sprawl: about 770 thousand triangles.
#include "scenes/procedural/city.hpp"

#include <algorithm>
#include <array>

#include "lib/math.h"
#include "scenes/procedural/builtin.hpp"
#include "scenes/procedural/path.hpp"
#include "scenes/procedural/textures.hpp"

namespace macula::scene::procedural {
namespace {

// Tall in the middle of the city, three to five storeys at its edge.
float building_height(glm::vec2 at, Random& random) {
    const glm::vec2 middle{0.3f * kPitchX, -0.2f * kPitchZ};
    const float away = glm::length(at - middle) / 120.0f;
    const float downtown = shared::m_exp(-away * away);
    const float low = random.range(13.0f, 24.0f), high = random.range(0.35f, 1.1f) * 135.0f;
    return low + downtown * high;
}

void build_block(MeshBuilder& b, const CityPalette& p, const Plot& block, Random& random) {
    if (random.chance(0.06f)) {
        build_park(b, p, block, random);
        return;
    }
    const int columns = random.between(2, 4);
    float x = block.lo.x;
    for (int i = 0; i < columns; ++i) {
        const float left = static_cast<float>(columns - i);
        const float share =
            i + 1 == columns ? block.hi.x - x : (block.hi.x - x) / left * random.range(0.8f, 1.2f);
        const Plot strip{{x, block.lo.y}, {x + share, block.hi.y}};
        x += share;
        const float height = building_height(0.5f * (strip.lo + strip.hi), random);
        // A tower takes the whole depth of the block, houses stand back to back.
        const unsigned ends = (i == 0 ? kWest : 0u) | (i + 1 == columns ? kEast : 0u);
        if (height > 55.0f || random.chance(0.2f)) {
            const Plot plot{strip.lo + glm::vec2{0.1f, 1.5f}, strip.hi - glm::vec2{0.1f, 1.5f},
                            height > 55.0f ? kAllSides : kNorth | kSouth | ends};
            build_building(b, p, plot, height, random);
            continue;
        }
        const float middle = 0.5f * (strip.lo.y + strip.hi.y), yard = 4.0f;
        const Plot front{strip.lo + glm::vec2{0.05f, 0.0f},
                         {strip.hi.x - 0.05f, middle - yard},
                         kNorth | kSouth | ends,
                         kSouth};
        const Plot back{{strip.lo.x + 0.05f, middle + yard},
                        strip.hi - glm::vec2{0.05f, 0.0f},
                        kNorth | kSouth | ends,
                        kNorth};
        build_building(b, p, front, height, random);
        const float other = building_height(0.5f * (back.lo + back.hi), random);
        build_building(b, p, back, std::min(other, 50.0f), random);
    }
}

// Along the middle of the streets, down to the traffic and up between the towers.
CameraPath tour() {
    struct Stop {
        int x, z; // crossing
        float height;
    };
    constexpr std::array<Stop, 10> kStops{{{1, 2, 6.0f},
                                           {2, 2, 3.4f},
                                           {4, 2, 4.5f},
                                           {4, 4, 12.0f},
                                           {5, 4, 30.0f},
                                           {5, 1, 70.0f},
                                           {3, 1, 90.0f},
                                           {3, 5, 60.0f},
                                           {1, 5, 26.0f},
                                           {1, 2, 6.0f}}};
    const auto crossing = [&](std::size_t i) {
        const Stop& s = kStops[i % (kStops.size() - 1)];
        return glm::vec3{street_x(s.x), s.height, street_z(s.z)};
    };
    std::vector<Waypoint> waypoints;
    for (std::size_t i = 0; i + 1 < kStops.size(); ++i) {
        const glm::vec3 from = crossing(i), to = crossing(i + 1);
        const glm::vec3 next = crossing(i + 2);
        constexpr int kPieces = 4;
        for (int k = 0; k < kPieces; ++k) {
            // Waypoints keep off the crossings themselves, so that corners are rounded.
            const float t = (static_cast<float>(k) + 0.5f) / kPieces;
            const glm::vec3 eye = glm::mix(from, to, t);
            const glm::vec3 ahead = t < 0.5f ? to : glm::mix(to, next, t - 0.5f);
            glm::vec3 target = ahead;
            target.y = glm::mix(eye.y, 0.5f * ahead.y, 0.45f);
            waypoints.push_back({eye, target});
        }
    }
    return fly_through(waypoints, true);
}

void light(Scene& scene) {
    Light sun;
    sun.kind = LightKind::point;
    sun.position = {-620.0f, 900.0f, 420.0f};
    sun.colour = {1.15f, 1.05f, 0.9f};
    sun.radius = 12.0f;
    scene.lights.push_back(sun);
    scene.ambient = {0.33f, 0.36f, 0.42f};
    scene.ambient_occlusion_radius = 12.0f;
    scene.background = linear_from_srgb(rgb(0xa8c8e8));
}

} // namespace

Scene make_city(const SceneParams& params) {
    Scene scene;
    const CityPalette p = paint_city(scene, fold_seed(params.seed));
    MeshBuilder b("city");
    build_streets(b, p, Random(params.seed, 1));
    Random blocks(params.seed, 2);
    for (int j = 0; j < kBlocksZ; ++j)
        for (int i = 0; i < kBlocksX; ++i) {
            const float margin = 0.5f * kStreet + kSidewalk;
            const Plot block{{street_x(i) + margin, street_z(j) + margin},
                             {street_x(i + 1) - margin, street_z(j + 1) - margin}};
            build_block(b, p, block, blocks);
        }
    // The country around, so that the city does not end in the sky.
    constexpr float kFar = 1500.0f, kLow = -0.3f;
    b.face({{-kFar, kLow, kFar}, {kFar, kLow, kFar}, {kFar, kLow, -kFar}, {-kFar, kLow, -kFar}},
           {p.country, 40.0f});
    scene.meshes.push_back(b.take());
    scene.instances.push_back({0, Transform{}, "city"});
    std::vector<Mesh> cars = build_cars(scene, p);
    const auto count = static_cast<std::uint32_t>(cars.size());
    for (Mesh& car : cars)
        scene.meshes.push_back(std::move(car));
    place_cars(scene, 1, count, Random(params.seed, 3));
    light(scene);
    scene.cameras.push_back({"street",
                             {street_x(1) + 4.0f, 4.2f, street_z(2)},
                             {street_x(4), 16.0f, street_z(2) - 6.0f},
                             {0, 1, 0},
                             70.0f});
    scene.path = tour();
    return scene;
}

} // namespace macula::scene::procedural
