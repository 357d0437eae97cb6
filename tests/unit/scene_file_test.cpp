// Scene files: every key, and errors with file, line and key.
#include "tests/support/scene_folder.hpp"

namespace macula::scene {
namespace {

class SceneFile : public SceneFolder {
  protected:
    SceneFile() {
        write("part.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n");
        write("m.mtl", "newmtl paint\nKd 1 0 0\n");
    }
    Scene load_toml(const std::string& text) const { return load_text("s.toml", text); }
    std::string error_of_toml(const std::string& text) const {
        return error_of_text("s.toml", text);
    }
};

const std::string kFile = "file = 'part.obj'\n";

TEST_F(SceneFile, EverythingThatCanBeSaid) {
    const Scene scene = load_toml(kFile + R"(
name = "a part"
scale = 2.0
metres_per_unit = 0.01
ambient = [0.1, 0.2, 0.3]
background = 0.5
ambient_occlusion_radius = 3
display = "dk2"
gaze = "centre"

[[light]]
kind = "directional"
direction = [0, -2, 0]
angle = 2.5
colour = [1, 0.5, 0.25]
intensity = 2.0

[[light]]
position = [1, 2, 3]
radius = 0.5
attenuation_distance = 4

[[light]]
kind = "rectangle"
position = [0, 5, 0]
edge_u = [1, 0, 0]
edge_v = [0, 0, 1]

[[camera]]
name = "front"
eye = [0, 0, 5]
target = [0, 0, 0]
vertical_fov_degrees = 50

[path]
frames = 100
[[path.key]]
frame = 0
eye = [0, 0, 5]
target = [0, 0, 0]
[[path.key]]
frame = 99
eye = [0, 1, 5]
target = [0, 0, 0]

[[material]]
name = "paint"
diffuse = [0, 1, 0]
specular = 0.5
shininess = 64
emission = 2
opacity = 0.5
index_of_refraction = 1.3
reflectivity = 0.25
transmission = [0.1, 0.2, 0.3]
alpha_mode = "blend"
alpha_cutoff = 0.25
textures = false
)");
    EXPECT_EQ(scene.name, "a part");
    EXPECT_EQ(scene.meshes[0].positions[1], glm::vec3(2, 0, 0));
    EXPECT_FLOAT_EQ(scene.metres_per_unit, 0.01f);
    EXPECT_EQ(scene.ambient, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(scene.background, glm::vec3(0.5f));
    EXPECT_FLOAT_EQ(scene.ambient_occlusion_radius, 3.0f);
    EXPECT_EQ(scene.display, "dk2");
    EXPECT_EQ(scene.gaze, "centre");
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].direction, glm::vec3(0, -1, 0));
    EXPECT_EQ(scene.lights[0].colour, glm::vec3(2, 1, 0.5f));
    EXPECT_EQ(scene.lights[0].angle, 2.5f);
    EXPECT_EQ(scene.lights[1].angle, 0.27f);
    EXPECT_FLOAT_EQ(scene.lights[1].attenuation_distance, 4.0f);
    EXPECT_EQ(scene.lights[2].kind, LightKind::rectangle);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "front");
    ASSERT_EQ(scene.path.keys.size(), 2u);
    EXPECT_EQ(scene.path.frames, 100u);
    EXPECT_EQ(scene.materials[0].diffuse, glm::vec3(0, 1, 0));
    EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::blend);
    EXPECT_FLOAT_EQ(scene.materials[0].alpha_cutoff, 0.25f);
}

TEST_F(SceneFile, DisplayAndGazeFilesAreFoundBesideIt) {
    write("looks.csv", "time_ns,x,y,z\n0,0,0,-1\n");
    write("mine.json",
          R"({"width": 4, "height": 3, "screen": {"width_mm": 400, "distance_mm": 600}})");
    const std::string trace = "trace:" + path("looks.csv");
    EXPECT_EQ(load_toml(kFile + "gaze = 'looks.csv'\n").gaze, trace);
    EXPECT_EQ(load_toml(kFile + "gaze = 'looks.csv:repeat'\n").gaze, trace + ":repeat");
    EXPECT_EQ(load_toml(kFile + "gaze = 'trace:looks.csv'\n").gaze, trace);
    EXPECT_EQ(load_toml(kFile + "gaze = 'synthetic:seed=2'\n").gaze, "synthetic:seed=2");
    EXPECT_EQ(load_toml(kFile + "display = 'mine.json'\n").display, path("mine.json"));
    // Where the file lies counts, not where the outer one does.
    write("inner/other.csv", "time_ns,x,y,z\n0,0,0,-1\n");
    write("inner/s.toml", "procedural = 'cornell'\ngaze = 'other.csv'\n");
    EXPECT_EQ(load_toml("file = 'inner/s.toml'\n").gaze, "trace:" + path("inner/other.csv"));
}

TEST_F(SceneFile, UpAxesTurnRightHanded) {
    write("part.obj", "v 0 0 0\nv 1 2 3\nv 1 2 0\nf 1 2 3\n");
    EXPECT_EQ(load_toml(kFile + "up = 'z'\n").meshes[0].positions[1], glm::vec3(2, 3, 1));
    EXPECT_EQ(load_toml(kFile + "up = 'x'\n").meshes[0].positions[1], glm::vec3(3, 1, 2));
    EXPECT_EQ(load_toml(kFile + "up = 'y'\n").meshes[0].positions[1], glm::vec3(1, 2, 3));
}

TEST_F(SceneFile, ErrorsGiveFileLineAndKey) {
    struct Case {
        const char* text;
        const char* where; // after the file's name
    };
    const Case cases[] = {
        {"colour = 1\n", ":2: key 'colour': there is no such key"},
        {"scale = 'big'\n", ":2: key 'scale': a number was expected"},
        {"scale = 0\n", ":2: key 'scale': 0 is not between"},
        {"scale = nan\n", ":2: key 'scale': nan is not between"},
        {"ambient = [1, 2]\n", ":2: key 'ambient': three numbers"},
        {"ambient = -1\n", ":2: key 'ambient': -1 is not between"},
        {"ambient = [1, inf, 2]\n", ":2: key 'ambient': three finite numbers"},
        {"up = 'w'\n", ":2: key 'up': 'w' is none of: y, z, x"},
        {"seed = 1\n", ":2: key 'seed': only procedural"},
        {"procedural = 'cornell'\n", ":1: key 'file': exactly one"},
        {"display = 'dk9'\n", ":2: key 'display': there is no display \"dk9\""},
        {"display = 'gone.toml'\n", ":2: key 'display': 'gone.toml' is in none of"},
        {"gaze = 'gone.csv'\n", ":2: key 'gaze': 'gone.csv' is in none of"},
        {"light = 1\n", ":2: key 'light': tables [[light]]"},
        {"[[light]]\n", ":2: key 'position': it is missing"},
        {"[[light]]\nposition = [0, 0, 0]\nwatts = 3\n", ":4: key 'watts': there is no such key"},
        {"[[light]]\nkind = 'spherical'\nposition = [0, 0, 0]\n",
         "key 'radius': a spherical light"},
        {"[[light]]\nkind = 'directional'\ndirection = [0, 0, 0]\n", ":4: key 'direction'"},
        {"[[light]]\nkind = 'directional'\ndirection = [0, 1, 0]\nangle = 81\n",
         ":5: key 'angle': 81 is not between"},
        {"[[light]]\nposition = [0, 0, 0]\nangle = 1\n", ":4: key 'angle': there is no such key"},
        {"[[camera]]\neye = [0, 0, 0]\ntarget = [0, 0, 0]\n", ":4: key 'target': it is the same"},
        {"[path]\nframes = 0\n", ":3: key 'frames': 0 is not between"},
        {"[path]\nframes = 10\n", "key 'key': a camera path needs"},
        {"[[path.key]]\nframe = 1\neye = [0, 0, 1]\ntarget = [0, 0, 0]\n"
         "[[path.key]]\nframe = 1\neye = [0, 0, 1]\ntarget = [0, 0, 0]\n",
         ":7: key 'frame': it must be greater"},
        {"[[material]]\nname = 'chrome'\n", ":3: key 'name': the scene has no material 'chrome'"},
        {"[[material]]\nname = 'paint'\nopacity = 2\n", ":4: key 'opacity': 2 is not between"},
        {"name = 'a\n", ":2:10: "},
        {"a = = 1\n", ":2:5: "},
    };
    for (const Case& c : cases) {
        const std::string error = error_of_toml(kFile + c.text);
        EXPECT_NE(error.find("s.toml"), std::string::npos) << c.text;
        EXPECT_NE(error.find(c.where), std::string::npos) << c.text << error;
    }
}

TEST_F(SceneFile, NamesOfMissingFilesAreLookedUpInTheSearchPath) {
    const std::string error = error_of_toml("file = 'gone.obj'\n");
    EXPECT_NE(error.find("s.toml:1: key 'file': 'gone.obj' is in none of"), std::string::npos);
    write("elsewhere/far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write("t.toml", "file = 'far.obj'\n");
    EXPECT_THROW(load_written("t.toml"), SceneError);
    LoadOptions options;
    options.search_path = {path("elsewhere")};
    EXPECT_EQ(load_written("t.toml", options).triangle_count(), 1u);
    setenv("MACULA_SCENE_PATH", ("/nowhere:" + path("elsewhere")).c_str(), 1);
    EXPECT_EQ(load_written("t.toml").triangle_count(), 1u);
    unsetenv("MACULA_SCENE_PATH");
}

TEST_F(SceneFile, FilesThatNameThemselvesEnd) {
    EXPECT_NE(error_of_toml("file = 's.toml'\n").find("in a circle"), std::string::npos);
}

TEST_F(SceneFile, BuiltInScenesCanBeNamed) {
    EXPECT_GT(load_toml("procedural = 'cornell'\n").triangle_count(), 0u);
    EXPECT_NE(error_of_toml("procedural = 'nonsense'\n").find(":1: key 'procedural'"),
              std::string::npos);
}

TEST_F(SceneFile, TruncatedAnywhereIsLoadedOrRefused) {
    const std::string whole = kFile + "[[light]]\nposition = [1, 2, 3]\n[[camera]]\n"
                                      "eye = [0, 0, 5]\ntarget = [0, 0, 0]\n";
    for (std::size_t length = 0; length < whole.size(); ++length) {
        write("cut.toml", whole.substr(0, length));
        try {
            load_written("cut.toml");
        } catch (const SceneError& error) {
            EXPECT_NE(std::string(error.what()).find("cut.toml:"), std::string::npos);
        }
    }
}

} // namespace
} // namespace macula::scene
