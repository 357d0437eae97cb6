// The voxel city: its surface is exactly the boundary between blocks and air.
#include <cstdint>
#include <map>
#include <stdexcept>
#include <tuple>

#include <gtest/gtest.h>

#include "scenes/procedural/registry.hpp"
#include "scenes/procedural/voxel.hpp"

namespace macula::scene::procedural {
namespace {

TEST(VoxelSurface, LoneBlockHasSixFacesAndEightSharedVertices) {
    VoxelGrid grid(4, 4);
    grid.set(1, 1, 1, Block::rock);
    const Mesh mesh = voxel_surface(grid);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_EQ(mesh.positions.size(), 8u);
    float volume = 0.0f; // divergence theorem: all faces look outwards
    for (const glm::uvec3& t : mesh.triangles)
        volume +=
            glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z])) /
            6.0f;
    EXPECT_FLOAT_EQ(volume, 1.0f);
}

TEST(VoxelSurface, FaceBetweenTwoBlocksIsNotBuilt) {
    VoxelGrid grid(4, 4);
    grid.set(1, 1, 1, Block::rock);
    grid.set(2, 1, 1, Block::glass);
    const Mesh mesh = voxel_surface(grid);
    EXPECT_EQ(mesh.triangles.size(), 20u);
    EXPECT_EQ(mesh.positions.size(), 12u);
}

TEST(VoxelSurface, FloorOfTheGridIsLeftOut) {
    VoxelGrid grid(2, 2);
    grid.fill({0, 0, 0}, {1, 1, 1}, Block::dirt);
    EXPECT_EQ(voxel_surface(grid).triangles.size(), 2u * (4u + 4u * 4u));
}

TEST(VoxelSurface, BlocksOutsideTheGridAreIgnored) {
    VoxelGrid grid(2, 2);
    grid.set(-1, 0, 0, Block::dirt);
    grid.set(0, 2, 0, Block::dirt);
    grid.fill({-5, 3, -5}, {9, 9, 9}, Block::dirt);
    EXPECT_TRUE(voxel_surface(grid).triangles.empty());
    EXPECT_EQ(grid.top(5, 5), 0);
}

// Without holes: each edge of the surface is used by as many triangles one way as the other, but
// for the rim of the missing floor.
TEST(VoxelCity, SurfaceIsClosedAboveTheFloor) {
    const Scene scene = *make("voxel_city", {1, 48});
    const Mesh& mesh = scene.meshes.at(0);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    for (const auto& [edge, sum] : balance) {
        const bool on_floor =
            mesh.positions[edge.first].y == 0.0f && mesh.positions[edge.second].y == 0.0f;
        EXPECT_TRUE(sum == 0 || on_floor);
    }
}

TEST(VoxelCity, GrowsWithItsSize) {
    const auto triangles = [](std::uint32_t size) {
        return make("voxel_city", {1, size})->triangle_count();
    };
    const auto small = triangles(64), large = triangles(256);
    EXPECT_GT(small, 30'000u);
    EXPECT_GT(large, 12 * small);
}

TEST(VoxelCity, DefaultSizeIsRungholts) {
    const Scene scene = *make("voxel_city");
    EXPECT_NEAR(static_cast<double>(scene.triangle_count()), 6.7e6, 0.1e6);
    EXPECT_LT(scene.meshes.at(0).positions.size(), 4'000'000u);
}

TEST(VoxelCity, AbsurdSizesAreRefusedWithTheRange) {
    for (const std::uint32_t size : {1u, 31u, 2049u, 4'000'000'000u}) {
        try {
            make("voxel_city", {1, size});
            FAIL() << size;
        } catch (const std::invalid_argument& error) {
            EXPECT_NE(std::string(error.what()).find(std::to_string(size)), std::string::npos);
            EXPECT_NE(std::string(error.what()).find("2048"), std::string::npos);
        }
    }
}

} // namespace
} // namespace macula::scene::procedural
