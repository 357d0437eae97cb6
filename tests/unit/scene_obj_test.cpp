// OBJ and MTL: what real files hold, and what damaged ones hold.
#include <limits>

#include "scenes/triangulate.hpp"
#include "tests/support/scene_folder.hpp"

namespace macula::scene {
namespace {

using Obj = SceneFolder;

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST_F(Obj, NegativeIndicesCountFromTheEnd) {
    const Scene scene = load_text("a.obj", kTriangle + "f -3 -2 -1\nv 5 5 5\nf -4 -3 -1\n");
    ASSERT_EQ(scene.triangle_count(), 2u);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.positions[mesh.triangles[0].x], glm::vec3(0, 0, 0));
    EXPECT_EQ(mesh.positions[mesh.triangles[1].x], glm::vec3(0, 0, 0));
    EXPECT_EQ(mesh.positions[mesh.triangles[1].y], glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.positions[mesh.triangles[1].z], glm::vec3(5, 5, 5));
}

TEST_F(Obj, ThreeDigitExponentsAndLeadingDots) {
    const Scene scene =
        load_text("a.obj", "v -3.4101800e-003 .5 +1.5E+000\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const glm::vec3 p = scene.meshes[0].positions[0];
    EXPECT_FLOAT_EQ(p.x, -3.41018e-3f);
    EXPECT_FLOAT_EQ(p.y, 0.5f);
    EXPECT_FLOAT_EQ(p.z, 1.5f);
}

TEST_F(Obj, LinesAndPointsAreSkipped) {
    const Scene scene = load_text("a.obj", kTriangle + "l 1 2 3\np 1\nf 1 2 3\nl 2 3\n");
    EXPECT_EQ(scene.triangle_count(), 1u);
}

TEST_F(Obj, QuadsSplitAlongTheirShorterDiagonal) {
    const Scene scene = load_text("a.obj", "v 0 0 0\nv 2 -1 0\nv 4 0 0\nv 2 1 0\nf 1 2 3 4\n");
    ASSERT_EQ(scene.triangle_count(), 2u);
    EXPECT_EQ(scene.meshes[0].triangles[0], glm::uvec3(0, 1, 3));
}

TEST_F(Obj, QuadThatIsAnArrowIsNotFolded) {
    // The corner at (1, 0.2) is reflex: only the diagonal through it is inside.
    const Scene scene = load_text("a.obj", "v 0 0 0\nv 1 0.2 0\nv 2 0 0\nv 1 2 0\nf 1 2 3 4\n");
    for (const glm::uvec3& t : scene.meshes[0].triangles) {
        const std::vector<glm::vec3>& p = scene.meshes[0].positions;
        EXPECT_GT(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]).z, 0.0f);
    }
}

double area_of(const std::vector<glm::vec3>& p, const std::vector<glm::uvec3>& triangles) {
    double area = 0.0;
    for (const glm::uvec3& t : triangles)
        area += 0.5 * glm::length(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]));
    return area;
}

TEST(Triangulate, ConcavePolygonKeepsItsArea) {
    // A comb: five teeth of area 1 on a bar of area 9.
    std::vector<glm::vec3> comb{{0, -1, 0}, {9, -1, 0}};
    for (int tooth = 4; tooth >= 0; --tooth) {
        const auto x = static_cast<float>(2 * tooth);
        comb.insert(comb.end(), {{x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}, {x, 0, 0}});
    }
    std::vector<glm::uvec3> triangles;
    triangulate(comb, triangles);
    EXPECT_EQ(triangles.size(), comb.size() - 2);
    EXPECT_NEAR(area_of(comb, triangles), 14.0, 1e-5);
}

TEST(Triangulate, DegenerateAndNonFinitePolygonsEnd) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float value : {0.0f, nan, std::numeric_limits<float>::infinity(), 3e38f})
        for (const std::size_t corners : {3u, 4u, 5u, 64u, 300u}) {
            std::vector<glm::uvec3> triangles;
            triangulate(std::vector<glm::vec3>(corners, glm::vec3(value)), triangles);
            EXPECT_EQ(triangles.size(), corners - 2);
        }
}

TEST_F(Obj, IndicesOutOfRangeNameTheLine) {
    for (const char* face : {"f 1 2 4", "f 1 2 -4", "f 1 2 0", "f 1 2 200000000", "f 1/1 2/1 3/1",
                             "f 1//1 2//1 3//1", "f 1 2 abc"})
        EXPECT_NE(error_of_text("a.obj", kTriangle + "# comment\n" + face + "\n").find("a.obj:5: "),
                  std::string::npos)
            << face;
}

TEST_F(Obj, IndexThatWouldWrapAroundIsAnError) {
    EXPECT_NE(error_of_text("a.obj", kTriangle + "f 1 2 4294967299\n").find("digits"),
              std::string::npos);
    EXPECT_NE(error_of_text("a.obj", kTriangle + "f 1 2 18446744073709551619\n").find("digits"),
              std::string::npos);
}

TEST_F(Obj, MalformedNumbersNameTheLine) {
    for (const char* line : {"v 1 2", "v 1 two 3", "v 1 2 nan", "v inf 0 0", "v 1.2.3 0 0",
                             "v 0x10 0 0", "vn 1 0", "vt", "v"})
        EXPECT_NE(error_of_text("a.obj", kTriangle + line + " \nf 1 2 3\n").find("a.obj:4: "),
                  std::string::npos)
            << line;
}

TEST_F(Obj, OverflowingCoordinatesDropTheirTriangles) {
    const Scene scene =
        load_text("a.obj", kTriangle + "v 1e30 0 0\nv 1e999 0 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
    EXPECT_EQ(scene.triangle_count(), 1u);
    EXPECT_TRUE(warns(scene, "2 triangles with coordinates that are not finite"));
}

TEST_F(Obj, EmptyAndFacelessFilesAreErrors) {
    EXPECT_NE(error_of_text("a.obj", "").find("no triangles"), std::string::npos);
    EXPECT_NE(error_of_text("a.obj", kTriangle).find("no triangles"), std::string::npos);
    EXPECT_NE(error_of_text("a.obj", kTriangle + "f 1 2\n").find("no triangles"),
              std::string::npos);
}

TEST_F(Obj, TruncatedAnywhereIsLoadedOrRefused) {
    write("m.mtl", "newmtl red\nKd 1 0 0\n");
    const std::string whole = "mtllib m.mtl\n" + kTriangle +
                              "vt 0.25 0.5\nvn 0 0 1\nusemtl red\nf 1/1/1 2/1/1 3/1/1\nf 3 2 1\n";
    for (std::size_t length = 0; length < whole.size(); ++length) {
        write("cut.obj", whole.substr(0, length));
        try {
            EXPECT_GE(load_written("cut.obj").triangle_count(), 1u);
        } catch (const SceneError& error) {
            EXPECT_NE(std::string(error.what()).find("cut"), std::string::npos);
        }
    }
}

TEST_F(Obj, RandomBytesAreLoadedOrRefused) {
    std::uint32_t state = 1;
    for (int round = 0; round < 200; ++round) {
        std::string text = kTriangle + "f 1 2 3\nusemtl x\nf 1/2/3 4//5 -6\nvt 1 2\nmtllib a b\n";
        for (int change = 0; change < 6; ++change) {
            state = state * 1664525u + 1013904223u;
            text[state / 7 % text.size()] = static_cast<char>(state >> 24);
        }
        write("noise.obj", text);
        try {
            load_written("noise.obj");
        } catch (const SceneError&) {
        }
    }
}

TEST_F(Obj, CarriageReturnsTabsAndTrailingBlanks) {
    write("m.mtl", "newmtl red \r\n\tKd\t1 0 0\t\r\n");
    const Scene scene = load_text(
        "a.obj",
        "mtllib m.mtl \r\nv\t0 0 0\r\n  v 1 0 0 \r\nv 0 1 0\r\nusemtl  red\r\nf 1 2 3 \r\n");
    EXPECT_EQ(scene.materials[scene.meshes[0].triangle_material[0]].diffuse, glm::vec3(1, 0, 0));
}

TEST_F(Obj, LibraryNamesMayHoldBlanksAndBackslashes) {
    write("my folder/my materials.mtl", "newmtl a b\nKd 0 1 0 # green\n");
    const Scene scene = load_text("a.obj", "mtllib my folder\\my materials.mtl\n" + kTriangle +
                                               "usemtl a b\nf 1 2 3\n");
    EXPECT_EQ(scene.materials[scene.meshes[0].triangle_material[0]].diffuse, glm::vec3(0, 1, 0));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(Obj, NamesMayDifferInTheCaseOfLetters) {
    write("Maps/Materials.MTL", "newmtl a\nKd 0 1 0\n");
    const Scene scene =
        load_text("a.obj", "mtllib maps/materials.mtl\n" + kTriangle + "usemtl a\nf 1 2 3\n");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.materials[0].diffuse, glm::vec3(0, 1, 0));
}

TEST_F(Obj, MissingLibraryAndMaterialAreWarnedOf) {
    const Scene scene =
        load_text("a.obj", "mtllib gone.mtl\n" + kTriangle + "f 1 2 3\nusemtl gone\nf 1 2 3\n");
    EXPECT_TRUE(warns(scene, "'gone.mtl' cannot be found"));
    EXPECT_TRUE(warns(scene, "material 'gone' is not defined"));
    EXPECT_EQ(scene.materials.size(), 2u);
}

TEST_F(Obj, DissolveWinsOverTransparency) {
    write("m.mtl", "newmtl a\nd 0.25\nTr 0.1\nnewmtl b\nTr 0.25\nnewmtl c\nd -halo 0.5\n");
    const Scene scene = load_text("a.obj", "mtllib m.mtl\n" + kTriangle + "f 1 2 3\n");
    EXPECT_FLOAT_EQ(scene.materials[0].opacity, 0.25f);
    EXPECT_FLOAT_EQ(scene.materials[1].opacity, 0.75f);
    EXPECT_FLOAT_EQ(scene.materials[2].opacity, 0.5f);
}

TEST_F(Obj, IlluminationModelsMirrorAndRefract) {
    write("m.mtl",
          "newmtl a\nillum 3\nKs 0.5 0.5 0.5\nnewmtl b\nillum 7\nKs 0.1 0.1 0.1\n"
          "Tf 0.9 0.8 0.7\nNi 1.33\nnewmtl c\nillum 6\nd 0.25\nnewmtl d\nillum 2\nd 0.5\n");
    const Scene scene = load_text("a.obj", "mtllib m.mtl\n" + kTriangle + "f 1 2 3\n");
    EXPECT_EQ(scene.materials[0].reflectivity, glm::vec3(0.5f));
    EXPECT_EQ(scene.materials[0].transmission, glm::vec3(0.0f));
    EXPECT_EQ(scene.materials[1].reflectivity, glm::vec3(0.1f));
    EXPECT_EQ(scene.materials[1].transmission, glm::vec3(0.9f, 0.8f, 0.7f));
    EXPECT_FLOAT_EQ(scene.materials[1].index_of_refraction, 1.33f);
    EXPECT_EQ(scene.materials[2].transmission, glm::vec3(0.75f)); // no Tf: 1 - d
    EXPECT_EQ(scene.materials[3].alpha_mode, AlphaMode::blend);
    EXPECT_EQ(scene.materials[3].transmission, glm::vec3(0.0f));
}

TEST_F(Obj, MalformedMaterialValuesKeepTheirDefaultAndWarn) {
    write("m.mtl", "newmtl a\nKd red 0 0\nNs many\nKs 0.5\n");
    const Scene scene = load_text("a.obj", "mtllib m.mtl\n" + kTriangle + "usemtl a\nf 1 2 3\n");
    EXPECT_TRUE(warns(scene, "m.mtl:2: 'Kd red 0 0' is ignored"));
    EXPECT_TRUE(warns(scene, "m.mtl:3: 'Ns many' is ignored"));
    EXPECT_EQ(scene.materials[0].specular, glm::vec3(0.5f)); // one value stands for three
}

TEST_F(Obj, MissingTextureIsNamedAndVisible) {
    write("m.mtl", "newmtl a\nmap_Kd no such.png\nmap_d gone.png\n");
    const Scene scene = load_text("a.obj", "mtllib m.mtl\n" + kTriangle + "usemtl a\nf 1 2 3\n");
    EXPECT_TRUE(warns(scene, "texture no such.png"));
    ASSERT_NE(scene.materials[0].diffuse_texture, kNoTexture);
    const MipLevel& level = scene.textures[scene.materials[0].diffuse_texture].levels[0];
    EXPECT_EQ(level.rgba[0], 255);
    EXPECT_EQ(level.rgba[1], 0);
    EXPECT_EQ(level.rgba[2], 255);
}

TEST_F(Obj, TexturesOutsideTheFolderAreRefused) {
    write("m.mtl", "newmtl a\nmap_Kd ../../etc/x.png\nmap_d /etc/passwd\nmap_Ks C:\\x.png\n");
    const Scene scene = load_text("a.obj", "mtllib m.mtl\n" + kTriangle + "usemtl a\nf 1 2 3\n");
    std::size_t refused = 0;
    for (const std::string& warning : scene.warnings)
        refused += warning.find("leads out of the scene's folder") != std::string::npos;
    EXPECT_EQ(refused, 3u);
}

TEST_F(Obj, VerticesAreSharedAndSeamsSplit) {
    const Scene scene = load_text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\n"
                                           "f 1/1 2/1 3/1\nf 1/1 3/1 4/1\nf 1/2 3/1 4/1\n");
    EXPECT_EQ(scene.meshes[0].positions.size(), 5u);
    EXPECT_EQ(scene.meshes[0].uvs.size(), 5u);
}

TEST_F(Obj, ManyVerticesAtOnePositionTakeLinearTime) {
    std::string text = kTriangle;
    for (int i = 1; i <= 60000; ++i)
        text += "vt " + std::to_string(i) + " 0\nf 1/" + std::to_string(i) + " 2/1 3/1\n";
    EXPECT_EQ(load_text("a.obj", text).triangle_count(), 60000u);
}

} // namespace
} // namespace macula::scene
