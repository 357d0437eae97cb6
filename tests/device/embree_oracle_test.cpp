// Embree as an independent oracle: hit or no hit, t within 1e-4 relative, the same triangle save
// for true ties (bench/judge.hpp says what a tie is, and what rounding may explain).
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#ifdef MACULA_WITH_BENCH
#include "bench/cases.hpp"
#include "bench/compare.hpp"

namespace {
using namespace macula;
using kernel::RayClass;

constexpr std::uint32_t kSize = 128; // primary rays are 128 x 128
// More explained disagreements than this would say that the explanation is too wide.
constexpr double kMostByRounding = 1e-3;

std::string shared_scene(const std::string& file) {
    return std::string(MACULA_SHARED_DIR) + "/scenes/" + file;
}

class EmbreeOracle : public testing::TestWithParam<std::string> {
  protected:
    void check(const bench::Case& scene_case) {
        compute::Device device = compute::open();
        frame::DeviceGeometry geometry(device, scene_case.scene);
        const bench::EmbreeScene embree(scene_case.scene, {0, true});
        bench::VariantRun reference(device, geometry, {&kernel::reference_variant(), {}});
        const bench::Comparison comparison(embree, device, geometry, reference);
        const bench::RayOptions options{kSize, 7};
        std::vector<bench::SurfacePoint> points;
        for (const RayClass ray_class : kernel::kRayClasses) {
            SCOPED_TRACE(kernel::name(ray_class));
            const bench::RaySet rays = make_rays(ray_class, scene_case, points, options);
            ASSERT_GT(rays.count, 0U);
            bench::DeviceRays device_rays(device, rays);
            device_rays.clear_results();
            reference.run(device_rays);
            bench::EmbreeRays embree_rays(embree, rays, bench::EmbreeCall::single);
            embree_rays.run();
            if (ray_class == RayClass::primary)
                points = surface_points(scene_case, rays, embree_rays);
            const bench::Agreement agreement =
                comparison.compare(rays, device_rays.results(), embree_rays);
            EXPECT_EQ(agreement.mismatches, 0U);
            EXPECT_LE(agreement.rounding, kMostByRounding * rays.count);
            EXPECT_EQ(agreement.same + agreement.ties + agreement.rounding, rays.count);
        }
    }
};

TEST_P(EmbreeOracle, AgreesOnEveryRayClass) {
    const std::string& name = GetParam();
    const bool is_file = name.find('/') != std::string::npos;
    if (is_file && !std::filesystem::exists(name))
        GTEST_SKIP() << name << " is not here";
    check(bench::open_case(name, {}));
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = std::filesystem::path(info.param).stem().string();
    for (char& c : name)
        c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    return name == "sponza" ? "sponza_dabrovic" : name;
}

INSTANTIATE_TEST_SUITE_P(Procedural, EmbreeOracle,
                         testing::Values("cornell", "whitted", "tunnel_geometry", "atrium"),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Shared, EmbreeOracle,
                         testing::Values(shared_scene("bunny/bunny_69k.obj"),
                                         shared_scene("sponza_dabrovic/sponza.obj"),
                                         shared_scene("cornell_box/CornellBox-Original.obj"),
                                         shared_scene("cornell_box/CornellBox-Sphere.obj"),
                                         shared_scene("cornell_box/CornellBox-Water.obj")),
                         test_name);

} // namespace
#else
TEST(EmbreeOracle, NeedsTheBenchmarks) {
    GTEST_SKIP() << "built without MACULA_BUILD_BENCH";
}
#endif
