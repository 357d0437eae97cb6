// Tunnel_geom of Weier et al. 2016, section 4.2.1: a tunnel of noisy, displaced geometry; with the
// point of view it shows hard edges or smooth, continuous surfaces.
#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/procedural/builtin.hpp"
#include "scenes/procedural/kit.hpp"
#include "scenes/procedural/random.hpp"
#include "scenes/procedural/textures.hpp"
#include "scenes/procedural/tunnel.hpp"

namespace macula::scene::procedural {
namespace {

constexpr int kAround = 144, kAlong = 960;
constexpr int kCrystals = 260;

// Where the rock is broken (1) and where water has worn it smooth (0).
float brokenness(glm::vec3 p, std::uint32_t seed) {
    return smooth_step(-0.08f, 0.12f, fractal_noise(p * 0.11f, 2, seed + 90));
}

// The wall's distance from the centre line in units of the tunnel's radius.
float wall_radius(glm::vec3 p, std::uint32_t seed) {
    const float broad = fractal_noise(p * 0.28f, 3, seed);
    const float rough = brokenness(p, seed);
    // Worn rock: folds like flowstone. Broken rock: steps of a warped noise.
    const float folds = 0.10f * std::fabs(noise(p * glm::vec3{0.7f, 0.25f, 0.7f}, seed + 20)) +
                        0.02f * fractal_noise(p * 2.5f, 2, seed + 30);
    const float crest = ridged_noise(p * 0.45f, 4, seed + 40);
    const float steps = 9.0f * crest + 0.8f * noise(p * 1.7f, seed + 50);
    const float edge = std::floor(steps) + smooth_step(0.7f, 1.0f, steps - std::floor(steps));
    return 1.06f + 0.2f * broad + glm::mix(folds, 0.36f - 0.055f * edge, rough);
}

glm::vec3 wall_point(int i, int j, std::uint32_t seed) {
    const TunnelFrame frame = tunnel_frame(static_cast<float>(j % kAlong) / kAlong);
    const glm::vec2 cs = sin_cos_turns(static_cast<float>(i % kAround) / kAround);
    const glm::vec3 out = frame.right * cs.x + frame.up * cs.y;
    return frame.centre + out * (kTunnelRadius * wall_radius(frame.centre + 3.0f * out, seed));
}

std::vector<glm::vec3> wall_points(std::uint32_t seed) {
    std::vector<glm::vec3> points;
    points.reserve((kAround + 1) * (kAlong + 1));
    for (int j = 0; j <= kAlong; ++j)
        for (int i = 0; i <= kAround; ++i)
            points.push_back(wall_point(i, j, seed));
    return points;
}

// Smooth where worn; facets with their own normals where broken.
void wall(MeshBuilder& b, std::span<const std::uint32_t> rock, std::uint32_t seed) {
    const std::vector<glm::vec3> points = wall_points(seed);
    MeshBuilder smooth("normals");
    const std::vector<glm::vec2> no_uvs(points.size());
    surface(smooth, {kAround + 1, kAlong + 1, true, true}, points, no_uvs, 0);
    const std::vector<glm::vec3>& normals = smooth.mesh().normals;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const auto i = static_cast<int>(k % (kAround + 1)), j = static_cast<int>(k / (kAround + 1));
        b.vertex(points[k], normals[k],
                 {static_cast<float>(i) * 6.0f / kAround, static_cast<float>(j) * 36.0f / kAlong});
    }
    for (std::uint32_t j = 0; j < kAlong; ++j)
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const std::uint32_t a = j * (kAround + 1) + i, d = a + kAround + 1;
            const glm::vec3 p = points[a];
            const float rough = brokenness(p, seed);
            const std::uint32_t material = rock[rough > 0.5f ? 1 : 0];
            if (rough <= 0.5f) {
                b.quad(a, a + 1, d + 1, d, material);
                continue;
            }
            const auto facet = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
                const glm::vec3 corners[3] = {points[x], points[y], points[z]};
                const glm::vec2 uvs[3] = {b.mesh().uvs[x], b.mesh().uvs[y], b.mesh().uvs[z]};
                b.card(corners, uvs, material);
            };
            facet(a, a + 1, d + 1);
            facet(a, d + 1, d);
        }
}

// A six-sided prism with a point, growing out of the rock.
void crystal(MeshBuilder& b, glm::vec3 root, glm::vec3 axis, float length, float radius,
             std::uint32_t material) {
    b.place = along(root, axis);
    std::vector<glm::vec3> low, high;
    for (int i = 0; i < 6; ++i) {
        const glm::vec2 cs = radius * sin_cos_turns(static_cast<float>(i) / 6.0f);
        low.emplace_back(cs.x, -0.6f * length, -cs.y);
        high.emplace_back(0.9f * cs.x, 0.75f * length, -0.9f * cs.y);
    }
    const glm::vec3 tip{0.2f * radius, length, 0.1f * radius};
    for (std::size_t i = 0; i < 6; ++i) {
        const std::size_t k = (i + 1) % 6;
        b.face({low[i], low[k], high[k], high[i]}, {material, 1.0f});
        b.face({high[i], high[k], tip}, {material, 1.0f});
    }
    b.place = {};
}

void crystals(MeshBuilder& b, std::span<const std::uint32_t> materials, std::uint64_t seed) {
    Random random(seed, 1);
    for (int cluster = 0; cluster < kCrystals / 5; ++cluster) {
        const int j = random.between(0, kAlong - 1);
        // On the floor and the walls; the roof's middle is left to the lamps.
        const int i = (kAround / 2 + random.between(-kAround / 8, kAround * 5 / 8)) % kAround;
        const glm::vec3 root = wall_point(i, j, fold_seed(seed));
        const glm::vec3 inward =
            glm::normalize(tunnel_frame(static_cast<float>(j) / kAlong).centre - root);
        const std::uint32_t material =
            materials[random.below(static_cast<std::uint32_t>(materials.size()))];
        for (int k = 0; k < 5; ++k) {
            glm::vec3 lean;
            lean.x = random.symmetric(0.7f);
            lean.y = random.symmetric(0.7f);
            lean.z = random.symmetric(0.7f);
            const float length = random.range(0.3f, 1.1f);
            crystal(b, root + 0.12f * lean, glm::normalize(inward + lean), length,
                    length * random.range(0.1f, 0.2f), material);
        }
    }
}

std::uint32_t add_rock(Scene& scene, const char* name, glm::vec3 dark, glm::vec3 light, float gloss,
                       std::uint32_t seed) {
    const Maps maps = add_maps(scene, name, {512, 512}, 0.02f, [=](glm::vec2 uv) {
        const float warp = 0.06f * tiled_fractal(uv, 4, 3, seed + 9);
        const float layer = 0.5f + 0.5f * tiled_fractal(uv + warp, 6, 5, seed);
        const float grain = tiled_fractal(uv, 40, 3, seed + 17);
        return Texel{glm::mix(dark, light, layer) * (1.0f + 0.18f * grain),
                     0.6f * layer + 0.4f * grain};
    });
    return add_material(scene, name, maps, gloss, 40.0f);
}

std::uint32_t add_crystal(Scene& scene, const char* name, glm::vec3 colour) {
    const std::uint32_t index = add_material(scene, name, colour);
    scene.materials[index].specular = glm::vec3{0.55f};
    scene.materials[index].shininess = 90.0f;
    scene.materials[index].emission = 0.12f * scene.materials[index].diffuse;
    return index;
}

} // namespace

Scene make_tunnel_geometry(const SceneParams& params) {
    const std::uint32_t seed = fold_seed(params.seed);
    Scene scene;
    const std::uint32_t rock[2] = {
        add_rock(scene, "worn_rock", rgb(0x86705a), rgb(0xcdb899), 0.12f, seed + 200),
        add_rock(scene, "broken_rock", rgb(0x6b5d50), rgb(0xb3a48f), 0.05f, seed + 300)};
    const std::uint32_t crystal_materials[3] = {add_crystal(scene, "amethyst", rgb(0xa46ad6)),
                                                add_crystal(scene, "citrine", rgb(0xe2a93a)),
                                                add_crystal(scene, "beryl", rgb(0x4fc0b4))};
    MeshBuilder b("tunnel");
    wall(b, rock, seed);
    crystals(b, crystal_materials, params.seed);
    scene.meshes.push_back(b.take());
    furnish_tunnel(scene, 0.35f);
    return scene;
}

} // namespace macula::scene::procedural
