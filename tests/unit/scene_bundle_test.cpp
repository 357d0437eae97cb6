// The scene files of scenes/files: each loads, and its camera path stays in free space.
#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "scenes/camera_path.hpp"
#include "scenes/load.hpp"
#include "scenes/occupancy.hpp"

namespace macula::scene {
namespace {

std::vector<std::string> bundled() {
    std::vector<std::string> names;
    const auto folder = std::filesystem::path(MACULA_SOURCE_DIR) / "scenes/files";
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

class Bundled : public testing::TestWithParam<std::string> {};

TEST_P(Bundled, FliesThroughFreeSpaceForAThousandFrames) {
    const auto shared = std::filesystem::path(MACULA_SHARED_DIR) / "scenes";
    if (!std::filesystem::exists(shared))
        GTEST_SKIP() << "no " << shared;
    LoadOptions options;
    options.search_path = {shared};
    options.textures = false;
    const Scene scene =
        load((std::filesystem::path(MACULA_SOURCE_DIR) / "scenes/files" / (GetParam() + ".toml"))
                 .string(),
             options);
    EXPECT_EQ(scene.path.frames, 1000u);
    ASSERT_GE(scene.path.keys.size(), 2u);
    EXPECT_EQ(scene.path.keys.front().frame, 0.0f);
    EXPECT_GE(scene.path.keys.back().frame, 999.0f);
    const Occupancy grid(scene, 256);
    glm::vec3 before = scene.path.keys.front().eye;
    for (int frame = 1; frame < 1000; ++frame) {
        const auto view = view_at(scene.path, static_cast<float>(frame));
        ASSERT_FALSE(grid.solid(view.eye)) << "frame " << frame;
        const float step = glm::distance(before, view.eye);
        EXPECT_LT(step, 0.02f * grid.bounds().diagonal()) << "frame " << frame;
        if (step > 0.0f) {
            EXPECT_FALSE(grid.cast(before, (view.eye - before) / step, step).hit) << frame;
        }
        EXPECT_GT(glm::distance(view.eye, view.target), 0.0f);
        before = view.eye;
    }
    for (const Camera& camera : scene.cameras)
        EXPECT_FALSE(grid.solid(camera.eye)) << camera.name;
}

INSTANTIATE_TEST_SUITE_P(Files, Bundled, testing::ValuesIn(bundled()),
                         [](const auto& test) { return test.param; });

} // namespace
} // namespace macula::scene
