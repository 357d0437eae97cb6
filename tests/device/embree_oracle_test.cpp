// Embree as an independent oracle: hit or no hit, t within 1e-4 relative, the same triangle save
// for true ties (bench/judge.hpp says what a tie is, and what rounding may explain).
#include <filesystem>
#include <random>
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

// Random triangles, each mesh placed many times under rotations, uneven scales, shears and a
// mirror, one mesh with a checkerboard mask, over a floor that is placed once.
bench::Case placed_meshes() {
    std::mt19937 generator(5);
    const auto uniform = [&](float lo, float hi) {
        return lo + (hi - lo) * static_cast<float>(generator() >> 8) * 0x1p-24f;
    };
    bench::Case made;
    made.name = "placed";
    scene::Scene& s = made.scene;
    s.materials.resize(2);
    s.textures.push_back({});
    s.textures[0].has_alpha = true;
    s.textures[0].levels.push_back({8, 8, {}});
    for (int i = 0; i < 64; ++i) {
        const auto alpha = static_cast<std::uint8_t>((i + i / 8) % 2 == 0 ? 255 : 0);
        s.textures[0].levels[0].rgba.insert(s.textures[0].levels[0].rgba.end(),
                                            {200, 200, 200, alpha});
    }
    s.materials[1].alpha_mode = scene::AlphaMode::mask;
    s.materials[1].diffuse_texture = 0;
    for (std::uint32_t m = 0; m < 2; ++m) {
        scene::Mesh mesh;
        for (std::uint32_t i = 0; i < 200; ++i) {
            const glm::vec3 centre(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            for (int corner = 0; corner < 3; ++corner) {
                mesh.positions.push_back(
                    centre + 0.3f * glm::vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
                mesh.uvs.emplace_back(uniform(-2, 2), uniform(-2, 2));
            }
            mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
            mesh.triangle_material.push_back(m);
        }
        s.meshes.push_back(mesh);
        for (int i = 0; i < 20; ++i) {
            scene::Instance instance;
            instance.mesh = m;
            for (int row = 0; row < 3; ++row) {
                glm::vec4 r(uniform(-0.5f, 0.5f), uniform(-0.5f, 0.5f), uniform(-0.5f, 0.5f),
                            uniform(-5.0f, 5.0f));
                r[row] += i == 0 ? -1.5f : 1.5f;
                instance.world_from_object.row[row] = r;
            }
            s.instances.push_back(instance);
        }
    }
    scene::Mesh floor;
    floor.positions = {{-9, -6, -9}, {9, -6, -9}, {9, -6, 9}, {-9, -6, 9}};
    floor.uvs.resize(4);
    floor.triangles = {{0, 1, 2}, {0, 2, 3}};
    floor.triangle_material = {0, 0};
    s.meshes.push_back(floor);
    s.instances.push_back({2, {}, "floor"});
    made.bounds = s.bounds();
    made.camera = bench::pinhole({4, 3, 14}, {0, 0, 0}, {0, 1, 0}, 50.0f, 1.0f);
    made.light = {3, 12, 5};
    return made;
}

class EmbreeOracleOfInstances : public EmbreeOracle {};

TEST_F(EmbreeOracleOfInstances, AgreesUnderAffineTransformsAndMasks) {
    check(placed_meshes());
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
