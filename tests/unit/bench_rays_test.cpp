// The benchmark's rays against what is known of them.
#include <set>

#include <gtest/gtest.h>

#ifdef MACULA_WITH_BENCH
#include "bench/rays.hpp"

namespace {
using namespace macula;
using kernel::RayClass;

shared::Camera view() {
    return bench::pinhole({1, 2, 3}, {4, 2, -3}, {0, 1, 0}, 60.0f, 1.0f);
}

TEST(PixelOrder, VisitsEveryPixelOnceAlsoWhereTilesAreCut) {
    const auto order = bench::pixel_order(75, 37);
    std::set<std::pair<unsigned, unsigned>> seen;
    for (const glm::uvec2 p : order) {
        EXPECT_LT(p.x, 75U);
        EXPECT_LT(p.y, 37U);
        seen.emplace(p.x, p.y);
    }
    EXPECT_EQ(order.size(), 75U * 37U);
    EXPECT_EQ(seen.size(), order.size());
}

TEST(PixelOrder, SixteenInARowAreAPacketAndAThousandATile) {
    const auto order = bench::pixel_order(64, 64);
    for (std::size_t i = 0; i < order.size(); ++i) {
        EXPECT_EQ(order[i] / 4U, order[i / 16 * 16] / 4U);
        EXPECT_EQ(order[i] / 32U, order[i / 1024 * 1024] / 32U);
    }
    // Morton: the second packet lies to the right, the third below the first.
    EXPECT_EQ(order[16], glm::uvec2(4, 0));
    EXPECT_EQ(order[32], glm::uvec2(0, 4));
}

TEST(PrimaryRays, CornersLookAlongTheTangents) {
    const shared::Camera camera = view();
    const auto rays = bench::primary_rays(camera, 512);
    EXPECT_EQ(rays.count, 512U * 512U);
    const glm::vec3 forward(camera.forward[0], camera.forward[1], camera.forward[2]);
    const glm::vec3 up(camera.up[0], camera.up[1], camera.up[2]);
    const glm::vec3 first = rays.direction(0);
    EXPECT_NEAR(glm::dot(first, up) / glm::dot(first, forward),
                camera.tan_up * (1.0f - 1.0f / 512.0f), 1e-5f);
    EXPECT_NEAR(glm::length(first), 1.0f, 1e-6f);
    EXPECT_EQ(rays.origin(7), glm::vec3(1, 2, 3));
}

TEST(SparseRays, SampleTheShareOfPixelsThatThePaperImplies) {
    const shared::Camera camera = bench::dk2_left(view());
    const double pixels = double{bench::kDk2Width} * bench::kDk2Height;
    const auto foveal =
        bench::sparse_rays(camera, bench::kDk2Width, bench::kDk2Height, 0, 0, {}, 1);
    const auto both =
        bench::sparse_rays(camera, bench::kDk2Width, bench::kDk2Height, 256, 318, {}, 1);
    EXPECT_NEAR(foveal.count / pixels, 0.089, 0.001);
    EXPECT_NEAR(both.count / pixels, 0.132, 0.001);
}

TEST(FovealProbability, IsOneInsideAndTheMinimumOutside) {
    const bench::FovealRegion region;
    EXPECT_EQ(bench::foveal_probability(region, 0.0f), 1.0f);
    EXPECT_EQ(bench::foveal_probability(region, 10.0f), 1.0f);
    EXPECT_FLOAT_EQ(bench::foveal_probability(region, 15.0f), 0.525f);
    EXPECT_EQ(bench::foveal_probability(region, 20.0f), 0.05f);
    EXPECT_EQ(bench::foveal_probability(region, 90.0f), 0.05f);
}

TEST(ShadowRays, EndBeforeTheLightAndSkipAPointInIt) {
    const bench::SurfacePoint points[] = {{{0, 0, 0}, {0, 1, 0}}, {{0, 3, 0}, {0, 1, 0}}};
    const auto rays = bench::shadow_rays(points, {0, 3, 0}, 0.0f);
    ASSERT_EQ(rays.count, 1U);
    EXPECT_EQ(rays.direction(0), glm::vec3(0, 1, 0));
    EXPECT_FLOAT_EQ(rays.t_max(0), 3.0f * 0.999f);
}

TEST(DiffuseRays, LeaveTheSurfaceWithAMeanCosineOfTwoThirds) {
    const glm::vec3 normal = glm::normalize(glm::vec3(1, -2, 3));
    const std::vector<bench::SurfacePoint> points(20000, {{1, 1, 1}, normal});
    const auto rays = bench::diffuse_rays(points, 10.0f, 3);
    double sum = 0.0;
    for (std::uint32_t i = 0; i < rays.count; ++i) {
        const float cosine = glm::dot(rays.direction(i), normal);
        EXPECT_GE(cosine, -1e-6f);
        sum += cosine;
    }
    EXPECT_NEAR(sum / rays.count, 2.0 / 3.0, 0.005);
}

TEST(RandomRays, AreTheSameForTheSameSeedOnly) {
    const scene::Bounds bounds{{-1, -2, -3}, {4, 5, 6}};
    const auto a = bench::random_rays(bounds, 1000, 1), b = bench::random_rays(bounds, 1000, 1),
               c = bench::random_rays(bounds, 1000, 2);
    EXPECT_EQ(a.direction(999), b.direction(999));
    EXPECT_NE(a.direction(999), c.direction(999));
    glm::vec3 mean(0.0f);
    for (std::uint32_t i = 0; i < a.count; ++i)
        mean += a.direction(i) / 1000.0f;
    EXPECT_LT(glm::length(mean), 0.1f);
}

TEST(RaySet, LanesBeyondTheCountAreInactive) {
    bench::RaySet rays;
    rays.append({1, 2, 3}, {0, 0, 1}, 0.5f, 9.0f);
    ASSERT_EQ(rays.blocks.size(), 1U);
    EXPECT_EQ(rays.t_min(0), 0.5f);
    EXPECT_EQ(rays.t_max(0), 9.0f);
    for (int lane = 1; lane < 16; ++lane)
        EXPECT_FALSE(0.0f <= rays.blocks[0].t_max[lane]);
}

} // namespace
#else
TEST(BenchRays, NeedTheBenchmarks) {
    GTEST_SKIP() << "built without MACULA_BUILD_BENCH";
}
#endif
