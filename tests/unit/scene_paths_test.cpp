// The fly-throughs of the scene files: whole, smooth, in free space and through no surface.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bvh/reference.hpp"
#include "scenes/camera_path.hpp"
#include "scenes/load.hpp"
#include "scenes/occupancy.hpp"
#include "tests/support/bvh_scenes.hpp"
#include "tests/support/sanitized.hpp"

namespace macula::scene {
namespace {

namespace fs = std::filesystem;

// Beyond, building a tree takes too long for a test of everyday.
constexpr std::uint64_t kMaxTriangles = 1'000'000;

// All that fly: the views of `bench thesis` and of what physics moves stand still.
std::vector<std::string> scene_files() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(fs::path(MACULA_SOURCE_DIR) / "scenes/files")) {
        const std::string name = entry.path().stem().string();
        if (!name.starts_with("thesis_") && !name.ends_with("_spheres"))
            names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

struct Triangles {
    std::vector<float> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

Triangles gather(const Scene& scene) {
    Triangles all;
    for (const Instance& instance : scene.instances) {
        const auto first = static_cast<std::uint32_t>(all.positions.size() / 3);
        for (const glm::vec3& p : scene.meshes[instance.mesh].positions) {
            const glm::vec3 world = instance.world_from_object.apply(p);
            all.positions.insert(all.positions.end(), {world.x, world.y, world.z});
        }
        for (const glm::uvec3& t : scene.meshes[instance.mesh].triangles)
            all.triangles.push_back({first + t.x, first + t.y, first + t.z});
    }
    return all;
}

void crosses_no_surface(const Scene& scene) {
    const Triangles all = gather(scene);
    bvh::BuildOptions options;
    options.spatial_splits = false;
    const bvh::test::OneMesh mesh({all.positions, all.triangles, {}}, options);
    for (std::uint32_t frame = 0; frame < scene.path.frames; ++frame) {
        const glm::vec3 a = view_at(scene.path, static_cast<float>(frame)).eye;
        const glm::vec3 b = view_at(scene.path, static_cast<float>(frame + 1)).eye;
        if (a == b)
            continue;
        const bvh::Ray step = bvh::test::ray_between({a.x, a.y, a.z}, {b.x, b.y, b.z}, 1.0f);
        EXPECT_EQ(mesh.by_tree(step).triangle, MACULA_NO_TRIANGLE)
            << "between frames " << frame << " and " << frame + 1;
    }
}

// In voxels: the path that macula makes for a scene without one is found by them.
void stays_in_free_space(const Scene& scene) {
    const Occupancy grid(scene, 256);
    glm::vec3 before = scene.path.keys.front().eye;
    for (int frame = 1; frame < 1000; ++frame) {
        const glm::vec3 eye = view_at(scene.path, static_cast<float>(frame)).eye;
        ASSERT_FALSE(grid.solid(eye)) << "frame " << frame;
        const float step = glm::distance(before, eye);
        EXPECT_LT(step, 0.02f * grid.bounds().diagonal()) << "frame " << frame;
        if (step > 0.0f) {
            EXPECT_FALSE(grid.cast(before, (eye - before) / step, step).hit) << frame;
        }
        before = eye;
    }
    for (const Camera& camera : scene.cameras)
        EXPECT_FALSE(grid.solid(camera.eye)) << camera.name;
}

void turns_smoothly(const Scene& scene) {
    glm::vec3 last(0.0f);
    for (int frame = 0; frame <= 1000; ++frame) {
        const CameraView view = view_at(scene.path, static_cast<float>(frame));
        ASSERT_GT(glm::distance(view.eye, view.target), 0.0f) << "frame " << frame;
        const glm::vec3 direction = glm::normalize(view.target - view.eye);
        ASSERT_LT(std::fabs(direction.y), 0.98f) << "frame " << frame;
        // 8 degrees a frame would be a jolt.
        ASSERT_TRUE(frame == 0 || glm::dot(direction, last) > 0.99f) << "frame " << frame;
        last = direction;
    }
}

class ScenePath : public testing::TestWithParam<std::string> {};

TEST_P(ScenePath, IsWholeSmoothAndClear) {
    if (test::kSanitized && GetParam() != "cornell_box")
        GTEST_SKIP() << test::too_long_sanitized("the path of " + GetParam());
    const fs::path shared = fs::path(MACULA_SHARED_DIR) / "scenes";
    if (!fs::is_directory(shared))
        GTEST_SKIP() << shared << " is not here";
    LoadOptions options;
    options.search_path = {shared};
    options.textures = false;
    const Scene scene = load(
        (fs::path(MACULA_SOURCE_DIR) / "scenes/files" / (GetParam() + ".toml")).string(), options);
    EXPECT_EQ(scene.path.frames, 1000u);
    ASSERT_GE(scene.path.keys.size(), 2u);
    EXPECT_EQ(scene.path.keys.front().frame, 0.0f);
    EXPECT_GE(scene.path.keys.back().frame, 999.0f);
    turns_smoothly(scene);
    stays_in_free_space(scene);
    if (scene.triangle_count() <= kMaxTriangles)
        crosses_no_surface(scene);
}

INSTANTIATE_TEST_SUITE_P(Files, ScenePath, testing::ValuesIn(scene_files()),
                         [](const auto& tested) { return tested.param; });

} // namespace
} // namespace macula::scene
