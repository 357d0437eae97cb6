// Tunnel_maps of Weier et al. 2016, section 4.2.1: a smooth tunnel textured with a checkerboard map
// and a noise texture.
#include <vector>

#include "scenes/procedural/builtin.hpp"
#include "scenes/procedural/kit.hpp"
#include "scenes/procedural/random.hpp"
#include "scenes/procedural/textures.hpp"
#include "scenes/procedural/tunnel.hpp"

namespace macula::scene::procedural {
namespace {

constexpr int kSections = 12;   // along the loop
constexpr int kQuarters = 4;    // around the tunnel
constexpr int kCellsAlong = 40; // of a section
constexpr int kCellsAround = 24;
constexpr float kRibTube = 0.22f;

std::uint32_t add_checkerboard(Scene& scene) {
    const std::uint32_t texture = add_texture(scene, "checkerboard", {512, 512}, [](glm::vec2 uv) {
        const glm::vec2 cell = glm::floor(uv * 8.0f);
        const bool odd = (static_cast<int>(cell.x) + static_cast<int>(cell.y)) % 2 != 0;
        return Texel{odd ? glm::vec3{0.95f} : glm::vec3{0.04f}};
    });
    return add_material(scene, "checkerboard", Maps{texture, kNoTexture}, 0.1f, 24.0f);
}

std::uint32_t add_noise(Scene& scene, std::uint32_t seed) {
    const std::uint32_t texture = add_texture(scene, "noise", {512, 512}, [seed](glm::vec2 uv) {
        const float coarse = 0.5f + 0.5f * tiled_fractal(uv, 8, 6, seed);
        const float fine = 0.5f + 0.5f * tiled_noise(uv, 96, seed + 50);
        return Texel{
            glm::vec3{glm::clamp(1.5f * (0.75f * coarse + 0.25f * fine) - 0.25f, 0.0f, 1.0f)}};
    });
    return add_material(scene, "noise", Maps{texture, kNoTexture}, 0.1f, 24.0f);
}

// A quarter of the wall of one section, seen from inside.
void wall(MeshBuilder& b, int section, int quarter, std::uint32_t material) {
    const auto point = [&](float s, float t) {
        const TunnelFrame frame = tunnel_frame((static_cast<float>(section) + t) / kSections);
        // Quarters meet at the diagonals: floor, wall, roof, wall.
        const glm::vec2 cs = sin_cos_turns((static_cast<float>(quarter) + s) / kQuarters + 0.125f);
        return frame.centre + kTunnelRadius * (frame.right * cs.x + frame.up * cs.y);
    };
    const auto uv = [&](float s, float t) {
        return glm::vec2{1.0f * (static_cast<float>(quarter) + s),
                         2.0f * (static_cast<float>(section) + t)};
    };
    surface(b, {kCellsAround, kCellsAlong}, point, uv, material);
}

// A ring that hides the seam between two sections.
void rib(MeshBuilder& b, int section, std::uint32_t material) {
    const TunnelFrame frame = tunnel_frame(static_cast<float>(section) / kSections);
    std::vector<glm::vec2> circle;
    for (int i = 0; i <= 12; ++i)
        circle.push_back(kRibTube * sin_cos_turns(static_cast<float>(i % 12) / 12.0f));
    std::vector<Station> stations;
    for (int i = 0; i <= 96; ++i) {
        const glm::vec2 cs = sin_cos_turns(static_cast<float>(i % 96) / 96.0f);
        const glm::vec3 out = frame.right * cs.x + frame.up * cs.y;
        stations.push_back({frame.centre + kTunnelRadius * out, out, frame.forward});
    }
    sweep(b, circle, stations, {material, 1.0f});
}

} // namespace

Scene make_tunnel_maps(const SceneParams& params) {
    Scene scene;
    const std::uint32_t maps[2] = {add_checkerboard(scene),
                                   add_noise(scene, fold_seed(params.seed))};
    const std::uint32_t metal = add_material(scene, "rib", rgb(0x8a6a3c));
    scene.materials[metal].specular = glm::vec3{0.4f};
    MeshBuilder b("tunnel");
    for (int section = 0; section < kSections; ++section) {
        for (int quarter = 0; quarter < kQuarters; ++quarter)
            wall(b, section, quarter, maps[(section + quarter) % 2]);
        rib(b, section, metal);
    }
    scene.meshes.push_back(b.take());
    furnish_tunnel(scene, 0.8f);
    return scene;
}

} // namespace macula::scene::procedural
