// The judge of the benchmark must excuse what rounding does, and nothing else.
#include <gtest/gtest.h>

#ifdef MACULA_WITH_BENCH
#include "bench/judge.hpp"

namespace {
using namespace macula;
using bench::TestHit;
using bench::TestRay;
using bench::Verdict;

// Two triangles share the edge x = y of the unit square in z = 0; a third covers the first at the
// same place, a fourth lies behind it at z = -1.
scene::Scene two_layers() {
    scene::Scene s;
    s.materials.resize(1);
    scene::Mesh mesh;
    mesh.positions = {{0, 0, 0},  {1, 0, 0},  {1, 1, 0}, {0, 1, 0},
                      {0, 0, -1}, {1, 0, -1}, {1, 1, -1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {4, 5, 6}};
    mesh.triangle_material.assign(4, 0);
    s.meshes.push_back(mesh);
    s.instances.push_back({});
    return s;
}

TestRay down(double x, double y) {
    return {{x, y, 1}, {0, 0, -1}, 0.0, 1e30};
}
TestHit hit(double t, std::uint32_t triangle) {
    return {t, bench::Surface{0, 0, triangle}};
}
const TestHit miss{1e30, std::nullopt};

class JudgeTest : public testing::Test {
  protected:
    scene::Scene scene_ = two_layers();
    bench::Judge judge_{scene_};
};

TEST_F(JudgeTest, TheSameTriangleAtTheSameTIsTheSame) {
    EXPECT_EQ(judge_.closest(down(0.7, 0.2), hit(1.0, 0), hit(1.00009, 0)), Verdict::same);
    EXPECT_EQ(judge_.closest(down(5, 5), miss, miss), Verdict::same);
}

TEST_F(JudgeTest, TheSameTriangleAtAnotherTIsAMismatch) {
    EXPECT_EQ(judge_.closest(down(0.7, 0.2), hit(1.0, 0), hit(1.0003, 0)), Verdict::mismatch);
}

TEST_F(JudgeTest, CoincidentTrianglesTie) {
    EXPECT_EQ(judge_.closest(down(0.7, 0.2), hit(1.0, 0), hit(1.0, 2)), Verdict::tie);
}

TEST_F(JudgeTest, NeighboursTieOnTheirSharedEdgeOnly) {
    EXPECT_EQ(judge_.closest(down(0.5, 0.5), hit(1.0, 0), hit(1.0, 1)), Verdict::tie);
    EXPECT_EQ(judge_.closest(down(0.5, 0.4999), hit(1.0, 0), hit(1.0, 1)), Verdict::mismatch);
}

TEST_F(JudgeTest, ATriangleThatIsNotThereTiesWithNothing) {
    EXPECT_EQ(judge_.closest(down(0.7, 0.2), hit(1.0, 0), hit(1.0, 3)), Verdict::mismatch);
}

TEST_F(JudgeTest, MissingTheInsideOfATriangleIsAMismatch) {
    EXPECT_EQ(judge_.closest(down(0.7, 0.2), miss, hit(1.0, 0)), Verdict::mismatch);
    EXPECT_EQ(judge_.closest(down(0.7, 0.2), hit(1.0, 0), miss), Verdict::mismatch);
    EXPECT_EQ(judge_.closest(down(0.7, 0.2), hit(2.0, 3), hit(1.0, 0)), Verdict::mismatch);
}

TEST_F(JudgeTest, LeavingATriangleThroughItsEdgeIsRounding) {
    EXPECT_EQ(judge_.closest(down(1.0, 0.2), hit(1.0, 0), miss), Verdict::rounding);
    EXPECT_EQ(judge_.closest(down(1.0 - 1e-5, 0.2), hit(1.0, 0), miss), Verdict::mismatch);
}

TEST_F(JudgeTest, AHitAtTheRaysEndIsRounding) {
    TestRay ray = down(0.7, 0.2);
    ray.t_max = 1.0 + 1e-7;
    EXPECT_EQ(judge_.closest(ray, hit(1.0, 0), miss), Verdict::rounding);
    ray.t_max = 1.1;
    EXPECT_EQ(judge_.closest(ray, hit(1.0, 0), miss), Verdict::mismatch);
}

TEST_F(JudgeTest, ARayInThePlaneOfATriangleIsRounding) {
    const TestRay ray{{-1, 0.2, 0}, {1, 0, 0}, 0.0, 1e30};
    EXPECT_EQ(judge_.closest(ray, miss, hit(1.5, 0)), Verdict::rounding);
}

TEST_F(JudgeTest, ATexelsBorderIsRoundingAndItsMiddleIsNot) {
    scene::Texture texture;
    texture.levels.push_back({2, 1, {0, 0, 0, 255, 0, 0, 0, 0}});
    texture.has_alpha = true;
    scene_.textures.push_back(texture);
    scene_.materials[0].alpha_mode = scene::AlphaMode::mask;
    scene_.materials[0].diffuse_texture = 0;
    scene::Mesh& mesh = scene_.meshes[0];
    for (const glm::vec3& p : mesh.positions)
        mesh.uvs.emplace_back(p.x, p.y + 0.5f);
    const bench::Judge judge(scene_);
    EXPECT_EQ(judge.closest(down(0.5, 0.2), hit(1.0, 0), miss), Verdict::rounding);
    EXPECT_EQ(judge.closest(down(0.7, 0.2), hit(1.0, 0), miss), Verdict::mismatch);
}

} // namespace
#else
TEST(Judge, NeedsTheBenchmarks) {
    GTEST_SKIP() << "built without MACULA_BUILD_BENCH";
}
#endif
