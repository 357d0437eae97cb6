// `macula compare` as a program: what it prints, which frames it pairs, what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/picture_files.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/png_bytes.hpp"
#include "tests/support/program.hpp"

namespace macula {
namespace {

using nlohmann::json;
using test::noise;
using test::plain;
using test::texture;
using testing::AllOf;
using testing::HasSubstr;

class CompareProgram : public test::PictureFiles {
  protected:
    test::Ended compare(const std::string& arguments) const {
        return test::run_macula("compare " + arguments, folder_.string());
    }
    json document(const std::string& arguments) const {
        const test::Ended ended = compare("--json " + arguments);
        EXPECT_EQ(ended.code, 0) << ended.text;
        return json::parse(ended.text);
    }
    // What it says when it fails.
    std::string refusal(const std::string& arguments) const {
        const test::Ended ended = compare(arguments);
        EXPECT_EQ(ended.code, 1) << ended.text;
        return ended.text;
    }
    // Frames 0 .. count - 1 of a still picture; brighter every second frame by `flicker`.
    void write_frames(const std::string& folder, int count, float flicker = 0.0f) const {
        for (int frame = 0; frame < count; ++frame) {
            metric::Picture picture = texture(40, 30);
            for (float& value : picture.rgb)
                value += frame % 2 == 0 ? 0.0f : flicker;
            write_png(folder + "/frame_000" + std::to_string(frame) + ".png", picture);
        }
    }
};

TEST_F(CompareProgram, IdenticalPicturesScoreZeroOneAndInfinity) {
    write_png("a.png", noise(40, 30, 1));
    write_png("b.png", noise(40, 30, 1));
    const json found = document("a.png b.png");
    for (const char* key :
         {"flip_mean", "flip_weighted_median", "flip_q1", "flip_q3", "flip_min", "flip_max", "mse"})
        EXPECT_EQ(found[key], 0.0) << key;
    EXPECT_EQ(found["ssim"], 1.0);
    EXPECT_TRUE(found["psnr"].is_null());
    EXPECT_EQ(found["ppd"], 67.02);
    EXPECT_EQ(found["ppd_source"], "default");
    EXPECT_EQ(found["bands"], json::array());
    EXPECT_THAT(compare("a.png b.png").text,
                AllOf(HasSubstr("67.02 pixels per degree (default)"), HasSubstr("PSNR inf dB")));
}

TEST_F(CompareProgram, SeveralTestsGetALineEach) {
    write_png("a.png", plain(20, 20, 0, 0, 0));
    write_png("b.png", plain(20, 20, 1, 1, 1));
    const test::Ended ended = compare("a.png a.png b.png --json --heatmap maps/heat.png");
    ASSERT_EQ(ended.code, 0) << ended.text;
    const std::size_t end = ended.text.find('\n');
    const json first = json::parse(ended.text.substr(0, end)),
               second = json::parse(ended.text.substr(end));
    EXPECT_EQ(first["test"], "a.png");
    EXPECT_EQ(first["flip_mean"], 0.0);
    EXPECT_GT(second["flip_mean"], 0.9);
    EXPECT_EQ(second["heat_maps"], json({"maps/heat_2.png"}));
    EXPECT_TRUE(std::filesystem::exists(path("maps/heat_1.png")));
}

TEST_F(CompareProgram, DensityComesFromTheDisplay) {
    write_png("a.png", texture(118, 146));
    const json of_display = document("a.png a.png --display dk2");
    EXPECT_NEAR(of_display["ppd"].get<double>(), 0.96, 0.01) << "a tenth of the DK2's pixels";
    EXPECT_EQ(of_display["ppd_source"], "display");
    EXPECT_EQ(document("a.png a.png --display dk2 --ppd 20")["ppd"], 20.0);
}

TEST_F(CompareProgram, GazeMakesBands) {
    const metric::Picture picture = texture(160, 120);
    write_png("a.png", picture);
    write_png("b.png", test::blurred_at(picture, 30, 60, 20));
    // 4 pixels a degree: the blur lies about 12 degrees to the left.
    const json at = document("a.png b.png --ppd 4 --gaze pixel:30,60");
    const json beside = document("a.png b.png --ppd 4 --gaze pixel:130,60");
    EXPECT_EQ(at["flip_mean"], beside["flip_mean"]);
    EXPECT_GT(at["foveated_flip_mean"], beside["foveated_flip_mean"]);
    ASSERT_EQ(at["bands"].size(), 4u);
    EXPECT_EQ(at["bands"][0]["name"], "fovea");
    EXPECT_GT(at["bands"][0]["flip_mean"], 0.0);
    EXPECT_EQ(beside["bands"][0]["flip_mean"], 0.0);
    std::size_t pixels = 0;
    for (const json& band : at["bands"])
        pixels += band["pixels"].get<std::size_t>();
    EXPECT_EQ(pixels, 160u * 120);
}

TEST_F(CompareProgram, SequencesAreScoredFrameByFrameAndInTime) {
    write_frames("still", 4);
    write_frames("flicker", 4, 0.1f);
    const json found = document("still flicker --still --gaze 0,0 --heatmap heat.png");
    EXPECT_EQ(found["frames"], 4);
    ASSERT_EQ(found["per_frame"].size(), 4u);
    EXPECT_EQ(found["per_frame"][0]["flip_mean"], 0.0);
    EXPECT_NEAR(found["per_frame"][3]["gaze_degrees"][1].get<double>(), 0.0, 1e-9);
    EXPECT_GT(found["per_frame"][1]["flip_mean"], 0.01);
    EXPECT_GT(found["instability"], 0.01);
    EXPECT_GT(found["flicker_energy"], 1e-4);
    EXPECT_GT(found["bands"][0]["instability"], 0.01);
    EXPECT_TRUE(std::filesystem::exists(path("heat_0003.png")));
    EXPECT_EQ(document("still still --still")["instability"], 0.0);
    EXPECT_EQ(document("'still/frame_%04d.png' 'flicker/frame_%04d.png' --frames 1:3")["frames"],
              2);
    EXPECT_THAT(document("still flicker")["no_temporal_scores"], HasSubstr("--motion"));
}

TEST_F(CompareProgram, MotionComesFromTheReferenceOrFromASequence) {
    // A texture that moves by one pixel a frame, and motion that says so.
    metric::MotionField motion{40, 30, std::vector<float>(2400, 0.0f)};
    for (std::size_t i = 0; i < motion.xy.size(); i += 2)
        motion.xy[i] = -1.0f;
    for (int frame = 0; frame < 3; ++frame) {
        metric::Picture picture{40, 30, {}};
        const metric::Picture whole = texture(44, 30);
        for (std::size_t y = 0; y < 30; ++y)
            picture.rgb.insert(picture.rgb.end(), &whole.rgb[3 * (y * 44 + 3 - frame)],
                               &whole.rgb[3 * (y * 44 + 3 - frame)] + 120);
        const std::string name = "/frame_" + std::to_string(frame) + ".exr";
        write_exr("moving" + name, picture, &motion);
        write_exr("plain" + name, picture);
        write_exr("grey" + name, plain(40, 30, 0.3f, 0.3f, 0.3f));
    }
    // A grey test changes nothing; the reference changes nothing either where motion is known.
    EXPECT_NEAR(document("moving grey")["instability"].get<double>(), 0.0, 1e-6);
    EXPECT_NEAR(document("plain grey --motion moving")["instability"].get<double>(), 0.0, 1e-6);
    EXPECT_LT(document("plain grey --still")["instability"].get<double>(), -0.05);
    EXPECT_THAT(refusal("plain grey --motion grey"), HasSubstr("no channel Motion.X"));
}

TEST_F(CompareProgram, NamesTheFrameThatIsMissing) {
    write_frames("a", 4);
    write_frames("b", 3);
    EXPECT_THAT(refusal("a b"), HasSubstr("\"b\": frame 3 is missing ('b/frame_0003.png')"));
    EXPECT_THAT(refusal("b a"), HasSubstr("'a/frame_0003.png': the reference has no frame 3"));
    std::filesystem::remove(path("a/frame_0001.png"));
    EXPECT_THAT(refusal("a b"), HasSubstr("frame 1 is missing ('a/frame_0001.png')"));
    EXPECT_THAT(refusal("b b --frames 0:4000000000"), HasSubstr("frame 3 is missing"));
    EXPECT_THAT(refusal("b none"), HasSubstr("'none': there is no such file or folder"));
    EXPECT_THAT(refusal("b b/frame_0000.png"), HasSubstr("sequence"));
    EXPECT_THAT(refusal("'b/%04d.png' b"), HasSubstr("there is no such frame"));
    EXPECT_THAT(refusal("'b/frame_%s.png' b"), HasSubstr("one %d or %04d"));
    write_bytes("b/notes.png", "");
    EXPECT_THAT(refusal("b b"), HasSubstr("notes.png': it is not numbered"));
    std::filesystem::create_directories(path("empty"));
    EXPECT_THAT(refusal("empty empty"), HasSubstr("holds no .exr or .png files"));
}

TEST_F(CompareProgram, NamesTheFileThatDoesNotSuit) {
    write_png("a.png", noise(20, 10, 1));
    write_png("b.png", noise(10, 20, 1));
    write_exr("a.exr", noise(20, 10, 1));
    metric::Picture bad = noise(20, 10, 1);
    bad.rgb[5] = std::nanf("");
    write_exr("nan.exr", bad);
    EXPECT_THAT(refusal("a.png b.png"),
                AllOf(HasSubstr("'a.png' has 20 x 10 pixels"), HasSubstr("'b.png' 10 x 20")));
    EXPECT_THAT(refusal("a.png a.exr"), HasSubstr("one kind was expected"));
    EXPECT_THAT(refusal("a.png a.png --hdr"), HasSubstr("--hdr needs EXR"));
    EXPECT_THAT(refusal("a.exr nan.exr"), HasSubstr("reading 'nan.exr': pixel (1, 0)"));
    write_bytes("deep.png", test::PngBytes::make(1, 1, 16, 2, {std::string(6, '\x40')}));
    write_bytes("flat.png", test::PngBytes::make(1, 1, 8, 2, {std::string(3, '\x40')}));
    EXPECT_THAT(refusal("deep.png flat.png"),
                AllOf(HasSubstr("'deep.png' has 16 bits"), HasSubstr("'flat.png' 8")));
    EXPECT_EQ(document("deep.png deep.png")["flip_mean"], 0.0);
    truncate("a.png", 0.5);
    EXPECT_THAT(refusal("b.png a.png"), HasSubstr("reading 'a.png'"));
}

TEST_F(CompareProgram, NamesTheOptionThatIsWrong) {
    write_png("a.png", noise(20, 10, 1));
    write_exr("a.exr", noise(20, 10, 1));
    EXPECT_EQ(compare("a.png").code, 2) << "wrong usage";
    EXPECT_THAT(refusal("a.png a.png --ppd 0"), HasSubstr("--ppd"));
    EXPECT_THAT(refusal("a.png a.png --ppd nan"), HasSubstr("--ppd"));
    EXPECT_THAT(refusal("a.png a.png --display dk9"), HasSubstr("dk9"));
    EXPECT_THAT(refusal("a.png a.png --eye third"), HasSubstr("--eye \"third\""));
    EXPECT_THAT(refusal("a.png a.png --gaze sideways"), HasSubstr("sideways"));
    EXPECT_THAT(refusal("a.png a.png --tracker noise=1"), HasSubstr("--tracker"));
    EXPECT_THAT(refusal("a.png a.png --heatmap heat.jpg"), HasSubstr("heat.jpg"));
    EXPECT_THAT(refusal("a.png a.png --foveated-heatmap heat.png"), HasSubstr("needs --gaze"));
    EXPECT_THAT(refusal("a.png a.png --frames 0:1"), HasSubstr("--frames"));
    EXPECT_THAT(refusal("a.png a.png --exposures 0:1"), HasSubstr("needs --hdr"));
    EXPECT_THAT(refusal("a.exr a.exr --hdr --exposures 2:1"), HasSubstr("--exposures \"2:1\""));
    EXPECT_THAT(refusal("a.exr a.exr --hdr --tone-mapper film"), HasSubstr("film"));
    EXPECT_EQ(document("a.exr a.exr --hdr --exposures 0:2:5")["exposures"]["count"], 5);
}

} // namespace
} // namespace macula
