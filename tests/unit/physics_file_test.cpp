// The [physics] table of scene files, and physics behind a Mover.
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "scenes/load.hpp"
#include "scenes/mover.hpp"

namespace macula::scene {
namespace {
namespace fs = std::filesystem;

constexpr Observer kObserver{{0.0f, 3.0f, 9.0f}, {0.0f, 0.0f, -1.0f}};

Scene load_text(const std::string& text) {
    const fs::path file = fs::path(testing::TempDir()) / "physics_file_test.toml";
    std::ofstream(file) << text;
    return load(file.string());
}

std::string message_of(const std::string& text) {
    try {
        load_text(text);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

const std::string kTable = "procedural = \"cornell\"\n[physics]\nradius = 10\n"
                           "start = [278, 400, 280]\n";

TEST(PhysicsFile, AddsGroundSpheresAndTheirMaterials) {
    const Scene room = load("cornell");
    const Scene scene = load_text(kTable + "spheres = 7\nground = -1\ngravity = [0, -300, 0]\n"
                                           "materials = [\"one\", \"two\"]\n"
                                           "[[material]]\nname = \"two\"\nreflectivity = 0.5\n");
    ASSERT_TRUE(scene.physics.has_value());
    EXPECT_EQ(scene.physics->spheres.size(), 7u);
    EXPECT_EQ(scene.physics->obstacles.size(), room.instances.size() + 1);
    EXPECT_EQ(scene.instances.size(), room.instances.size() + 8);
    EXPECT_EQ(scene.meshes.size(), room.meshes.size() + 3);
    EXPECT_EQ(scene.materials.back().name, "two");
    EXPECT_EQ(scene.materials.back().reflectivity, glm::vec3(0.5f));
}

TEST(PhysicsFile, AnotherScaleAndUpAxisCarryTheFallAlong) {
    constexpr std::uint32_t kFrame = 20;
    const Scene plain = load("spheres");
    const Scene doubled = load_text("procedural = \"spheres\"\nscale = 2\n");
    Mover small(plain), large(doubled);
    const auto from = small.at(kFrame, kObserver);
    const auto to = large.at(kFrame, {2.0f * kObserver.eye, kObserver.gaze});
    for (const std::uint32_t sphere : plain.physics->spheres) {
        const glm::vec3 expected = 2.0f * from[sphere].apply(glm::vec3(0.0f));
        EXPECT_LT(glm::distance(to[sphere].apply(glm::vec3(0.0f)), expected),
                  0.01f * doubled.physics->radius)
            << sphere;
    }
    const Scene turned = load_text("procedural = \"spheres\"\nup = \"z\"\n");
    const glm::vec3 g = plain.physics->gravity;
    EXPECT_EQ(turned.physics->gravity, glm::vec3(g.y, g.z, g.x));
}

TEST(PhysicsFile, MistakesNameTheirKey) {
    EXPECT_NE(message_of("procedural = \"cornell\"\n[physics]\nradius = 10\n").find("start"),
              std::string::npos);
    EXPECT_NE(message_of(kTable + "materials = [1]\n").find("materials"), std::string::npos);
    EXPECT_NE(message_of(kTable + "weight = 1\n").find("weight"), std::string::npos);
    EXPECT_NE(message_of(kTable + "ground_size = 1\n").find("ground_size"), std::string::npos);
    EXPECT_NE(message_of("procedural = \"spheres\"\n[physics]\nradius = 1\nstart = [0, 0, 0]\n")
                  .find("physics"),
              std::string::npos);
}

TEST(PhysicsFile, SpheresTooFastForTheirSizeAreAnError) {
    const Scene scene = load_text(kTable + "gravity = [0, -1e12, 0]\n");
    EXPECT_THROW(Mover mover(scene), SceneError);
}

TEST(PhysicsFile, AMoverStepsForwardAndStartsAnewForAnEarlierFrame) {
    const Scene scene = load("spheres");
    Mover mover(scene);
    const auto at = [&](std::uint32_t frame) {
        const std::span<const Transform> all = mover.at(frame, kObserver);
        return std::vector<Transform>(all.begin(), all.end());
    };
    const std::vector<Transform> start = at(0);
    for (std::size_t i = 0; i < start.size(); ++i)
        EXPECT_EQ(start[i], scene.instances[i].world_from_object);
    const std::vector<Transform> twenty = at(20);
    EXPECT_NE(twenty, start);
    EXPECT_EQ(at(20), twenty);
    EXPECT_NE(at(40), twenty);
    EXPECT_EQ(at(20), twenty);
    EXPECT_EQ(twenty[0], start[0]); // the ground stands still
}

} // namespace
} // namespace macula::scene
