// glTF animations: nodes evaluated against hand-computed poses, and data that makes no sense.
#include <cmath>
#include <cstring>
#include <limits>

#include <nlohmann/json.hpp>

#include "scenes/mover.hpp"
#include "tests/support/scene_folder.hpp"

namespace macula::scene {
namespace {

using nlohmann::json;

// A document with one triangle as mesh 0 and one animation, whose buffer is a file beside it.
class Animated {
  public:
    Animated() {
        document_ = {{"asset", {{"version", "2.0"}}},
                     {"scenes", {{{"nodes", {0}}}}},
                     {"nodes", {{{"mesh", 0}, {"name", "thing"}}}},
                     {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
                     {"accessors", json::array()},
                     {"bufferViews", json::array()}};
        add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
        document_["animations"].push_back(
            {{"name", "first"}, {"channels", json::array()}, {"samplers", json::array()}});
    }

    json& operator[](const char* key) { return document_[key]; }

    // The accessor of these numbers.
    std::size_t add_floats(const std::vector<float>& values, const std::string& type) {
        const std::size_t components = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4;
        document_["bufferViews"].push_back({{"buffer", 0},
                                            {"byteOffset", floats_.size() * sizeof(float)},
                                            {"byteLength", values.size() * sizeof(float)}});
        document_["accessors"].push_back({{"bufferView", document_["bufferViews"].size() - 1},
                                          {"componentType", 5126},
                                          {"count", values.size() / components},
                                          {"type", type}});
        floats_.insert(floats_.end(), values.begin(), values.end());
        return document_["accessors"].size() - 1;
    }

    void add_channel(int node, const std::string& path, const std::string& interpolation,
                     const std::vector<float>& seconds, const std::vector<float>& values,
                     std::size_t animation = 0) {
        json& to = document_["animations"][animation];
        to["samplers"].push_back(
            {{"input", add_floats(seconds, "SCALAR")},
             {"output", add_floats(values, path == "rotation" ? "VEC4" : "VEC3")},
             {"interpolation", interpolation}});
        to["channels"].push_back(
            {{"sampler", to["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
    }

    std::string text() {
        document_["buffers"] = {{{"uri", "a.bin"}, {"byteLength", floats_.size() * sizeof(float)}}};
        return document_.dump();
    }
    std::string bytes() const {
        std::string result(floats_.size() * sizeof(float), '\0');
        std::memcpy(result.data(), floats_.data(), result.size());
        return result;
    }

  private:
    json document_;
    std::vector<float> floats_;
};

class GltfAnimationFile : public SceneFolder {
  protected:
    Scene load_animated(Animated& document) const {
        write("a.bin", document.bytes());
        return load_text("a.gltf", document.text());
    }
    std::string error_of_animated(Animated& document) const {
        write("a.bin", document.bytes());
        return error_of_text("a.gltf", document.text());
    }
};

glm::vec3 at(const Scene& scene, std::uint32_t frame, const glm::vec3& p = glm::vec3(0.0f),
             std::size_t instance = 0) {
    return Mover(scene).at(frame, {})[instance].apply(p);
}

void expect_near(const glm::vec3& found, const glm::vec3& expected) {
    EXPECT_LE(glm::length(found - expected), 2e-5f) << found.x << ' ' << found.y << ' ' << found.z;
}

const float kHalf = std::sqrt(0.5f);

TEST_F(GltfAnimationFile, LinearTimesAreSecondsAndTheMotionBeginsAgain) {
    Animated document;
    document.add_channel(0, "translation", "LINEAR", {0.5f, 1.5f}, {1, 0, 0, 3, 4, 0});
    const Scene scene = load_animated(document);
    EXPECT_EQ(scene.instances.at(0).name, "thing");
    EXPECT_EQ(moving_instances(scene), std::vector<std::uint32_t>{0});
    EXPECT_EQ(scene.motion.period, 90.0f);
    expect_near(at(scene, 0), {1, 0, 0});
    expect_near(at(scene, 60), {2, 2, 0});
    expect_near(at(scene, 89), {1.0f + 2.0f * 59 / 60, 4.0f * 59 / 60, 0});
    expect_near(at(scene, 90 + 60), {2, 2, 0});
}

TEST_F(GltfAnimationFile, CubicSplineIsThatOfTheSpecification) {
    Animated document;
    // Tangents are for a second: at half of one second (p0 + p1) / 2 + (m0 - m1) / 8.
    document.add_channel(0, "translation", "CUBICSPLINE", {0, 1},
                         {9, 9, 9, 0, 0, 0, 8, 0, 0, 0, -16, 0, 2, 4, 0, 9, 9, 9});
    const Scene scene = load_animated(document);
    expect_near(at(scene, 30), {2, 4, 0});
    expect_near(at(scene, 0), {0, 0, 0});
    // At a quarter: 27/32 p0 + 9/64 m0 + 5/32 p1 - 3/64 m1.
    expect_near(at(scene, 15), {9.0f / 8 + 10.0f / 32, 20.0f / 32 + 48.0f / 64, 0});
}

TEST_F(GltfAnimationFile, ACubicRotationIsBroughtToUnitLength) {
    Animated document;
    document.add_channel(0, "rotation", "CUBICSPLINE", {0, 1},
                         {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, //
                          0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0});
    const Scene scene = load_animated(document);
    // Halfway between (0, 0, 0, 1) and (0, 0, 1, 0): a quarter turn about z.
    expect_near(at(scene, 30, {1, 0, 0}), {0, 1, 0});
}

TEST_F(GltfAnimationFile, RotationsAndScalesOfAHierarchyBelowAStandingNode) {
    Animated document;
    document["nodes"] = {
        {{"children", {1}}, {"matrix", {0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 5, 0, 0, 1}}},
        {{"children", {2}}},
        {{"mesh", 0}, {"translation", {1, 0, 0}}}};
    document.add_channel(1, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0, kHalf, kHalf});
    document.add_channel(2, "scale", "STEP", {0, 0.5f}, {1, 1, 1, 3, 1, 1});
    const Scene scene = load_animated(document);
    const float c = std::cos(0.7853982f);
    const auto outer = [](glm::vec3 p) { return glm::vec3(5 + 2 * p.z, 2 * p.y, -2 * p.x); };
    expect_near(at(scene, 0, {1, 0, 0}), outer({2, 0, 0}));
    expect_near(at(scene, 30, {1, 0, 0}), outer({4 * c, 4 * c, 0}));
    expect_near(at(scene, 59, {0, 0, 0}),
                outer({std::cos(1.5707963f * 59 / 60), std::sin(1.5707963f * 59 / 60), 0}));
}

TEST_F(GltfAnimationFile, OnlyWhatMovesStaysApart) {
    Animated document;
    document["scenes"] = {{{"nodes", {0, 1, 2}}}};
    document["nodes"] = {{{"mesh", 1}, {"name", "still"}},
                         {{"mesh", 0}, {"name", "moves"}},
                         {{"mesh", 2}, {"name", "still too"}}};
    document["meshes"] = json(3, document["meshes"][0]);
    document.add_channel(1, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 0, 6});
    const Scene scene = load_animated(document);
    ASSERT_EQ(scene.instances.size(), 2u);
    ASSERT_EQ(moving_instances(scene).size(), 1u);
    const std::uint32_t moving = moving_instances(scene)[0];
    EXPECT_EQ(scene.instances[moving].name, "moves");
    EXPECT_EQ(scene.meshes[scene.instances[1 - moving].mesh].triangles.size(), 2u);
    expect_near(at(scene, 10, {}, moving), {0, 0, 1});
}

TEST_F(GltfAnimationFile, SceneFilesChooseAnimationAndFrameRateAndMoveOtherNodes) {
    Animated document;
    document["scenes"] = {{{"nodes", {0, 1}}}};
    document["nodes"].push_back({{"name", "group"}, {"translation", {0, 7, 0}}, {"children", {2}}});
    document["nodes"].push_back({{"mesh", 1}});
    document["meshes"] = json(2, document["meshes"][0]);
    document.add_channel(0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 6, 0, 0});
    document["animations"].push_back(
        {{"name", "second"}, {"channels", json::array()}, {"samplers", json::array()}});
    document.add_channel(0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 0, 6}, 1);
    EXPECT_TRUE(warns(load_animated(document), "1 animations are left out"));
    const std::string file = "file = 'a.gltf'\n[motion]\n";
    for (const char* name : {"second", "1"}) {
        const Scene scene = load_text("s.toml", file + "frame_rate = 30\nanimation = '" + name +
                                                    "'\n[[motion.node]]\ninstances = 'group'\n"
                                                    "translation = [1, 0, 0]\n");
        ASSERT_EQ(moving_instances(scene).size(), 2u);
        expect_near(at(scene, 10), {0, 0, 2});
        expect_near(at(scene, 10, {}, 1), {1, 7, 0}); // from where the file has it
    }
    EXPECT_TRUE(moving_instances(load_text("s.toml", file + "animation = 'none'\n")).empty());
    EXPECT_NE(error_of_text("s.toml", file + "animation = 'third'\n")
                  .find("a.gltf: animations: there is no 'third'; there are 'first', 'second'"),
              std::string::npos);
}

TEST_F(GltfAnimationFile, SkinsMorphTargetsAndCamerasAreCountedWarnings) {
    Animated document;
    document["nodes"][0]["camera"] = 0;
    document["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 1}}}}};
    document.add_channel(0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 6, 0, 0});
    document.add_channel(0, "weights", "LINEAR", {0, 1}, {0, 0, 0, 6, 0, 0});
    const Scene scene = load_animated(document);
    EXPECT_TRUE(warns(scene, "animations of morph targets are ignored"));
    EXPECT_TRUE(warns(scene, "cameras and lights do not move with their nodes"));
    EXPECT_EQ(moving_instances(scene).size(), 1u);
}

struct Fault {
    std::string name, message;
    void (*make)(Animated&);
};

class GltfAnimationFault : public GltfAnimationFile, public testing::WithParamInterface<Fault> {};

TEST_P(GltfAnimationFault, IsAClearError) {
    Animated document;
    GetParam().make(document);
    const std::string error = error_of_animated(document);
    EXPECT_NE(error.find(GetParam().message), std::string::npos) << error;
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const std::string kWhere = "animation 0 'first', channel 0: ";

INSTANTIATE_TEST_SUITE_P(
    All, GltfAnimationFault,
    testing::Values(
        Fault{"TimesInDisorder", kWhere + "the time of key 1 is not after that of the key before",
              [](Animated& d) {
                  d.add_channel(0, "translation", "LINEAR", {1, 1}, {0, 0, 0, 1, 1, 1});
              }},
        Fault{"NegativeTime", kWhere + "the time of key 0 is no time",
              [](Animated& d) {
                  d.add_channel(0, "scale", "STEP", {-1}, {1, 1, 1});
              }},
        Fault{"TimeIsNaN", kWhere + "the time of key 0 is no time",
              [](Animated& d) {
                  d.add_channel(0, "scale", "STEP", {kNan}, {1, 1, 1});
              }},
        Fault{"ValueIsNaN", kWhere + "value 0 is not finite",
              [](Animated& d) {
                  d.add_channel(0, "scale", "STEP", {0}, {1, kNan, 1});
              }},
        Fault{"TooFewValues", kWhere + "1 values for 2 keys",
              [](Animated& d) {
                  d.add_channel(0, "scale", "LINEAR", {0, 1}, {1, 1, 1});
              }},
        Fault{"CubicWithoutTangents", kWhere + "2 values for 2 keys of three each",
              [](Animated& d) {
                  d.add_channel(0, "scale", "CUBICSPLINE", {0, 1}, {1, 1, 1, 1, 1, 1});
              }},
        Fault{"NoSuchNode", kWhere + "node 7 does not exist",
              [](Animated& d) {
                  d.add_channel(7, "scale", "STEP", {0}, {1, 1, 1});
              }},
        Fault{"NoSuchSampler", kWhere + "sampler 3 does not exist",
              [](Animated& d) {
                  d.add_channel(0, "scale", "STEP", {0}, {1, 1, 1});
                  d["animations"][0]["channels"][0]["sampler"] = 3;
              }},
        Fault{"NoSuchAccessor", kWhere + "accessor 99 does not exist",
              [](Animated& d) {
                  d.add_channel(0, "scale", "STEP", {0}, {1, 1, 1});
                  d["animations"][0]["samplers"][0]["output"] = 99;
              }},
        Fault{"NoSuchPart", kWhere + "nothing of a node is called 'colour'",
              [](Animated& d) {
                  d.add_channel(0, "colour", "STEP", {0}, {1, 1, 1});
              }},
        Fault{"NoSuchInterpolation", kWhere + "'BOUNCE' is no interpolation",
              [](Animated& d) {
                  d.add_channel(0, "scale", "BOUNCE", {0}, {1, 1, 1});
              }},
        Fault{"MovedTwice", "channel 1: an earlier channel moves the same part of the node",
              [](Animated& d) {
                  d.add_channel(0, "scale", "STEP", {0}, {1, 1, 1});
                  d.add_channel(0, "scale", "STEP", {0}, {1, 1, 1});
              }},
        Fault{"NodeWithMatrix", kWhere + "node 0 has a matrix and cannot move",
              [](Animated& d) {
                  d["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
                  d.add_channel(0, "scale", "STEP", {0}, {1, 1, 1});
              }},
        Fault{"SingularScale", "moving node 0: its scale becomes 0",
              [](Animated& d) {
                  d.add_channel(0, "scale", "LINEAR", {0, 1}, {1, 1, 1, 1, 0, 1});
              }},
        Fault{"ScaleThroughZeroBetweenKeys", "moving node 0: its scale becomes 0",
              [](Animated& d) {
                  d.add_channel(0, "scale", "CUBICSPLINE", {0, 1},
                                {0, 0, 0, 1, 1, 1, 0, -20, 0, 0, 20, 0, 1, 1, 1, 0, 0, 0});
              }},
        Fault{"RotationWithoutLength", "moving node 0: a rotation has no length",
              [](Animated& d) {
                  d.add_channel(0, "rotation", "STEP", {0}, {0, 0, 0, 0});
              }},
        Fault{"TooFarAway", "moving node 0: translation: a value is not finite",
              [](Animated& d) {
                  d.add_channel(0, "translation", "STEP", {0}, {1e30f, 0, 0});
              }},
        Fault{"TooFarAwayTogether", "it may move beyond the largest coordinate",
              [](Animated& d) {
                  d.add_channel(0, "translation", "STEP", {0}, {9e17f, 9e17f, 0});
              }},
        Fault{"Flattened", "its scale becomes too small or too large",
              [](Animated& d) {
                  d.add_channel(0, "scale", "STEP", {0}, {1e-14f, 1e-14f, 1e-14f});
              }}),
    [](const auto& tested) { return tested.param.name; });

} // namespace
} // namespace macula::scene
