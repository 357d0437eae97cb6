// What every scene passes: errors, mended values and the defaults that are added.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "scenes/load.hpp"
#include "scenes/validate.hpp"

namespace macula::scene {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Scene quad() {
    Scene scene;
    scene.name = "quad";
    Mesh mesh;
    mesh.name = "q";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.triangle_material = {0, 0};
    scene.meshes.push_back(mesh);
    scene.instances.push_back({0, {}, "i"});
    return scene;
}

std::string error_of(Scene scene) {
    try {
        validate(scene);
    } catch (const SceneError& error) {
        return error.what();
    }
    ADD_FAILURE() << "the scene was accepted";
    return {};
}

bool warns(const Scene& scene, const std::string& part) {
    for (const std::string& warning : scene.warnings)
        if (warning.find(part) != std::string::npos)
            return true;
    return false;
}

TEST(Validate, AddsMaterialLightAndCamera) {
    Scene scene = quad();
    validate(scene);
    EXPECT_EQ(scene.materials.size(), 1u);
    EXPECT_GE(scene.lights.size(), 1u);
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Validate, EmptyScenesAreErrors) {
    Scene scene;
    EXPECT_NE(error_of(scene).find("no triangles"), std::string::npos);
    scene = quad();
    scene.instances.clear();
    EXPECT_NE(error_of(scene).find("no triangles"), std::string::npos);
    scene = quad();
    scene.meshes[0].triangles.clear();
    scene.meshes[0].triangle_material.clear();
    EXPECT_NE(error_of(scene).find("no triangles"), std::string::npos);
}

TEST(Validate, IndicesOutOfRangeNameTheirPlace) {
    Scene scene = quad();
    scene.meshes[0].triangles[1].y = 4;
    EXPECT_NE(error_of(scene).find("mesh 0 'q', triangle 1, corner 1: vertex index 4"),
              std::string::npos);
    scene = quad();
    scene.meshes[0].triangle_material[1] = 1;
    EXPECT_NE(error_of(scene).find("triangle 1: material index 1"), std::string::npos);
    scene = quad();
    scene.instances[0].mesh = 1;
    EXPECT_NE(error_of(scene).find("instance 0 'i': mesh index 1"), std::string::npos);
    scene = quad();
    scene.materials.emplace_back();
    scene.materials[0].diffuse_texture = 0;
    EXPECT_NE(error_of(scene).find("texture index 0"), std::string::npos);
}

TEST(Validate, ArraysOfUnequalLengthAreErrors) {
    Scene scene = quad();
    scene.meshes[0].normals.resize(3);
    EXPECT_NE(error_of(scene).find("3 normals for 4 vertices"), std::string::npos);
    scene = quad();
    scene.meshes[0].uvs.resize(5);
    EXPECT_NE(error_of(scene).find("5 texture coordinates"), std::string::npos);
    scene = quad();
    scene.meshes[0].triangle_material.resize(1);
    EXPECT_NE(error_of(scene).find("1 material indices for 2"), std::string::npos);
}

TEST(Validate, NonFiniteAndHugeCoordinatesDropTriangles) {
    for (const float bad : {kNan, kInfinity, -kInfinity, 1e18f, -2e18f}) {
        Scene scene = quad();
        scene.meshes[0].positions[3].y = bad;
        validate(scene);
        EXPECT_EQ(scene.triangle_count(), 1u) << bad;
        EXPECT_TRUE(warns(scene, "1 triangles with coordinates"));
        for (const glm::vec3& p : scene.meshes[0].positions)
            EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
    }
}

TEST(Validate, DegenerateTrianglesAreCountedAndKept) {
    Scene scene = quad();
    scene.meshes[0].triangles.push_back({0, 0, 1});
    scene.meshes[0].triangle_material.push_back(0);
    validate(scene);
    EXPECT_EQ(scene.triangle_count(), 3u);
    EXPECT_TRUE(warns(scene, "1 triangles have no area"));
}

TEST(Validate, NormalsAreMended) {
    Scene scene = quad();
    scene.meshes[0].normals = {{0, 0, 5}, {0, 0, 0}, {kNan, 0, 0}, {0, 1, 0}};
    validate(scene);
    EXPECT_EQ(scene.meshes[0].normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(scene.meshes[0].normals[1], glm::vec3(0, 0, 1)); // the geometric one
    EXPECT_EQ(scene.meshes[0].normals[2], glm::vec3(0, 0, 1));
    EXPECT_EQ(scene.meshes[0].normals[3], glm::vec3(0, 1, 0));
    EXPECT_TRUE(warns(scene, "2 normals of no length"));
    EXPECT_TRUE(warns(scene, "1 normals were not of unit length"));
}

TEST(Validate, BadTextureCoordinatesBecomeZero) {
    Scene scene = quad();
    scene.meshes[0].uvs = {{0, 0}, {kNan, 0}, {0, 1e9f}, {-28, 32}};
    validate(scene);
    EXPECT_EQ(scene.meshes[0].uvs[1], glm::vec2(0));
    EXPECT_EQ(scene.meshes[0].uvs[2], glm::vec2(0));
    EXPECT_EQ(scene.meshes[0].uvs[3], glm::vec2(-28, 32));
    EXPECT_TRUE(warns(scene, "2 texture coordinates"));
}

TEST(Validate, SingularAndNonFiniteTransformsAreErrors) {
    Scene scene = quad();
    scene.instances[0].world_from_object.row[1] = {0, 0, 0, 0};
    EXPECT_NE(error_of(scene).find("singular"), std::string::npos);
    scene.instances[0].world_from_object.row[1] = {0, kNan, 0, 0};
    EXPECT_NE(error_of(scene).find("not finite"), std::string::npos);
    scene.instances[0].world_from_object = {};
    scene.instances[0].world_from_object.row[0].w = 9e17f;
    scene.meshes[0].positions[1].x = 9e17f;
    EXPECT_NE(error_of(scene).find("largest coordinate"), std::string::npos);
}

TEST(Validate, MaterialValuesOutOfRangeAreClamped) {
    Scene scene = quad();
    scene.materials.emplace_back();
    scene.materials[0].shininess = 0.0f;
    scene.materials[0].diffuse = {2, kNan, -1};
    scene.materials[0].emission = {kInfinity, 0, 0};
    validate(scene);
    EXPECT_FLOAT_EQ(scene.materials[0].shininess, 1.0f);
    EXPECT_EQ(scene.materials[0].diffuse, glm::vec3(1, 0, 0));
    EXPECT_TRUE(std::isfinite(scene.materials[0].emission.r));
    EXPECT_TRUE(warns(scene, "clamped"));
}

TEST(Validate, CamerasMustLookSomewhere) {
    Scene scene = quad();
    scene.cameras.push_back({"c", {0, 0, 1}, {0, 0, 1}, {0, 1, 0}, 60});
    EXPECT_NE(error_of(scene).find("same point"), std::string::npos);
    scene.cameras[0].target = {0, 5, 1}; // straight up: the up vector is replaced
    Scene upright = scene;
    validate(upright);
    EXPECT_NE(upright.cameras[0].up, glm::vec3(0, 1, 0));
    scene.cameras[0].vertical_fov_degrees = 180;
    EXPECT_NE(error_of(scene).find("field of view"), std::string::npos);
}

TEST(Validate, KeysOfAPathMustMoveOn) {
    Scene scene = quad();
    scene.path.keys = {{0, {0, 0, 1}, {0, 0, 0}}, {0, {0, 0, 2}, {0, 0, 0}}};
    EXPECT_NE(error_of(scene).find("key 1 of the camera path"), std::string::npos);
}

TEST(Validate, IncompleteMipChainsAreErrors) {
    Scene scene = quad();
    scene.textures.push_back({"t", {{2, 2, std::vector<std::uint8_t>(16)}}, true, {}, {}, false});
    EXPECT_NE(error_of(scene).find("mip chain"), std::string::npos);
    scene.textures[0].levels.push_back({1, 1, std::vector<std::uint8_t>(4)});
    validate(scene);
}

TEST(Validate, TinyAndHugeScenesGetAView) {
    for (const float size : {1e-15f, 1e-6f, 1.0f, 1e6f, 1e15f}) {
        Scene scene = quad();
        for (glm::vec3& p : scene.meshes[0].positions)
            p *= size;
        validate(scene);
        const Camera& camera = scene.cameras.front();
        EXPECT_TRUE(std::isfinite(glm::length(camera.eye))) << size;
        EXPECT_NE(camera.eye, camera.target) << size;
        EXPECT_TRUE(std::isfinite(glm::length(scene.lights.front().position))) << size;
    }
}

TEST(Validate, ASinglePointStillGetsAView) {
    Scene scene = quad();
    for (glm::vec3& p : scene.meshes[0].positions)
        p = {3, 4, 5};
    validate(scene);
    EXPECT_NE(scene.cameras.front().eye, scene.cameras.front().target);
}

TEST(DefaultView, ObjectsAreSeenFromOutsideWhole) {
    Scene scene = quad();
    validate(scene);
    const Camera& camera = scene.cameras.front();
    EXPECT_GT(camera.eye.z, 0.0f);
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    for (const glm::vec3& p : scene.meshes[0].positions) {
        const float angle = std::acos(glm::dot(glm::normalize(p - camera.eye), forward));
        EXPECT_LT(angle * 57.3f, 0.75f * camera.vertical_fov_degrees);
    }
}

// A long closed hall of quads that face inwards.
Scene hall(const glm::vec3& size) {
    Scene scene = quad();
    Mesh& mesh = scene.meshes[0];
    mesh.triangles.clear();
    mesh.positions.clear();
    for (int corner = 0; corner < 8; ++corner)
        mesh.positions.push_back(glm::vec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1) * size);
    const glm::uvec4 sides[] = {{0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2},
                                {4, 6, 7, 5}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    for (const glm::uvec4& side : sides) {
        mesh.triangles.emplace_back(side.x, side.y, side.z);
        mesh.triangles.emplace_back(side.x, side.z, side.w);
    }
    for (glm::uvec3& t : mesh.triangles) { // inwards, whatever the order above
        const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        if (glm::dot(glm::cross(b - a, c - a), 0.5f * size - a) < 0.0f)
            std::swap(t.y, t.z);
    }
    mesh.triangle_material.assign(mesh.triangles.size(), 0);
    return scene;
}

TEST(DefaultView, HallsAreSeenFromInsideAlongTheirLength) {
    Scene scene = hall({40, 10, 12});
    validate(scene);
    const Camera& camera = scene.cameras.front();
    EXPECT_TRUE(camera.eye.x > 0 && camera.eye.x < 40 && camera.eye.y > 0 && camera.eye.y < 10 &&
                camera.eye.z > 0 && camera.eye.z < 12);
    EXPECT_GT(std::fabs(glm::normalize(camera.target - camera.eye).x), 0.8f);
    for (const Light& light : scene.lights) {
        EXPECT_GT(light.position.y, camera.eye.y);
        EXPECT_LT(light.position.y, 10.0f);
    }
}

TEST(DefaultView, TheSameHallTurnedInsideOutIsAnObject) {
    Scene scene = hall({40, 10, 12});
    for (glm::uvec3& t : scene.meshes[0].triangles)
        std::swap(t.y, t.z);
    validate(scene);
    const glm::vec3 eye = scene.cameras.front().eye;
    EXPECT_FALSE(eye.x > 0 && eye.x < 40 && eye.y > 0 && eye.y < 10 && eye.z > 0 && eye.z < 12);
}

TEST(DefaultView, EmissiveQuadsBecomeRectangleLights) {
    Scene scene = quad();
    scene.materials.emplace_back();
    scene.materials[0].emission = {3, 2, 1};
    validate(scene);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::rectangle);
    EXPECT_EQ(scene.lights[0].position, glm::vec3(0.5f, 0.5f, 0));
    EXPECT_GT(glm::cross(scene.lights[0].edge_u, scene.lights[0].edge_v).z, 0.0f);
}

} // namespace
} // namespace macula::scene
