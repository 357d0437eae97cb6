// The tree finds what brute force finds, bit for bit.
#include <gtest/gtest.h>

#include "tests/support/bvh_scenes.hpp"

namespace macula::bvh::test {
namespace {

// Returns how many rays hit.
int expect_agreement(const OneMesh& mesh, const std::vector<Ray>& rays) {
    int hits = 0, mismatches = 0;
    for (const Ray& ray : rays) {
        const shared::TraceHit tree = mesh.by_tree(ray), brute = mesh.by_brute_force(ray);
        hits += brute.triangle != MACULA_NO_TRIANGLE ? 1 : 0;
        mismatches += same_bits(tree, brute) ? 0 : 1;
        EXPECT_EQ(occluded(ray, mesh.scene()), brute.triangle != MACULA_NO_TRIANGLE);
    }
    EXPECT_EQ(mismatches, 0);
    return hits;
}

std::vector<Ray> random_rays(int count, std::uint32_t seed) {
    Random random(seed);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i)
        rays.push_back(random_ray(random));
    return rays;
}

TEST(BvhReference, RandomSoup) {
    const Soup soup = random_soup(3000, 0.1f, 1);
    EXPECT_GT(expect_agreement(OneMesh(soup.geometry()), random_rays(5000, 2)), 2000);
}

TEST(BvhReference, Needles) {
    const Soup soup = needles(2000, 3);
    EXPECT_GT(expect_agreement(OneMesh(soup.geometry()), random_rays(5000, 4)), 2000);
}

TEST(BvhReference, SingleTriangle) {
    Soup soup;
    soup.add({-1, -1, 0, 1, -1, 0, 0, 1, 0});
    EXPECT_GT(expect_agreement(OneMesh(soup.geometry()), random_rays(1000, 5)), 100);
}

TEST(BvhReference, EmptyMesh) {
    EXPECT_EQ(expect_agreement(OneMesh(Geometry{}), random_rays(10, 6)), 0);
}

} // namespace
} // namespace macula::bvh::test
