// Textures: decoding, mip chains, masks, normal maps.
#include <cmath>

#include <OpenImageIO/imageio.h>

#include "scenes/image.hpp"
#include "scenes/texture_set.hpp"
#include "tests/support/scene_folder.hpp"

namespace macula::scene {
namespace {

using Bytes = std::vector<std::uint8_t>;

Image image_of(std::uint32_t width, std::uint32_t height, Bytes rgba) {
    return {width, height, std::move(rgba), false, std::max(width, height)};
}

Image filled(std::uint32_t width, std::uint32_t height, std::uint8_t value) {
    return image_of(width, height, Bytes(std::size_t{width} * height * 4, value));
}

class Images : public SceneFolder {
  protected:
    void write_image(const std::string& name, int width, int height, int channels,
                     const Bytes& pixels) const {
        const auto out = OIIO::ImageOutput::create(path(name));
        ASSERT_TRUE(out);
        OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
        spec.attribute("oiio:UnassociatedAlpha", 1);
        ASSERT_TRUE(out->open(path(name), spec));
        ASSERT_TRUE(out->write_image(OIIO::TypeDesc::UINT8, pixels.data()));
        ASSERT_TRUE(out->close());
    }
};

TEST(Mips, AreCompleteDownToOneTexelForEverySize) {
    for (const auto& [width, height] :
         {std::pair{1u, 1u}, {1u, 7u}, {5u, 1u}, {7u, 5u}, {64u, 3u}, {100u, 37u}, {256u, 256u}}) {
        const std::vector<MipLevel> levels = build_mips(filled(width, height, 200), true);
        EXPECT_EQ(levels.front().width, width);
        EXPECT_EQ(levels.back().width, 1u);
        EXPECT_EQ(levels.back().height, 1u);
        for (const MipLevel& level : levels) {
            ASSERT_EQ(level.rgba.size(), std::size_t{level.width} * level.height * 4);
            for (const std::uint8_t value : level.rgba)
                ASSERT_EQ(value, 200) << width << " x " << height;
        }
    }
}

TEST(Mips, AverageColoursInLinearLight) {
    const Bytes black_white = {0, 0, 0, 255, 255, 255, 255, 255};
    EXPECT_EQ(build_mips(image_of(2, 1, black_white), true).back().rgba[0], 188); // sRGB of 0.5
    EXPECT_EQ(build_mips(image_of(2, 1, black_white), false).back().rgba[0], 128);
}

TEST(Mips, InvisibleTexelsLendNoColour) {
    const Bytes green_and_clear = {0, 200, 0, 255, 255, 0, 255, 0};
    const MipLevel top = build_mips(image_of(2, 1, green_and_clear), true).back();
    EXPECT_EQ(top.rgba[0], 0);
    EXPECT_EQ(top.rgba[1], 200);
    EXPECT_EQ(top.rgba[3], 128);
}

TEST(Mips, OddSizesWeighTexelsByArea) {
    const Bytes row = {0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 255};
    EXPECT_EQ(build_mips(image_of(3, 1, row), false).back().rgba[0], 85);
}

TEST(Masks, ComeFromRedOrFromAlphaWhereColourDoesNotVary) {
    Image grey = image_of(2, 1, {10, 0, 0, 255, 240, 0, 0, 255});
    to_mask(grey);
    EXPECT_EQ(grey.rgba, (Bytes{10, 10, 10, 255, 240, 240, 240, 255}));
    Image alpha = image_of(2, 1, {255, 255, 255, 0, 255, 255, 255, 200});
    alpha.has_alpha = true;
    to_mask(alpha);
    EXPECT_EQ(alpha.rgba, (Bytes{0, 0, 0, 255, 200, 200, 200, 255}));
}

TEST(NormalMaps, FlatHeightsGiveTheSurfacesOwnNormal) {
    Image flat = filled(4, 4, 77);
    bump_to_normal(flat, 4.0f);
    for (std::size_t i = 0; i < flat.rgba.size(); i += 4) {
        EXPECT_EQ(flat.rgba[i], 128);
        EXPECT_EQ(flat.rgba[i + 1], 128);
        EXPECT_EQ(flat.rgba[i + 2], 255);
    }
}

TEST(NormalMaps, RisingHeightsLeanBackwards) {
    Image ramp = filled(8, 8, 255);
    for (std::size_t y = 0; y < 8; ++y)
        for (std::size_t x = 0; x < 8; ++x)
            ramp.rgba[(y * 8 + x) * 4] = static_cast<std::uint8_t>(20 * x);
    Image turned = ramp;
    bump_to_normal(ramp, 4.0f);
    const std::size_t middle = (3 * 8 + 3) * 4;
    EXPECT_LT(ramp.rgba[middle], 128); // rises along u: leans to -u
    EXPECT_EQ(ramp.rgba[middle + 1], 128);
    EXPECT_TRUE(looks_like_normal_map(ramp));
    EXPECT_FALSE(looks_like_normal_map(turned));
    for (int grey = 0; grey < 256; ++grey)
        EXPECT_FALSE(looks_like_normal_map(filled(2, 2, static_cast<std::uint8_t>(grey))));
}

TEST_F(Images, GreyColourAndAlphaAreSpreadOverFourChannels) {
    write_image("g.png", 2, 1, 1, {7, 9});
    write_image("c.png", 1, 1, 3, {1, 2, 3});
    write_image("a.png", 1, 1, 4, {200, 100, 50, 10});
    EXPECT_EQ(decode_image(path("g.png")).rgba, (Bytes{7, 7, 7, 255, 9, 9, 9, 255}));
    EXPECT_EQ(decode_image(path("c.png")).rgba, (Bytes{1, 2, 3, 255}));
    const Image alpha = decode_image(path("a.png"));
    EXPECT_EQ(alpha.rgba, (Bytes{200, 100, 50, 10})); // not multiplied by alpha
    EXPECT_TRUE(alpha.has_alpha);
}

TEST_F(Images, TopRowOfTheFileIsTheTopOfVInObj) {
    write_image("t.png", 1, 2, 3, {255, 0, 0, 0, 0, 255});
    write("m.mtl", "newmtl a\nmap_Kd t.png\nmap_Ks -clamp on t.png\n");
    const Scene scene =
        load_text("a.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    const Texture& texture = scene.textures[scene.materials[0].diffuse_texture];
    EXPECT_EQ(texture.levels[0].rgba, (Bytes{0, 0, 255, 255, 255, 0, 0, 255}));
    EXPECT_EQ(texture.wrap_u, Wrap::repeat);
    EXPECT_EQ(scene.textures[scene.materials[0].specular_texture].wrap_v, Wrap::clamp);
}

TEST_F(Images, AlphaInTheColourTextureMasks) {
    write_image("t.png", 2, 1, 4, {255, 0, 0, 255, 0, 255, 0, 0});
    write("m.mtl", "newmtl a\nmap_Kd t.png\n");
    const Scene scene =
        load_text("a.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::mask);
    EXPECT_EQ(scene.materials[0].alpha_texture, kNoTexture);
}

TEST_F(Images, LargeImagesAreHalvedWithAWarning) {
    write_image("wide.png", 16384, 3, 3, Bytes(std::size_t{16384} * 3 * 3, 90));
    write("m.mtl", "newmtl a\nmap_Kd wide.png\n");
    const Scene scene =
        load_text("a.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    EXPECT_EQ(scene.textures[0].levels[0].width, 8192u);
    EXPECT_EQ(scene.textures[0].levels[0].height, 2u);
    EXPECT_EQ(scene.textures[0].levels[0].rgba[0], 90);
    EXPECT_TRUE(warns(scene, "16384 texels"));
}

TEST_F(Images, DamagedFilesAreErrors) {
    write_image("good.png", 64, 64, 3, Bytes(64 * 64 * 3, 9));
    std::ifstream file(path("good.png"), std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    write("empty.png", "");
    write("text.png", "this is no image");
    write("cut.png", bytes.substr(0, bytes.size() / 2));
    std::filesystem::create_directories(path("folder.png"));
    for (const char* name : {"empty.png", "text.png", "folder.png", "gone.png"})
        EXPECT_THROW(decode_image(path(name)), SceneError) << name;
    try {
        decode_image(path("cut.png"));
    } catch (const SceneError&) {
    }
    EXPECT_THROW(decode_image(Bytes{'B', 'M', 0, 0}, "embedded"), SceneError);
    EXPECT_THROW(decode_image(Bytes{0x89, 'P', 'N', 'G', 1, 2, 3}, "embedded"), SceneError);
}

} // namespace
} // namespace macula::scene
