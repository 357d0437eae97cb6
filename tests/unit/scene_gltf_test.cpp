// glTF 2.0: transforms, sharing, materials, and documents that contradict themselves.
#include <cmath>
#include <cstring>

#include <nlohmann/json.hpp>

#include "tests/support/scene_folder.hpp"

namespace macula::scene {
namespace {

using nlohmann::json;

std::string base64(const std::string& bytes) {
    static const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word =
                word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (int k = 3; k >= 0; --k)
            text += kDigits[word >> (6 * k) & 63];
    }
    for (std::size_t pad = 0; pad < (3 - bytes.size() % 3) % 3; ++pad)
        text[text.size() - 1 - pad] = '=';
    return text;
}

// Positions and normals of one triangle, then its indices as 16-bit numbers, in one buffer.
std::string triangle_bytes() {
    const float floats[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    const std::uint16_t indices[] = {0, 1, 2, 0};
    std::string bytes(sizeof floats + sizeof indices, '\0');
    std::memcpy(bytes.data(), floats, sizeof floats);
    std::memcpy(bytes.data() + sizeof floats, indices, sizeof indices);
    return bytes;
}

json document() {
    const std::string bytes = triangle_bytes();
    return {
        {"asset", {{"version", "2.0"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes", {{{"mesh", 0}}}},
        {"meshes",
         {{{"primitives", {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}}}}}}},
        {"accessors",
         {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
          {{"bufferView", 0},
           {"byteOffset", 36},
           {"componentType", 5126},
           {"count", 3},
           {"type", "VEC3"}},
          {{"bufferView", 1}, {"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}}}},
        {"bufferViews",
         {{{"buffer", 0}, {"byteLength", 72}},
          {{"buffer", 0}, {"byteOffset", 72}, {"byteLength", 8}}}},
        {"buffers",
         {{{"byteLength", bytes.size()},
           {"uri", "data:application/octet-stream;base64," + base64(bytes)}}}}};
}

std::string glb(const json& description, const std::string& binary) {
    std::string text = description.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::uint32_t value) {
        return std::string(reinterpret_cast<const char*>(&value), 4);
    };
    std::string chunks = word(static_cast<std::uint32_t>(text.size())) + "JSON" + text;
    if (!binary.empty())
        chunks +=
            word(static_cast<std::uint32_t>(binary.size())) + std::string("BIN\0", 4) + binary;
    return "glTF" + word(2) + word(static_cast<std::uint32_t>(chunks.size() + 12)) + chunks;
}

class Gltf : public SceneFolder {
  protected:
    Scene load_json(const json& description) const {
        return load_text("a.gltf", description.dump());
    }
    std::string error_of_json(const json& description) const {
        return error_of_text("a.gltf", description.dump());
    }
};

void expect_near(const glm::vec3& a, const glm::vec3& b) {
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(a[axis], b[axis], 1e-5f) << "axis " << axis;
}

TEST_F(Gltf, DataUrisAndBinaryFilesGiveTheSameScene) {
    const Scene text = load_json(document());
    json description = document();
    description["buffers"][0].erase("uri");
    const Scene binary = load_text("a.glb", glb(description, triangle_bytes()));
    ASSERT_EQ(text.triangle_count(), 1u);
    ASSERT_EQ(binary.triangle_count(), 1u);
    EXPECT_EQ(text.meshes[0].positions, binary.meshes[0].positions);
    EXPECT_EQ(text.materials.size(), 1u);
}

TEST_F(Gltf, MatricesAreColumnMajorAndParentsActLast) {
    json description = document();
    // The parent turns z to y; the child moves by (1, 2, 3) first.
    description["nodes"] = {
        {{"children", {1}}, {"matrix", {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1}}},
        {{"mesh", 0}, {"translation", {1, 2, 3}}}};
    const Scene scene = load_json(description);
    expect_near(scene.meshes[0].positions[0], {1, 3, -2});
    expect_near(scene.meshes[0].positions[2], {1, 3, -3});
    expect_near(scene.meshes[0].normals[0], {0, 1, 0});
    EXPECT_TRUE(scene.instances[0].world_from_object.is_identity());
}

TEST_F(Gltf, ScaleThenRotationThenTranslation) {
    json description = document();
    const double half = std::sqrt(0.5);
    description["nodes"][0].update({{"translation", {10, 0, 0}},
                                    {"rotation", {0, 0, half, half}}, // 90 degrees about z
                                    {"scale", {2, 3, 4}}});
    const Scene scene = load_json(description);
    expect_near(scene.meshes[0].positions[1], {10, 2, 0});
    expect_near(scene.meshes[0].positions[2], {7, 0, 0});
}

TEST_F(Gltf, MirroringKeepsFrontsInFront) {
    json description = document();
    description["nodes"][0]["scale"] = {1, 1, -1};
    const Scene scene = load_json(description);
    const Mesh& mesh = scene.meshes[0];
    const glm::uvec3 t = mesh.triangles[0];
    const glm::vec3 geometric = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                           mesh.positions[t.z] - mesh.positions[t.x]);
    expect_near(mesh.normals[0], {0, 0, -1});
    EXPECT_GT(glm::dot(geometric, mesh.normals[0]), 0.0f);
}

TEST_F(Gltf, MeshesOfSeveralNodesBecomeInstances) {
    json description = document();
    description["scenes"][0]["nodes"] = {0, 1};
    description["nodes"].push_back({{"mesh", 0}, {"translation", {5, 0, 0}}, {"name", "second"}});
    const Scene scene = load_json(description);
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.triangle_count(), 2u);
    EXPECT_EQ(scene.instances[1].name, "second");
    expect_near(scene.instances[1].world_from_object.apply({1, 2, 3}), {6, 2, 3});
    expect_near(scene.bounds().hi, {6, 1, 0});
}

TEST_F(Gltf, CyclicNodesAndSharedChildrenAreErrors) {
    json cycle = document();
    cycle["nodes"][0]["children"] = {0};
    EXPECT_NE(error_of_json(cycle).find("cycle"), std::string::npos);
    json shared = document();
    shared["nodes"] = {
        {{"children", {1, 2}}}, {{"children", {3}}}, {{"children", {3}}}, {{"mesh", 0}}};
    EXPECT_NE(error_of_json(shared).find("share a child"), std::string::npos);
}

TEST_F(Gltf, DeepNodeChainsNeedNoDeepStack) {
    json description = document();
    json nodes = json::array();
    for (int i = 0; i < 50000; ++i)
        nodes.push_back({{"children", {i + 1}}});
    nodes.push_back({{"mesh", 0}});
    description["nodes"] = nodes;
    EXPECT_EQ(load_json(description).triangle_count(), 1u);
}

TEST_F(Gltf, DeeplyNestedJsonIsRefused) {
    const std::string deep(200000, '[');
    EXPECT_NE(error_of_text("a.gltf", "{\"asset\":{\"version\":\"2.0\",\"extras\":" + deep)
                  .find("nested"),
              std::string::npos);
}

TEST_F(Gltf, EverythingOutOfRangeIsNamed) {
    struct Case {
        const char* pointer;
        json value;
        const char* message;
    };
    const Case cases[] = {
        {"/nodes/0/mesh", 7, "mesh 7 does not exist"},
        {"/scenes/0/nodes/0", 9, "node 9 does not exist"},
        {"/scene", 3, "scene 3 does not exist"},
        {"/meshes/0/primitives/0/attributes/POSITION", 9, "accessor 9 does not exist"},
        {"/meshes/0/primitives/0/material", 4, "material 4 does not exist"},
        {"/accessors/0/count", 4000000000, "elements"},
        {"/accessors/0/count", 100, "beyond its buffer view"},
        {"/accessors/0/byteOffset", 70, "beyond its buffer view"},
        {"/accessors/0/bufferView", 5, "buffer view 5 does not exist"},
        {"/accessors/0/type", "VEC2", "3 were expected"},
        {"/accessors/2/componentType", 5122, "no unsigned indices"},
        {"/bufferViews/0/byteLength", 1000000, "beyond its buffer"},
        {"/bufferViews/0/byteOffset", 1000000, "beyond its buffer"},
        {"/bufferViews/0/buffer", 2, "buffer 2 does not exist"},
        {"/nodes/0/scale", json::array({1, 2}), "malformed"},
    };
    for (const Case& c : cases) {
        json description = document();
        description[json::json_pointer(c.pointer)] = c.value;
        EXPECT_NE(error_of_json(description).find(c.message), std::string::npos) << c.pointer;
    }
}

TEST_F(Gltf, VertexIndicesOutOfRangeAreErrors) {
    std::string bytes = triangle_bytes();
    bytes[72] = 3;
    json description = document();
    description["buffers"][0].erase("uri");
    EXPECT_NE(
        error_of_text("a.glb", glb(description, bytes)).find("vertex index 3 is out of range"),
        std::string::npos);
}

TEST_F(Gltf, TruncatedBinaryIsRefused) {
    json description = document();
    description["buffers"][0].erase("uri");
    const std::string whole = glb(description, triangle_bytes());
    for (std::size_t length = 0; length < whole.size(); ++length) {
        write("cut.glb", whole.substr(0, length));
        EXPECT_THROW(load_written("cut.glb"), SceneError) << length;
    }
}

TEST_F(Gltf, FlippedBytesNeverCrash) {
    json description = document();
    description["buffers"][0].erase("uri");
    const std::string whole = glb(description, triangle_bytes());
    for (std::size_t at = 0; at < whole.size(); at += 3) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x15);
        write("noise.glb", damaged);
        try {
            load_written("noise.glb");
        } catch (const SceneError&) {
        }
    }
}

TEST_F(Gltf, FilesOutsideTheFolderAreNotRead) {
    write("secret.bin", triangle_bytes());
    for (const char* uri :
         {"../secret.bin", "/etc/passwd", "..%2Fsecret.bin", "a/../../secret.bin"}) {
        json description = document();
        description["buffers"][0]["uri"] = uri;
        write("scene/a.gltf", description.dump());
        EXPECT_NE(error_of("scene/a.gltf").find("not found"), std::string::npos) << uri;
    }
}

TEST_F(Gltf, ExternalFilesMayHaveBlanksInTheirNames) {
    write("my data.bin", triangle_bytes());
    json description = document();
    description["buffers"][0]["uri"] = "my%20data.bin";
    EXPECT_EQ(load_json(description).triangle_count(), 1u);
}

TEST_F(Gltf, MissingImagesAreWarnedOfAndVisible) {
    json description = document();
    description["images"] = {{{"uri", "gone.png"}}, {{"uri", "../gone.png"}}};
    description["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 5}}};
    for (int i = 0; i < 3; ++i)
        description["materials"].push_back(
            {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
    const Scene scene = load_json(description);
    EXPECT_EQ(scene.textures.size(), 3u);
    EXPECT_TRUE(warns(scene, "gone.png: replaced by a visible stand-in"));
    for (const Texture& texture : scene.textures)
        EXPECT_EQ(texture.levels[0].rgba[1], 0) << texture.name;
}

TEST_F(Gltf, WrapModesOfSamplersAreKept) {
    json description = document();
    description["images"] = {{{"uri", "gone.png"}}};
    description["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
    description["textures"] = {{{"source", 0}, {"sampler", 0}}};
    description["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    const Scene scene = load_json(description);
    EXPECT_EQ(scene.textures[0].wrap_u, Wrap::clamp);
    EXPECT_EQ(scene.textures[0].wrap_v, Wrap::mirror);
}

TEST_F(Gltf, BlendFactorsAndEmissionBecomePhong) {
    json description = document();
    description["materials"] = {
        {{"alphaMode", "BLEND"},
         {"emissiveFactor", {1, 0.5, 0}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {1, 0, 0, 0.25}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}}};
    const Scene scene = load_json(description);
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.alpha_mode, AlphaMode::blend);
    EXPECT_FLOAT_EQ(material.opacity, 0.25f);
    EXPECT_EQ(material.diffuse, glm::vec3(1, 0, 0));
    EXPECT_EQ(material.emission, glm::vec3(4, 2, 0));
    EXPECT_FLOAT_EQ(material.shininess, 1.0f);
}

TEST_F(Gltf, CamerasAndLightsArePlacedByTheirNodes) {
    json description = document();
    description["extensionsUsed"] = {"KHR_lights_punctual"};
    description["extensions"] = {
        {"KHR_lights_punctual",
         {{"lights", {{{"type", "directional"}, {"intensity", 3}}, {{"type", "point"}}}}}}};
    description["cameras"] = {{{"type", "perspective"},
                               {"name", "front"},
                               {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    description["scenes"][0]["nodes"] = {0, 1, 2, 3};
    description["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 4}}});
    description["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    description["nodes"].push_back(
        {{"translation", {1, 2, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
    const Scene scene = load_json(description);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "front");
    expect_near(scene.cameras[0].eye, {0, 0, 4});
    expect_near(scene.cameras[0].target, {0, 0, 3});
    EXPECT_NEAR(scene.cameras[0].vertical_fov_degrees, 28.648f, 1e-2f);
    ASSERT_EQ(scene.lights.size(), 2u);
    expect_near(scene.lights[0].direction, {0, 0, -1});
    expect_near(scene.lights[1].position, {1, 2, 3});
}

TEST_F(Gltf, StripsFansAndPointsAreTold) {
    json description = document();
    description["meshes"][0]["primitives"][0]["mode"] = 5;
    EXPECT_EQ(load_json(description).triangle_count(), 1u);
    description["meshes"][0]["primitives"][0]["mode"] = 6;
    EXPECT_EQ(load_json(description).triangle_count(), 1u);
    description["meshes"][0]["primitives"][0]["mode"] = 0;
    EXPECT_NE(error_of_json(description).find("no triangles"), std::string::npos);
}

TEST_F(Gltf, SparseAccessorsReplaceElements) {
    const float moved[] = {7, 8, 9};
    std::string bytes = triangle_bytes() + std::string(reinterpret_cast<const char*>(moved), 12) +
                        std::string("\1\0\0\0", 4);
    json description = document();
    description["buffers"][0] = {{"byteLength", bytes.size()}};
    description["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 80}, {"byteLength", 12}});
    description["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 92}, {"byteLength", 4}});
    json& accessor = description["accessors"][0];
    accessor["sparse"] = {{"count", 1},
                          {"indices", {{"bufferView", 3}, {"componentType", 5125}}},
                          {"values", {{"bufferView", 2}}}};
    expect_near(load_text("a.glb", glb(description, bytes)).meshes[0].positions[1], {7, 8, 9});
    accessor["sparse"]["count"] = 2;
    EXPECT_NE(error_of_text("b.glb", glb(description, bytes)).find("sparse"), std::string::npos);
}

TEST_F(Gltf, UnknownRequiredExtensionsAreNamed) {
    json description = document();
    description["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    EXPECT_NE(error_of_json(description).find("KHR_draco_mesh_compression"), std::string::npos);
}

} // namespace
} // namespace macula::scene
