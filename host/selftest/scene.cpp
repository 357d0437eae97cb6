#include "host/selftest/scene.hpp"

#include <cmath>

namespace macula::selftest {
namespace {

constexpr std::uint32_t kGrid = 24;

// Deterministic floats in [0, 1).
class Hash {
  public:
    explicit Hash(std::uint32_t seed) : state_(seed) {}
    float next() {
        state_ = state_ * 1664525u + 1013904223u;
        return static_cast<float>(state_ >> 8) * 0x1p-24f;
    }

  private:
    std::uint32_t state_;
};

scene::Mesh make_height_field() {
    scene::Mesh mesh;
    mesh.name = "height field";
    Hash hash(1);
    for (std::uint32_t z = 0; z <= kGrid; ++z) {
        for (std::uint32_t x = 0; x <= kGrid; ++x)
            mesh.positions.emplace_back(static_cast<float>(x) - 12.0f, hash.next() * 2.0f,
                                        static_cast<float>(z) - 12.0f);
    }
    for (std::uint32_t z = 0; z < kGrid; ++z) {
        for (std::uint32_t x = 0; x < kGrid; ++x) {
            const std::uint32_t a = z * (kGrid + 1) + x, b = a + 1, c = a + kGrid + 1, d = c + 1;
            mesh.triangles.emplace_back(a, c, b);
            mesh.triangles.emplace_back(b, c, d);
        }
    }
    mesh.triangle_material.assign(mesh.triangles.size(), 0);
    return mesh;
}

scene::Mesh make_leaves() {
    scene::Mesh mesh;
    mesh.name = "leaves";
    Hash hash(2);
    for (std::uint32_t card = 0; card < 60; ++card) {
        const glm::vec3 at{hash.next() * 8.0f - 4.0f, hash.next() * 3.0f,
                           hash.next() * 8.0f - 4.0f};
        const glm::vec3 u{hash.next(), hash.next() - 0.5f, hash.next()};
        const glm::vec3 v{-hash.next(), hash.next() + 0.5f, hash.next() - 0.5f};
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& corner : {at, at + u, at + v, at + u + v})
            mesh.positions.push_back(corner);
        for (const glm::vec2 uv :
             {glm::vec2(0, 0), glm::vec2(2, 0), glm::vec2(0, 2), glm::vec2(2, 2)})
            mesh.uvs.push_back(uv);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
        mesh.triangles.emplace_back(first + 2, first + 1, first + 3);
    }
    mesh.triangle_material.assign(mesh.triangles.size(), 1);
    return mesh;
}

// 8 x 8 texels, transparent where a hash says so.
scene::Texture make_leaf_texture() {
    scene::Texture texture;
    texture.name = "leaf";
    texture.has_alpha = true;
    Hash hash(3);
    for (std::uint32_t size = 8; size > 0; size /= 2) {
        scene::MipLevel level{size, size, {}};
        for (std::uint32_t i = 0; i < size * size; ++i) {
            const std::uint8_t alpha = hash.next() < 0.5f ? 0 : 255;
            level.rgba.insert(level.rgba.end(), {60, 140, 40, alpha});
        }
        texture.levels.push_back(std::move(level));
    }
    return texture;
}

// Rotation by `angle` radians around y, scaled, then moved.
scene::Transform placed(float angle, float scale, glm::vec3 at) {
    const float c = std::cos(angle) * scale, s = std::sin(angle) * scale;
    scene::Transform transform;
    transform.row[0] = {c, 0, s, at.x};
    transform.row[1] = {0, scale, 0, at.y};
    transform.row[2] = {-s, 0, c, at.z};
    return transform;
}

} // namespace

scene::Scene make_scene() {
    scene::Scene scene;
    scene.name = "self-test";
    scene.materials.resize(2);
    scene.materials[1].alpha_mode = scene::AlphaMode::mask;
    scene.materials[1].diffuse_texture = 0;
    scene.textures.push_back(make_leaf_texture());
    scene.meshes = {make_height_field(), make_leaves()};
    scene.instances = {{0, {}, "ground"},
                       {0, placed(0.6f, 0.5f, {3.0f, 2.0f, -2.0f}), "island"},
                       {1, placed(0.0f, 1.0f, {-4.0f, 2.0f, 3.0f}), "bush"},
                       {1, placed(2.1f, 1.7f, {4.0f, 1.0f, 4.0f}), "tree"}};
    return scene;
}

std::vector<bvh::Ray> coherent_rays() {
    std::vector<bvh::Ray> rays;
    for (std::uint32_t i = 0; i < 1600; ++i) {
        const std::uint32_t tile = i / 16, lane = i % 16;
        const float x = static_cast<float>(tile % 10 * 4 + lane % 4) / 40.0f - 0.5f;
        const float y = static_cast<float>(tile / 10 * 4 + lane / 4) / 40.0f - 0.5f;
        rays.push_back({{-9.0f, 10.0f, -14.0f}, {0.5f + x, -0.65f - y, 0.8f}, 0.0f, 1e30f});
    }
    return rays;
}

std::vector<bvh::Ray> incoherent_rays() {
    std::vector<bvh::Ray> rays;
    Hash hash(4);
    const auto point = [&hash] {
        return glm::vec3(hash.next() * 24 - 12, hash.next() * 8 - 1, hash.next() * 24 - 12);
    };
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const glm::vec3 from = point();
        glm::vec3 along = point() - from;
        if (i % 8 == 0)
            along = {i % 16 ? 0.0f : 1.0f, i % 16 ? -1.0f : 0.0f, 0.0f};
        const float t_max = i % 50 == 7 ? -1.0f : (i % 3 ? 1.0f : 1e30f);
        rays.push_back({{from.x, from.y, from.z}, {along.x, along.y, along.z}, 0.0f, t_max});
    }
    return rays;
}

} // namespace macula::selftest
