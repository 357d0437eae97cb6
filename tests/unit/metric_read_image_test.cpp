// Reading pictures for scores: what is refused, and that what is read is what was written.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/output/read_image.hpp"
#include "tests/support/picture_files.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/png_bytes.hpp"

namespace macula::output {
namespace {

using metric::Picture;
using test::noise;
using test::PngBytes;
using testing::AllOf;
using testing::HasSubstr;

class ReadImage : public test::PictureFiles {
  protected:
    // The message of reading a file.
    std::string refusal(const std::string& name) const {
        try {
            read_picture(path(name));
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "nothing thrown";
    }
};

TEST_F(ReadImage, ExrGivesTheFloatsThatWereWritten) {
    const Picture picture = noise(17, 9, 1, 30.0f);
    write_exr("a.exr", picture);
    const ReadPicture found = read_picture(path("a.exr"));
    EXPECT_EQ(found.kind, ImageKind::exr);
    EXPECT_EQ(found.picture.width, 17u);
    EXPECT_EQ(found.picture.height, 9u);
    EXPECT_EQ(found.picture.rgb, picture.rgb);
    EXPECT_FALSE(found.motion);
    EXPECT_THROW(read_motion(path("a.exr")), std::runtime_error);
}

TEST_F(ReadImage, ExrChannelsAreFoundByName) {
    const Picture picture = noise(5, 4, 2);
    metric::MotionField motion{5, 4, std::vector<float>(40)};
    for (std::size_t i = 0; i < 40; ++i)
        motion.xy[i] = static_cast<float>(i) - 20.5f;
    write_exr("a.exr", picture, &motion, {"B", "R", "G"});
    const ReadPicture found = read_picture(path("a.exr"));
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        EXPECT_EQ(found.picture.rgb[3 * i + 2], picture.rgb[3 * i]);
        EXPECT_EQ(found.picture.rgb[3 * i], picture.rgb[3 * i + 1]);
        EXPECT_EQ(found.picture.rgb[3 * i + 1], picture.rgb[3 * i + 2]);
    }
    ASSERT_TRUE(found.motion);
    EXPECT_EQ(found.motion->xy, motion.xy);
    EXPECT_EQ(read_motion(path("a.exr")).xy, motion.xy);
}

TEST_F(ReadImage, PngIsDecodedFromSrgb) {
    write_bytes("a.png", PngBytes::make(3, 1, 8, 2,
                                        {std::string("\x00\x0a\xff\x80\x80\x80\x01\x02\x03", 9)}));
    const auto linear = [](double x) {
        return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    };
    const int bytes[9] = {0, 10, 255, 128, 128, 128, 1, 2, 3};
    const ReadPicture found = read_picture(path("a.png"));
    EXPECT_EQ(found.kind, ImageKind::png);
    for (std::size_t i = 0; i < 9; ++i)
        EXPECT_NEAR(found.picture.rgb[i], linear(bytes[i] / 255.0), 1e-6) << i;
    // 16 bits, and an alpha that is opaque everywhere.
    write_bytes("b.png", PngBytes::make(1, 1, 16, 2, {std::string("\x80\x00\x00\x01\xff\xff", 6)}));
    EXPECT_NEAR(read_picture(path("b.png")).picture.rgb[0], linear(32768 / 65535.0), 1e-6);
    EXPECT_NEAR(read_picture(path("b.png")).picture.rgb[1], linear(1 / 65535.0), 1e-9);
    write_bytes("c.png", PngBytes::make(1, 1, 8, 6, {"\x40\x50\x60\xff"}));
    EXPECT_NEAR(read_picture(path("c.png")).picture.rgb[0], linear(64 / 255.0), 1e-6);
}

TEST_F(ReadImage, OurPngsComeBackWithinHalfAStep) {
    const Picture picture = noise(31, 7, 3);
    write_png("a.png", picture);
    const Picture found = read_picture(path("a.png")).picture;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i)
        EXPECT_NEAR(encode_srgb(found.rgb[i]), encode_srgb(picture.rgb[i]), 0) << i;
}

TEST_F(ReadImage, RefusesUnsuitableChannelsAndDepths) {
    write_bytes("grey.png", PngBytes::make(2, 1, 8, 0, {"\x10\x20"}));
    EXPECT_THAT(refusal("grey.png"), AllOf(HasSubstr("grey.png"), HasSubstr("no channel R")));
    write_bytes("glass.png", PngBytes::make(1, 1, 8, 6, {"\x40\x50\x60\x70"}));
    EXPECT_THAT(refusal("glass.png"), AllOf(HasSubstr("glass.png"), HasSubstr("transparent")));
    write_exr("yuv.exr", noise(2, 2, 1), nullptr, {"Y", "U", "V"});
    EXPECT_THAT(refusal("yuv.exr"),
                AllOf(HasSubstr("yuv.exr"), HasSubstr("no channel R"), HasSubstr("channels are")));
    const std::vector<std::uint32_t> words(12, 7);
    const Layer layer{{"R", "G", "B"}, words, 3, true};
    write_exr("whole.exr", noise(2, 2, 1));
    output::write_exr(path("whole.exr"), 2, 2, {&layer, 1}, {});
    EXPECT_THAT(refusal("whole.exr"),
                AllOf(HasSubstr("whole.exr"), HasSubstr("uint"), HasSubstr("half or float")));
}

TEST_F(ReadImage, NamesThePixelThatIsNotANumber) {
    Picture picture = noise(8, 6, 4);
    picture.rgb[3 * (4 * 8 + 7) + 2] = std::nanf("");
    write_exr("nan.exr", picture);
    EXPECT_THAT(refusal("nan.exr"),
                AllOf(HasSubstr("nan.exr"), HasSubstr("pixel (7, 4) is not a number")));
    picture.rgb[3 * (4 * 8 + 7) + 2] = 1.0f;
    picture.rgb[0] = -INFINITY;
    write_exr("nan.exr", picture);
    EXPECT_THAT(refusal("nan.exr"), HasSubstr("pixel (0, 0) is infinite"));
}

TEST_F(ReadImage, RefusesFilesThatAreCutOff) {
    for (const double part : {0.0, 0.01, 0.3, 0.6, 0.95}) {
        write_png("cut.png", noise(60, 50, 5));
        truncate("cut.png", part);
        EXPECT_THAT(refusal("cut.png"), AllOf(HasSubstr("reading '"), HasSubstr("cut.png")))
            << part;
        write_exr("cut.exr", noise(60, 50, 6));
        truncate("cut.exr", part);
        EXPECT_THAT(refusal("cut.exr"), AllOf(HasSubstr("reading '"), HasSubstr("cut.exr")))
            << part;
    }
}

TEST_F(ReadImage, RefusesWhatIsNoPicture) {
    EXPECT_THAT(refusal("none.png"), HasSubstr("none.png': there is no such file"));
    EXPECT_THAT(refusal(""), HasSubstr("there is no such file"));
    write_bytes("text.png", "not an image");
    EXPECT_THAT(refusal("text.png"), HasSubstr("text.png"));
    // A bitmap of 1 x 1 pixel under the name of a PNG.
    const std::string bitmap("BM\x3a\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\1\0\0\0\1\0\0\0\1\0\x18\0"
                             "\0\0\0\0\4\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\1\2\3\0",
                             58);
    write_bytes("bitmap.bmp", bitmap);
    EXPECT_THAT(refusal("bitmap.bmp"), HasSubstr("a bmp file; PNG or EXR was expected"));
}

TEST_F(ReadImage, RefusesACropOfALargerPicture) {
    write_exr("crop.exr", noise(8, 6, 7));
    std::string bytes = bytes_of("crop.exr");
    const std::string name("displayWindow\0box2i\0", 20);
    const std::size_t at = bytes.find(name);
    ASSERT_NE(at, std::string::npos);
    bytes[at + name.size() + 4 + 8] = 20; // its rightmost column
    write_bytes("crop.exr", bytes);
    EXPECT_THAT(refusal("crop.exr"), HasSubstr("a crop: 8 x 6 pixels at (0, 0) of 21 x 6"));
}

TEST_F(ReadImage, RefusesAbsurdSizesBeforeTakingMemory) {
    write_bytes("huge.png", PngBytes::make(60000, 60000, 8, 2, {"\x01\x02\x03"}));
    EXPECT_THAT(refusal("huge.png"),
                AllOf(HasSubstr("huge.png"), HasSubstr("60000 x 60000 pixels")));
}

} // namespace
} // namespace macula::output
