// `macula render` as a program: what a scene file asks for, what the command line overrides.
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/scene_folder.hpp"

namespace macula::scene {
namespace {

using testing::HasSubstr;
using testing::Not;

class RenderProgram : public SceneFolder {
  protected:
    // Runs `macula render s.toml ARGUMENTS`.
    test::Ended render(const std::string& arguments) const {
        return test::run_macula("render '" + path("s.toml") + "' --format png --out '" +
                                path("out") + "' " + arguments);
    }

    // The JSON line of the last frame.
    nlohmann::json frame_of(const std::string& arguments) const {
        const test::Ended ended = render("--json " + arguments);
        EXPECT_EQ(ended.code, 0) << ended.text;
        const std::size_t line = ended.text.rfind('{', ended.text.rfind("\"frame\""));
        return nlohmann::json::parse(ended.text.substr(line == std::string::npos ? 0 : line));
    }

    // "WxH" from the header of the picture.
    std::string size_of_picture(const std::string& file = "out/frame_0000.png") const {
        std::ifstream in(path(file), std::ios::binary);
        unsigned char head[24] = {};
        in.read(reinterpret_cast<char*>(head), sizeof head);
        const auto number = [&](int at) {
            return std::to_string(head[at] << 24 | head[at + 1] << 16 | head[at + 2] << 8 |
                                  head[at + 3]);
        };
        return number(16) + "x" + number(20);
    }
};

constexpr const char* kTiny =
    R"({"width": 40, "height": 30, "screen": {"width_mm": 400, "distance_mm": 600}})";

TEST_F(RenderProgram, TakesDisplayAndGazeFromTheSceneFile) {
    write("tiny.json", kTiny);
    write("s.toml", "procedural = 'cornell'\ndisplay = 'tiny.json'\ngaze = '10,-5'\n");
    const auto frame = frame_of("");
    EXPECT_EQ(size_of_picture(), "40x30");
    EXPECT_NEAR(frame["gaze"]["degrees"][0].get<double>(), 10.0, 1e-6);
    EXPECT_NEAR(frame["gaze"]["degrees"][1].get<double>(), -5.0, 1e-6);
    // Only a display has two eyes.
    EXPECT_EQ(render("--eyes both").code, 0);
    EXPECT_EQ(size_of_picture("out/right/frame_0000.png"), "40x30");
}

TEST_F(RenderProgram, TheCommandLineOverridesTheSceneFile) {
    write("tiny.json", kTiny);
    write("s.toml", "procedural = 'cornell'\ndisplay = 'tiny.json'\ngaze = '10,-5'\n");
    EXPECT_NEAR(frame_of("--gaze 3,4")["gaze"]["degrees"][0].get<double>(), 3.0, 1e-6);
    EXPECT_EQ(size_of_picture(), "40x30");
    EXPECT_FALSE(frame_of("--gaze none --size 20x16").contains("gaze"));
    EXPECT_EQ(size_of_picture(), "20x16");
    const auto of_display = frame_of("--display none --size 40x30");
    const auto plain = frame_of("--display none --gaze none --size 40x30");
    EXPECT_EQ(of_display["hash"], plain["hash"]) << "method full does not look at the gaze";
    EXPECT_NE(frame_of("")["hash"], plain["hash"]) << "the display has another field of view";
}

TEST_F(RenderProgram, WarpsForTheLensOfTheDisplay) {
    write("tiny.toml", "width = 40\nheight = 30\n[screen]\nwidth_mm = 400\ndistance_mm = 600\n"
                       "[distortion]\ngreen = [0.3, 0.1]\n");
    write("s.toml", "procedural = 'cornell'\ndisplay = 'tiny.toml'\n");
    EXPECT_NE(frame_of("--distort")["hash"], frame_of("")["hash"]);
    EXPECT_EQ(size_of_picture(), "40x30");
    EXPECT_THAT(render("--distort --display dk2 --size 40x30").text,
                HasSubstr("--distort: no distortion is known of the display \"dk2\""));
    EXPECT_THAT(render("--distort --display none").text, HasSubstr("--distort"));
}

// An interrupted run that goes on gives the pictures of one that was not, histories included.
TEST_F(RenderProgram, ResumedFramesAreThoseOfOneRun) {
    write("s.toml", "procedural = 'cornell_spheres'\n");
    for (const char* method : {"logpolar+taa+upscale", "weier", "full"}) {
        const std::string all = std::string("--size 40x30 --method ") + method + " --frames ";
        const test::Ended whole = render(all + "0:6 --hash");
        ASSERT_EQ(whole.code, 0) << whole.text;
        for (const int frame : {1, 3, 4, 5})
            std::filesystem::remove(path("out/frame_000" + std::to_string(frame) + ".png"));
        const test::Ended resumed = render(all + "0:6 --hash --resume");
        ASSERT_EQ(resumed.code, 0) << resumed.text;
        std::vector<std::string> first, second;
        std::istringstream a(whole.text), b(resumed.text);
        for (std::string line; std::getline(a, line);)
            if (line.starts_with("hash"))
                first.push_back(line);
        for (std::string line; std::getline(b, line);)
            if (line.starts_with("hash"))
                second.push_back(line);
        ASSERT_EQ(first.size(), 6u);
        EXPECT_EQ(second, (std::vector{first[1], first[3], first[4], first[5]})) << method;
        EXPECT_EQ(render(all + "0:6 --hash --resume").text.find("hash"), std::string::npos);
        std::filesystem::remove_all(path("out"));
    }
}

TEST_F(RenderProgram, AnImageThatTheMethodLacksIsAnErrorThatNamesThoseItHas) {
    write("s.toml", "procedural = 'cornell'\n");
    const test::Ended ended = render("--size 16x16 --method weier --aov depth");
    EXPECT_EQ(ended.code, 1);
    EXPECT_THAT(ended.text, HasSubstr("method weier has no image \"depth\"; it has colour, "));
    EXPECT_THAT(ended.text, Not(HasSubstr("ray count")));
}

TEST_F(RenderProgram, NamesTheOptionThatIsWrong) {
    write("s.toml", "procedural = 'cornell'\n");
    EXPECT_THAT(render("--method weier --first-frame half").text,
                HasSubstr("--first-frame \"half\": full or sparse was expected"));
    EXPECT_THAT(render("--method weier --new-parts no").text, HasSubstr("--new-parts \"no\""));
    EXPECT_THAT(render("--display dk9").text, HasSubstr("there is no display \"dk9\""));
    EXPECT_THAT(render("--eyes both").text, HasSubstr("--eyes \"both\""));
    EXPECT_THAT(render("--tracker latency=10").text, HasSubstr("--tracker \"latency=10\""));
}

} // namespace
} // namespace macula::scene
