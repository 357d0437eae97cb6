// A Sponza-like hall: the scene of the demonstration.
#include "scenes/procedural/atrium.hpp"

#include <array>

#include "scenes/procedural/builtin.hpp"
#include "scenes/procedural/path.hpp"
#include "scenes/procedural/textures.hpp"

namespace macula::scene::procedural {
namespace {

void build_furniture(MeshBuilder& b, const Palette& p) {
    b.place = upright({0.0f, kCourtFloor, 0.0f});
    fountain(b, p);
    for (const Bay& bay : court_bays()) {
        if (bay.index % 2 != 1)
            continue;
        // Under the vault's crown.
        b.place = bay.place;
        b.place.origin = bay.place.point({0.0f, kSpring + kVaultRise, -0.5f * kGallery});
        lantern(b, p, 1.3f);
    }
    for (const float x : {-4.6f, 4.6f})
        for (const float z : {-4.0f, 4.0f}) {
            b.place = upright({x, kCourtFloor, z});
            block(b, {-0.9f, 0.38f, -0.22f}, {0.9f, 0.48f, 0.22f}, 0.02f, p.stone);
            for (const float leg : {-0.65f, 0.65f})
                block(b, {leg - 0.1f, 0.0f, -0.18f}, {leg + 0.1f, 0.38f, 0.18f}, 0.02f, p.stone);
        }
    b.place = {};
}

void light(Scene& scene) {
    // Under the open sky between the awnings, low enough to reach into the galleries.
    Light skylight;
    skylight.kind = LightKind::point;
    skylight.position = {0.9f, 12.4f, 1.6f};
    skylight.colour = {0.95f, 0.88f, 0.76f};
    skylight.radius = 0.35f;
    scene.lights.push_back(skylight);
    scene.ambient = {0.28f, 0.29f, 0.32f};
    scene.ambient_occlusion_radius = 3.0f;
    scene.background = linear_from_srgb(rgb(0x9cc3ea));
}

CameraPath tour() {
    // Down the court, around the fountain, through the side gallery, up over the balustrade, along
    // the upper gallery and back across the court.
    constexpr std::array<Waypoint, 24> kTour{{
        {{-12.2f, 1.9f, 0.4f}, {0.0f, 2.6f, 0.0f}},
        {{-8.0f, 1.8f, -0.6f}, {2.0f, 2.6f, -1.0f}},
        {{-4.5f, 1.7f, -2.0f}, {5.0f, 2.4f, -2.0f}},
        {{0.0f, 1.8f, -3.4f}, {8.0f, 2.4f, -1.0f}},
        {{4.2f, 1.9f, -1.6f}, {12.0f, 2.4f, 2.0f}},
        {{8.0f, 1.9f, 0.2f}, {14.0f, 2.2f, 4.0f}},
        {{11.2f, 1.8f, 1.5f}, {13.0f, 2.0f, 9.0f}},
        {{12.1f, 1.8f, 4.4f}, {11.0f, 2.0f, 12.0f}},
        {{12.0f, 1.8f, 6.5f}, {6.0f, 2.0f, 9.6f}},
        {{10.6f, 1.8f, 8.2f}, {2.0f, 2.0f, 8.6f}},
        {{6.5f, 1.8f, 8.3f}, {-2.0f, 2.2f, 8.0f}},
        {{2.4f, 1.8f, 8.2f}, {-4.0f, 2.0f, 5.0f}},
        {{0.1f, 1.9f, 6.4f}, {-5.0f, 2.4f, 0.0f}},
        {{-1.2f, 2.3f, 4.7f}, {-8.0f, 4.0f, -2.0f}},
        {{-4.4f, 4.4f, 2.8f}, {-12.0f, 6.2f, -1.0f}},
        {{-8.8f, 6.4f, 0.2f}, {-14.0f, 7.6f, -4.0f}},
        {{-11.2f, 7.6f, -2.4f}, {-9.0f, 7.6f, -9.0f}},
        {{-11.0f, 7.9f, -6.0f}, {-4.0f, 7.7f, -8.6f}},
        {{-7.0f, 7.7f, -8.0f}, {1.0f, 7.6f, -8.0f}},
        {{-1.0f, 7.7f, -8.0f}, {4.0f, 6.6f, -4.0f}},
        {{1.0f, 7.8f, -6.0f}, {3.0f, 4.6f, 3.0f}},
        {{1.0f, 6.6f, -1.6f}, {-8.0f, 3.4f, 3.0f}},
        {{-5.0f, 4.2f, -0.8f}, {-10.0f, 2.2f, 6.0f}},
        {{-10.4f, 2.3f, -0.4f}, {-6.0f, 2.2f, 7.0f}},
    }};
    return fly_through(kTour, true);
}

} // namespace

Scene make_atrium(const SceneParams& params) {
    Scene scene;
    const std::uint32_t seed = fold_seed(params.seed);
    const Palette p = paint_atrium(scene, seed);
    MeshBuilder b("atrium");
    build_shell(b, p);
    build_ground_arcade(b, p);
    build_upper_arcade(b, p);
    build_roof(b, p);
    build_furniture(b, p);
    build_cloth(b, p, Random(params.seed, 1));
    build_plants(b, p, Random(params.seed, 2));
    scene.meshes.push_back(b.take());
    light(scene);
    scene.cameras.push_back({"court", {-8.3f, 2.2f, 1.3f}, {4.0f, 3.5f, -1.4f}, {0, 1, 0}, 68.0f});
    scene.path = tour();
    return scene;
}

} // namespace macula::scene::procedural
