// The fly-throughs of the scene files: whole, smooth, and through no surface.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bvh/reference.hpp"
#include "scenes/camera_path.hpp"
#include "scenes/load.hpp"
#include "tests/support/bvh_scenes.hpp"

namespace macula::scene {
namespace {

namespace fs = std::filesystem;

// Beyond, building a tree takes too long for a test of everyday.
constexpr std::uint64_t kMaxTriangles = 1'000'000;

std::vector<std::string> scene_files() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(fs::path(MACULA_SOURCE_DIR) / "scenes/files"))
        names.push_back(entry.path().stem().string());
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

class ScenePath : public testing::TestWithParam<std::string> {};

TEST_P(ScenePath, IsWholeSmoothAndClear) {
    const fs::path shared = fs::path(MACULA_SHARED_DIR) / "scenes";
    if (!fs::is_directory(shared))
        GTEST_SKIP() << shared << " is not here";
    LoadOptions options;
    options.search_path = {shared};
    options.textures = false;
    const Scene scene = load(
        (fs::path(MACULA_SOURCE_DIR) / "scenes/files" / (GetParam() + ".toml")).string(), options);
    ASSERT_FALSE(scene.path.keys.empty());
    EXPECT_EQ(scene.path.frames, 1000u);
    EXPECT_EQ(scene.path.keys.front().frame, 0.0f);
    EXPECT_GE(scene.path.keys.back().frame, 999.0f);
    glm::vec3 last(0.0f);
    for (int frame = 0; frame <= 1000; ++frame) {
        const CameraView view = view_at(scene.path, static_cast<float>(frame));
        const glm::vec3 direction = glm::normalize(view.target - view.eye);
        ASSERT_LT(std::fabs(direction.y), 0.98f) << "frame " << frame;
        // 8 degrees a frame would be a jolt.
        ASSERT_TRUE(frame == 0 || glm::dot(direction, last) > 0.99f) << "frame " << frame;
        last = direction;
    }
    if (scene.triangle_count() <= kMaxTriangles)
        crosses_no_surface(scene);
}

INSTANTIATE_TEST_SUITE_P(Files, ScenePath, testing::ValuesIn(scene_files()),
                         [](const auto& tested) { return tested.param; });

} // namespace
} // namespace macula::scene
