// Every scene of ../shared/scenes against what its README says of it.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <ostream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "scenes/load.hpp"
#include "tests/support/sanitized.hpp"

namespace macula::scene {
namespace {

struct Expected {
    const char* file;
    std::uint64_t triangles;
    std::size_t materials, textures; // a default material where the file has none
    glm::vec3 lo, hi;
    float tolerance; // the bounds are given rounded
};

void PrintTo(const Expected& scene, std::ostream* out) {
    *out << scene.file;
}

// Textures are those that Phong materials use: no occlusion or metallic-roughness maps. The bounds
// of the balloon follow from its two node matrices.
const Expected kScenes[] = {
    {"sponza_crytek/sponza.obj",
     262267,
     25,
     27,
     {-1920, -126.4f, -1182.5f},
     {1798.8f, 1428.8f, 1105},
     0.06f},
    {"sponza_dabrovic/sponza.obj",
     66454,
     1,
     0,
     {-17.40f, -0.91f, -7.80f},
     {17.42f, 15.65f, 7.80f},
     0.006f},
    {"sibenik/sibenik.obj",
     75284,
     15,
     5,
     {-20.14f, -15.31f, -8.50f},
     {20.14f, 15.30f, 8.50f},
     0.006f},
    {"bunny/bunny_5k.obj",
     4968,
     1,
     0,
     {-0.095f, 0.033f, -0.062f},
     {0.061f, 0.187f, 0.059f},
     0.0011f},
    {"bunny/bunny_69k.obj",
     69451,
     1,
     0,
     {-0.095f, 0.033f, -0.062f},
     {0.061f, 0.187f, 0.059f},
     0.0011f},
    {"cornell_box/CornellBox-Original.obj",
     36,
     8,
     0,
     {-1.02f, 0, -1.04f},
     {1.00f, 1.99f, 0.99f},
     0.006f},
    {"cornell_box/CornellBox-Mirror.obj",
     36,
     8,
     0,
     {-1.02f, 0, -1.04f},
     {1.00f, 1.99f, 0.99f},
     0.006f},
    {"cornell_box/CornellBox-Empty-CO.obj",
     12,
     8,
     0,
     {-1.02f, 0, -1.04f},
     {1.00f, 1.99f, 0.99f},
     0.006f},
    {"cornell_box/CornellBox-Empty-RG.obj",
     12,
     6,
     0,
     {-1.02f, 0, -1.04f},
     {1.00f, 1.99f, 0.99f},
     0.006f},
    {"cornell_box/CornellBox-Empty-White.obj",
     12,
     6,
     0,
     {-1.02f, 0, -1.04f},
     {1.00f, 1.99f, 0.99f},
     0.006f},
    {"cornell_box/CornellBox-Empty-Squashed.obj",
     12,
     7,
     0,
     {-1.02f, 0, -1.04f},
     {1.00f, 1.59f, 0.99f},
     0.006f},
    {"cornell_box/CornellBox-Glossy.obj",
     1112,
     8,
     0,
     {-1.02f, 0, -1.04f},
     {1.00f, 1.59f, 0.99f},
     0.006f},
    {"cornell_box/CornellBox-Glossy-Floor.obj",
     1112,
     8,
     0,
     {-1.02f, 0, -1.04f},
     {1.00f, 1.59f, 0.99f},
     0.006f},
    {"cornell_box/CornellBox-Sphere.obj",
     2188,
     8,
     0,
     {-1.02f, 0, -1.04f},
     {1.00f, 1.59f, 0.99f},
     0.006f},
    {"cornell_box/CornellBox-Water.obj",
     7088,
     9,
     0,
     {-1.02f, 0, -1.04f},
     {1.00f, 1.59f, 0.99f},
     0.006f},
    {"cornell_box/water.obj", 4900, 1, 0, {-1.00f, 0, -1.02f}, {1.00f, 0.25f, 0.99f}, 0.006f},
    {"living_room/living_room.obj",
     28656,
     41,
     16,
     {-4.39f, -1.98f, -0.03f},
     {4.94f, 5.18f, 9.67f},
     0.006f},
    {"minecraft_overworld/overworld.obj.zst", 3711136, 99, 0, {0, 0, 0}, {656, 256, 752}, 0.0f},
    {"bistro_plaza/bistro_plaza.gltf",
     506317,
     60,
     52,
     {-57.9f, -5.3f, -85.4f},
     {30.4f, 25.7f, 36.0f},
     0.06f},
    {"gltf_small/FlightHelmet/FlightHelmet.gltf",
     94722,
     6,
     10,
     {-0.20f, 0.00f, -0.17f},
     {0.16f, 0.72f, 0.20f},
     0.006f},
    {"gltf_small/balloon/scene.gltf",
     35698,
     37,
     18,
     {-0.1414f, 0.2134f, -0.2860f},
     {0.4384f, 0.9081f, 0.2918f},
     0.0001f},
    {"gltf_small/smallpine/scene.gltf",
     1650,
     2,
     3,
     {-29.2f, 0.0f, -29.1f},
     {29.1f, 75.0f, 28.2f},
     0.06f},
    {"gltf_small/living_room_flat.glb", 5088, 7, 0, {-5, -1.5f, -2.5f}, {5, 4, 12}, 0.001f},
};

// A sanitizer build loads no larger scenes and none with textures: the small ones, and the tests of
// images, run the same code.
constexpr std::uint64_t kMostSanitizedTriangles = 8000;

std::filesystem::path path_of(const std::string& file) {
    return std::filesystem::path(MACULA_SHARED_DIR) / "scenes" / file;
}

// Why `file`, one of kScenes, can't be loaded here; empty where it can.
std::string reason_to_skip(const std::string& file) {
    if (!std::filesystem::exists(path_of(file)))
        return "no " + path_of(file).string();
    const auto scene = std::find_if(std::begin(kScenes), std::end(kScenes),
                                    [&](const Expected& each) { return each.file == file; });
    if (scene == std::end(kScenes))
        throw std::invalid_argument(file + " is not one of kScenes");
    if (test::kSanitized && (scene->triangles > kMostSanitizedTriangles || scene->textures > 0))
        return test::too_long_sanitized(file);
    return {};
}

class SharedScene : public testing::TestWithParam<Expected> {};

void expect_near(const glm::vec3& actual, const glm::vec3& expected, float tolerance) {
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(actual[axis], expected[axis], tolerance) << "axis " << axis;
}

TEST_P(SharedScene, HasWhatItsReadmeSays) {
    const Expected& expected = GetParam();
    if (const std::string reason = reason_to_skip(expected.file); !reason.empty())
        GTEST_SKIP() << reason;
    const Scene scene = load(path_of(expected.file).string());
    EXPECT_EQ(scene.triangle_count(), expected.triangles);
    EXPECT_EQ(scene.materials.size(), expected.materials);
    EXPECT_EQ(scene.textures.size(), expected.textures);
    expect_near(scene.bounds().lo, expected.lo, expected.tolerance);
    expect_near(scene.bounds().hi, expected.hi, expected.tolerance);
    ASSERT_FALSE(scene.cameras.empty());
    ASSERT_FALSE(scene.lights.empty());
    for (const std::string& warning : scene.warnings)
        EXPECT_EQ(warning.find("stand-in"), std::string::npos) << warning;
}

INSTANTIATE_TEST_SUITE_P(All, SharedScene, testing::ValuesIn(kScenes), [](const auto& test) {
    std::string name = std::filesystem::path(test.param.file).string();
    for (char& c : name)
        c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return name;
});

Scene load_shared(const char* file) {
    return load(path_of(file).string());
}

const Material* find(const Scene& scene, const std::string& name) {
    for (const Material& material : scene.materials)
        if (material.name == name)
            return &material;
    return nullptr;
}

bool warns(const Scene& scene, const std::string& part) {
    for (const std::string& warning : scene.warnings)
        if (warning.find(part) != std::string::npos)
            return true;
    return false;
}

TEST(SharedSceneTraps, CrytekSponzaHasThreeMaskedMaterialsAndCollapsedTriangles) {
    if (const std::string reason = reason_to_skip("sponza_crytek/sponza.obj"); !reason.empty())
        GTEST_SKIP() << reason;
    const Scene scene = load_shared("sponza_crytek/sponza.obj");
    std::size_t masked = 0;
    for (const Material& material : scene.materials)
        masked += material.alpha_mode == AlphaMode::mask;
    EXPECT_EQ(masked, 3u);
    for (const char* name : {"leaf", "Material__57", "chain"}) {
        const Material* material = find(scene, name);
        ASSERT_NE(material, nullptr) << name;
        EXPECT_EQ(material->alpha_mode, AlphaMode::mask);
        ASSERT_NE(material->alpha_texture, kNoTexture);
        const MipLevel& mask = scene.textures[material->alpha_texture].levels[0];
        std::size_t solid = 0;
        for (std::size_t i = 0; i < mask.rgba.size(); i += 4)
            solid += mask.rgba[i] >= 128;
        EXPECT_GT(solid, 0u) << name;
        EXPECT_LT(solid, mask.rgba.size() / 4) << name;
    }
    EXPECT_EQ(find(scene, "Material__47")->diffuse_texture, kNoTexture);
    EXPECT_TRUE(warns(scene, "425 triangles have no area"));
}

TEST(SharedSceneTraps, LivingRoomBlendsOneMaterialAndGlowsWithAnother) {
    if (const std::string reason = reason_to_skip("living_room/living_room.obj"); !reason.empty())
        GTEST_SKIP() << reason;
    const Scene scene = load_shared("living_room/living_room.obj");
    std::size_t blended = 0;
    for (const Material& material : scene.materials)
        blended += material.alpha_mode == AlphaMode::blend;
    EXPECT_EQ(blended, 1u);
    EXPECT_FLOAT_EQ(find(scene, "BackLight")->emission.r, 1.6f);
}

TEST(SharedSceneTraps, SibenikHasNoNormalsBumpMapsAndGlass) {
    if (const std::string reason = reason_to_skip("sibenik/sibenik.obj"); !reason.empty())
        GTEST_SKIP() << reason;
    const Scene scene = load_shared("sibenik/sibenik.obj");
    EXPECT_TRUE(scene.meshes[0].normals.empty());
    EXPECT_FLOAT_EQ(find(scene, "staklo")->opacity, 0.1f);
    EXPECT_FLOAT_EQ(find(scene, "staklo_crveno")->opacity, 0.8f);
    EXPECT_NE(find(scene, "kamen_zid")->normal_texture, kNoTexture);
    EXPECT_FALSE(scene.textures[find(scene, "kamen_zid")->normal_texture].srgb);
}

TEST(SharedSceneTraps, GlossyCornellBoxLacksItsLightMaterial) {
    if (const std::string reason = reason_to_skip("cornell_box/CornellBox-Glossy.obj");
        !reason.empty())
        GTEST_SKIP() << reason;
    EXPECT_TRUE(warns(load_shared("cornell_box/CornellBox-Glossy.obj"), "'light' is not defined"));
}

TEST(SharedSceneTraps, OriginalCornellBoxIsLitByItsCeilingLamp) {
    if (const std::string reason = reason_to_skip("cornell_box/CornellBox-Original.obj");
        !reason.empty())
        GTEST_SKIP() << reason;
    const Scene scene = load_shared("cornell_box/CornellBox-Original.obj");
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::rectangle);
    EXPECT_NEAR(scene.lights[0].position.y, 1.98f, 0.01f);
    EXPECT_LT(glm::cross(scene.lights[0].edge_u, scene.lights[0].edge_v).y, 0.0f);
}

TEST(SharedSceneTraps, NeedlesOfThePineBlend) {
    if (const std::string reason = reason_to_skip("gltf_small/smallpine/scene.gltf");
        !reason.empty())
        GTEST_SKIP() << reason;
    const Material* needles = nullptr;
    const Scene scene = load_shared("gltf_small/smallpine/scene.gltf");
    for (const Material& material : scene.materials)
        if (material.alpha_mode == AlphaMode::blend)
            needles = &material;
    ASSERT_NE(needles, nullptr);
    EXPECT_TRUE(scene.textures[needles->diffuse_texture].has_alpha);
}

TEST(SharedSceneTraps, MaterialsWhoseTexturesBistroLacksHaveNothingToMask) {
    if (const std::string reason = reason_to_skip("bistro_plaza/bistro_plaza.gltf");
        !reason.empty())
        GTEST_SKIP() << reason;
    const Scene scene = load_shared("bistro_plaza/bistro_plaza.gltf");
    for (const char* name : {"Forge_Metal", "Curtains", "Foliage_Hedges", "HangingLight"})
        for (const Material& material : scene.materials)
            if (material.name == name) {
                EXPECT_NE(material.alpha_mode, AlphaMode::mask) << name;
            }
}

} // namespace
} // namespace macula::scene
