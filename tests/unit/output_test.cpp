#include "host/output/image.hpp"

#include <filesystem>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace {
namespace fs = std::filesystem;
using namespace macula::output;

class Output : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("macula-output-" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path folder_;
};

TEST_F(Output, ExrKeepsChannelsBitsAndMetadata) {
    const std::vector<float> colour = {0.25f, 0.5f, 1.0f, 2.0f, 1e-3f, 70000.0f};
    const std::vector<float> depth = {1.0000001f, 3.4e30f};
    const std::vector<Layer> layers = {{{"R", "G", "B"}, colour, false}, {{"Z"}, depth, false}};
    const fs::path path = folder_ / "frame.exr";
    write_exr(path, 2, 1, layers, {{"method", "full"}});
    const auto in = OIIO::ImageInput::open(path.string());
    ASSERT_TRUE(in);
    EXPECT_EQ(in->spec().channelnames, (std::vector<std::string>{"R", "G", "B", "Z"}));
    EXPECT_EQ(in->spec().get_string_attribute("macula:method"), "full");
    std::vector<float> read(8);
    ASSERT_TRUE(in->read_image(OIIO::TypeDesc::FLOAT, read.data()));
    EXPECT_EQ(read,
              (std::vector<float>{0.25f, 0.5f, 1.0f, 1.0000001f, 2.0f, 1e-3f, 70000.0f, 3.4e30f}));
}

TEST_F(Output, PngIsSrgbAndClamped) {
    EXPECT_EQ(encode_srgb(-1.0f), 0);
    EXPECT_EQ(encode_srgb(0.0f), 0);
    EXPECT_EQ(encode_srgb(0.21404114f), 128); // half of full drive
    EXPECT_EQ(encode_srgb(9.0f), 255);
    const std::vector<float> rgb(3 * 6, 0.21404114f);
    write_png(folder_ / "a b.png", 3, 2, rgb, 1.0f, {});
    const auto in = OIIO::ImageInput::open((folder_ / "a b.png").string());
    ASSERT_TRUE(in);
    std::vector<unsigned char> read(18);
    ASSERT_TRUE(in->read_image(OIIO::TypeDesc::UINT8, read.data()));
    EXPECT_EQ(read, std::vector<unsigned char>(18, 128));
}

TEST_F(Output, FailureNamesTheFileAndLeavesNothingBehind) {
    const std::vector<float> rgb(3);
    const fs::path missing = folder_ / "no such folder" / "x.png";
    try {
        write_png(missing, 1, 1, rgb, 1.0f, {});
        FAIL() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("no such folder"), std::string::npos);
    }
    EXPECT_THROW(write_png(folder_ / "x.png", 2, 2, rgb, 1.0f, {}), std::runtime_error);
    EXPECT_TRUE(fs::is_empty(folder_));
}

} // namespace
