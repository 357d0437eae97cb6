#include "host/output/image.hpp"

#include <cstring>
#include <filesystem>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace {
namespace fs = std::filesystem;
using namespace macula::output;

std::vector<std::uint32_t> words_of(const std::vector<float>& floats) {
    std::vector<std::uint32_t> words(floats.size());
    std::memcpy(words.data(), floats.data(), floats.size() * sizeof(float));
    return words;
}

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
    const auto colour = words_of({0.25f, 0.5f, 1.0f, 2.0f, 1e-3f, 70000.0f});
    const auto depth = words_of({1.0000001f, 3.4e30f});
    const std::vector<std::uint32_t> ids = {0xffffffffu, 33554433u};
    const std::vector<Layer> layers = {
        {{"R", "G", "B"}, colour, 3, false}, {{"Z"}, depth, 1, false}, {{"Id"}, ids, 1, true}};
    const fs::path path = folder_ / "frame.exr";
    write_exr(path, 2, 1, layers, {{"method", "full"}});
    const auto in = OIIO::ImageInput::open(path.string());
    ASSERT_TRUE(in);
    EXPECT_EQ(in->spec().channelnames, (std::vector<std::string>{"R", "G", "B", "Z", "Id"}));
    EXPECT_EQ(in->spec().get_string_attribute("macula:method"), "full");
    std::vector<std::uint32_t> read(10);
    // read_image() cannot give mixed channel formats as they are.
    ASSERT_TRUE(in->read_native_scanlines(0, 0, 0, 1, 0, read.data()));
    std::vector<std::uint32_t> expected = words_of({0.25f, 0.5f, 1.0f, 1.0000001f});
    expected.push_back(0xffffffffu);
    const std::vector<std::uint32_t> second = words_of({2.0f, 1e-3f, 70000.0f, 3.4e30f});
    expected.insert(expected.end(), second.begin(), second.end());
    expected.push_back(33554433u);
    EXPECT_EQ(read, expected);
}

TEST_F(Output, PngIsSrgbAndClamped) {
    EXPECT_EQ(encode_srgb(-1.0f), 0);
    EXPECT_EQ(encode_srgb(0.0f), 0);
    EXPECT_EQ(encode_srgb(0.21404114f), 128); // half of full drive
    EXPECT_EQ(encode_srgb(9.0f), 255);
    const std::vector<float> rgb(3 * 6, 0.21404114f);
    write_png(folder_ / "a b.png", 3, 2, rgb, 3, 1.0f, {});
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
        write_png(missing, 1, 1, rgb, 3, 1.0f, {});
        FAIL() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("no such folder"), std::string::npos);
    }
    EXPECT_THROW(write_png(folder_ / "x.png", 2, 2, rgb, 3, 1.0f, {}), std::runtime_error);
    EXPECT_TRUE(fs::is_empty(folder_));
}

} // namespace
