// What every built-in scene must be: valid, deterministic, fully textured and lit, of its size.
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "scenes/procedural/registry.hpp"
#include "tests/support/sanitized.hpp"

namespace macula::scene::procedural {
namespace {

// voxel_city in a size fit for tests.
SceneParams params_for(const std::string& name, std::uint64_t seed = 1) {
    return {seed, name == "voxel_city" ? 64u : 0u};
}

class Fingerprint {
  public:
    void add(std::uint32_t word) { hash_ = (hash_ ^ word) * 0x100000001b3ull; }
    void add(float value) { add(std::bit_cast<std::uint32_t>(value)); }
    void add(glm::vec3 v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    std::uint64_t value() const { return hash_; }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

void add_mesh(Fingerprint& print, const Mesh& mesh) {
    for (const glm::vec3& p : mesh.positions)
        print.add(p);
    for (const glm::vec3& n : mesh.normals)
        print.add(n);
    for (const glm::vec2& uv : mesh.uvs) {
        print.add(uv.x);
        print.add(uv.y);
    }
    for (const glm::uvec3& t : mesh.triangles) {
        print.add(t.x);
        print.add(t.y);
        print.add(t.z);
    }
    for (const std::uint32_t material : mesh.triangle_material)
        print.add(material);
}

std::uint64_t fingerprint(const Scene& scene) {
    Fingerprint print;
    for (const Mesh& mesh : scene.meshes)
        add_mesh(print, mesh);
    for (const Texture& texture : scene.textures)
        for (const MipLevel& level : texture.levels)
            for (const std::uint8_t byte : level.rgba)
                print.add(static_cast<std::uint32_t>(byte));
    for (const CameraKey& key : scene.path.keys) {
        print.add(key.eye);
        print.add(key.target);
    }
    for (const Instance& instance : scene.instances)
        for (const glm::vec4& row : instance.world_from_object.row) {
            print.add(glm::vec3(row));
            print.add(row.w);
        }
    return print.value();
}

bool is_finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void indices_are_in_range_and_arrays_agree(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        EXPECT_EQ(mesh.triangle_material.size(), mesh.triangles.size());
        EXPECT_TRUE(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
        EXPECT_TRUE(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size());
        std::size_t bad = 0;
        for (const glm::uvec3& t : mesh.triangles)
            bad += std::max(t.x, std::max(t.y, t.z)) >= mesh.positions.size() ? 1 : 0;
        for (const std::uint32_t material : mesh.triangle_material)
            bad += material >= scene.materials.size() ? 1 : 0;
        EXPECT_EQ(bad, 0u) << mesh.name;
    }
    for (const Instance& instance : scene.instances)
        EXPECT_LT(instance.mesh, scene.meshes.size());
}

void numbers_are_finite_and_normals_have_unit_length(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        std::size_t bad_positions = 0, bad_normals = 0, bad_uvs = 0;
        for (const glm::vec3& p : mesh.positions)
            bad_positions += is_finite(p) ? 0 : 1;
        for (const glm::vec3& n : mesh.normals)
            bad_normals += std::fabs(glm::length(n) - 1.0f) < 1e-4f ? 0 : 1;
        for (const glm::vec2& uv : mesh.uvs)
            bad_uvs += std::isfinite(uv.x) && std::isfinite(uv.y) ? 0 : 1;
        EXPECT_EQ(bad_positions, 0u);
        EXPECT_EQ(bad_normals, 0u);
        EXPECT_EQ(bad_uvs, 0u);
    }
}

void no_triangle_is_degenerate(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        std::size_t degenerate = 0;
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::vec3 a = mesh.positions[t.x];
            const glm::vec3 n = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
            degenerate += glm::dot(n, n) > 0.0f ? 0 : 1;
        }
        EXPECT_EQ(degenerate, 0u) << mesh.name;
    }
}

void front_faces_agree_with_normals(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.normals.empty())
            continue;
        std::size_t against = 0;
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::vec3 a = mesh.positions[t.x];
            const glm::vec3 n = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
            const glm::vec3 sum = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
            against += glm::dot(n, sum) < 0.0f ? 1 : 0;
        }
        // Tightly curled leaves and displaced rock may fold over in places.
        EXPECT_LE(against, mesh.triangles.size() / 200) << mesh.name;
    }
}

void textures_have_complete_mip_chains(const Scene& scene) {
    for (const Texture& texture : scene.textures) {
        ASSERT_FALSE(texture.levels.empty()) << texture.name;
        std::uint32_t width = texture.levels[0].width, height = texture.levels[0].height;
        for (const MipLevel& level : texture.levels) {
            EXPECT_EQ(level.width, width) << texture.name;
            EXPECT_EQ(level.height, height) << texture.name;
            EXPECT_EQ(level.rgba.size(), std::size_t{width} * height * 4) << texture.name;
            width = std::max(1u, width / 2);
            height = std::max(1u, height / 2);
        }
        EXPECT_EQ(texture.levels.back().width, 1u);
        EXPECT_EQ(texture.levels.back().height, 1u);
    }
}

void materials_are_sound(const Scene& scene) {
    ASSERT_FALSE(scene.materials.empty());
    const auto known = [&](std::uint32_t texture) {
        return texture == kNoTexture || texture < scene.textures.size();
    };
    for (const Material& m : scene.materials) {
        EXPECT_FALSE(m.name.empty());
        EXPECT_TRUE(known(m.diffuse_texture) && known(m.alpha_texture) &&
                    known(m.specular_texture) && known(m.normal_texture) &&
                    known(m.emission_texture))
            << m.name;
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(m.diffuse[c], 0.0f) << m.name;
            EXPECT_LE(m.diffuse[c], 1.0f) << m.name;
        }
        EXPECT_GT(m.shininess, 0.0f) << m.name;
        const bool cut_out =
            m.alpha_texture != kNoTexture ||
            (m.diffuse_texture != kNoTexture && scene.textures[m.diffuse_texture].has_alpha);
        EXPECT_TRUE(cut_out || m.alpha_mode != AlphaMode::mask) << m.name;
    }
}

void textured_meshes_have_texture_coordinates(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes)
        for (const std::uint32_t material : mesh.triangle_material)
            if (scene.materials[material].diffuse_texture != kNoTexture) {
                EXPECT_FALSE(mesh.uvs.empty()) << mesh.name;
                break;
            }
}

void has_light_camera_path_and_placed_meshes(const Scene& scene) {
    EXPECT_FALSE(scene.lights.empty());
    EXPECT_FALSE(scene.cameras.empty());
    EXPECT_FALSE(scene.instances.empty());
    EXPECT_EQ(scene.path.frames, 1000u);
    ASSERT_GE(scene.path.keys.size(), 2u);
    for (std::size_t i = 1; i < scene.path.keys.size(); ++i)
        EXPECT_GT(scene.path.keys[i].frame, scene.path.keys[i - 1].frame);
    EXPECT_FLOAT_EQ(scene.path.keys.front().frame, 0.0f);
    EXPECT_GE(scene.path.keys.back().frame, 999.0f);
}

struct Case {
    std::string name;
    double triangles, tolerance; // of the model that it stands for
};

void PrintTo(const Case& tested, std::ostream* out) {
    *out << tested.name;
}

class ProceduralScene : public testing::TestWithParam<Case> {};

TEST_P(ProceduralScene, SameSeedGivesSameBytesAndAnotherSeedDiffers) {
    const std::string name = GetParam().name;
    if (test::kSanitized && (name == "atrium" || name == "city"))
        GTEST_SKIP() << test::too_long_sanitized("making " + name + " three times");
    const Scene scene = *make(name, params_for(name));
    const std::uint64_t first = fingerprint(scene);
    EXPECT_EQ(fingerprint(*make(name, params_for(name))), first);
    // These have nothing random in them.
    const bool constant = name == "cornell" || name == "cornell_spheres" || name == "whitted";
    EXPECT_EQ(fingerprint(*make(name, params_for(name, 2))) == first, constant);
}

// One test, since each test is a process of its own and would make the scene again.
TEST_P(ProceduralScene, IsWhole) {
    const Scene scene = *make(GetParam().name, params_for(GetParam().name));
    EXPECT_EQ(scene.name, GetParam().name);
    EXPECT_NEAR(static_cast<double>(scene.triangle_count()), GetParam().triangles,
                GetParam().tolerance);
    indices_are_in_range_and_arrays_agree(scene);
    numbers_are_finite_and_normals_have_unit_length(scene);
    no_triangle_is_degenerate(scene);
    front_faces_agree_with_normals(scene);
    textures_have_complete_mip_chains(scene);
    materials_are_sound(scene);
    textured_meshes_have_texture_coordinates(scene);
    has_light_camera_path_and_placed_meshes(scene);
}

INSTANTIATE_TEST_SUITE_P(
    All, ProceduralScene,
    testing::Values(Case{"atrium", 250e3, 25e3}, Case{"city", 770e3, 20e3},
                    Case{"voxel_city", 47e3, 5e3}, Case{"cornell", 38, 0},
                    Case{"cornell_spheres", 32e3, 1e3}, Case{"whitted", 73e3, 1e3},
                    Case{"whitted_moving", 109e3, 1e3}, Case{"tunnel_geometry", 280e3, 5e3},
                    Case{"tunnel_maps", 120e3, 2e3}, Case{"spheres", 53e3, 1e3}),
    [](const auto& tested) { return tested.param.name; });

TEST(ProceduralRegistry, NamesAreThoseThatAreTested) {
    EXPECT_EQ(names(), (std::vector<std::string_view>{
                           "atrium", "voxel_city", "city", "cornell", "cornell_spheres", "whitted",
                           "whitted_moving", "tunnel_geometry", "tunnel_maps", "spheres"}));
}

TEST(ProceduralRegistry, UnknownNameGivesNothing) {
    EXPECT_FALSE(make("no_such_scene").has_value());
    EXPECT_FALSE(make("").has_value());
}

TEST(ProceduralRegistry, CitysCarsAreInstancesOfSharedMeshes) {
    const Scene scene = *make("city");
    std::map<std::uint32_t, std::size_t> uses;
    for (const Instance& instance : scene.instances)
        ++uses[instance.mesh];
    EXPECT_EQ(uses[0], 1u);
    EXPECT_EQ(uses.size(), scene.meshes.size());
    EXPECT_GT(scene.instances.size(), 10 * scene.meshes.size());
}

TEST(ProceduralRegistry, AtriumHasMaskedFoliageAndChains) {
    const Scene scene = *make("atrium");
    std::map<std::string, std::size_t> masked;
    for (const std::uint32_t material : scene.meshes.at(0).triangle_material)
        if (scene.materials[material].alpha_mode == AlphaMode::mask)
            ++masked[scene.materials[material].name];
    EXPECT_GT(masked["ivy"], 1000u);
    EXPECT_GT(masked["frond"], 1000u);
    EXPECT_GT(masked["leaf_spray"], 1000u);
    EXPECT_GT(masked["chain"], 10u);
}

} // namespace
} // namespace macula::scene::procedural
