#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "bench/rrm.hpp"
#include "bench/rrm_scene.hpp"

namespace macula::bench {
namespace {

// Everything runs, at a size at which it takes no time.
RrmOptions small() {
    RrmOptions options;
    options.width = 192;
    options.height = 108;
    options.columns = 2;
    options.rows = 3;
    options.frames = 1;
    options.depth = 2;
    options.quality_frames = 3;
    options.physics_frames = 30;
    return options;
}

class File {
  public:
    explicit File(const char* name)
        : path_(std::filesystem::temp_directory_path() / ("macula_rrm_" + std::string(name))) {
        std::filesystem::remove(path_);
    }
    ~File() { std::filesystem::remove(path_); }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

TEST(BenchRrm, ACaseHasARowOfTheMethodAndOneOfTheBaselineAtAsManySamples) {
    RrmOptions options = small();
    options.cases = {"whitted", "whitted secondary"};
    const auto rows = run_rrm(options, {});
    ASSERT_EQ(rows.size(), 4u);
    std::map<std::string, double> samples;
    for (const RrmRow& row : rows) {
        SCOPED_TRACE(row.name + ", " + row.method);
        ASSERT_TRUE(row.speed);
        const RrmSpeed& s = *row.speed;
        EXPECT_EQ(s.samples_full, 192.0 * 108.0);
        EXPECT_LT(s.samples_ours, s.samples_full);
        EXPECT_GT(s.samples_ours, s.samples_full / 12);
        EXPECT_GT(s.ms_full, 0.0);
        EXPECT_GT(s.ms_ours, 0.0);
        EXPECT_DOUBLE_EQ(s.efficiency(), s.ms_full / s.ms_ours * s.samples_ours / s.samples_full);
        EXPECT_EQ(s.rays_ours > 2.0 * s.samples_ours, row.depth > 0) << "secondary rays";
        samples[row.name + row.method] = s.samples_ours;
    }
    EXPECT_NEAR(samples["whittedlowres_rings"], samples["whittedrrm"],
                0.05 * samples["whittedrrm"]);
    const std::string text = rrm_summary(rows);
    EXPECT_NE(text.find("whitted secondary: speed-up (paper: 6.3)"), std::string::npos) << text;
}

TEST(BenchRrm, QualityFallsWithN) {
    RrmOptions options = small();
    options.cases = {};
    options.quality = true;
    std::map<std::uint32_t, RrmQuality> found;
    for (const RrmRow& row : run_rrm(options, {})) {
        if (row.quality && row.scene == "whitted_moving" && row.method == "rrm")
            found[row.n] = *row.quality;
        if (row.physics) {
            EXPECT_EQ(row.physics->frames, 30u);
        }
    }
    ASSERT_EQ(found.size(), 2u);
    EXPECT_GT(found[12].foveated_flip, 0.0);
    EXPECT_LT(found[12].foveated_flip, found[132].foveated_flip);
    EXPECT_LT(found[12].flip, found[132].flip);
    EXPECT_GT(found[12].samples, found[132].samples);
}

TEST(BenchRrm, ALineIsReadBackAndNotMeasuredAgain) {
    const File file("resume.jsonl");
    RrmOptions options = small();
    options.cases = {"whitted", "physics"};
    options.resume = file.path();
    const auto first = run_rrm(options, {});
    std::size_t measured = 0;
    RrmProgress progress;
    progress.row = [&](const RrmRow&, bool is_new) { measured += is_new ? 1 : 0; };
    const auto second = run_rrm(options, progress);
    ASSERT_GE(first.size(), 3u); // more physics where the bunnies are found
    ASSERT_EQ(second.size(), first.size());
    EXPECT_EQ(measured, 0u);
    for (std::size_t i = 0; i < first.size(); ++i)
        EXPECT_EQ(json_line(first[i]), json_line(second[i]));
}

TEST(BenchRrm, ALineHasTheFieldsThatAreAskedFor) {
    RrmRow row;
    row.name = "whitted";
    row.n = 12;
    row.speed.emplace();
    row.speed->ms_full = 100.0;
    row.speed->ms_ours = 20.0;
    row.speed->samples_full = 60.0;
    row.speed->samples_ours = 10.0;
    const std::string line = json_line(row);
    for (const char* field : {"\"case\":\"whitted\"", "\"n\":12", "\"fps_full\":10.0",
                              "\"fps_ours\":50.0", "\"speedup\":5.0", "\"efficiency\":0.83"})
        EXPECT_NE(line.find(field), std::string::npos) << field << " in " << line;
}

TEST(BenchRrm, OptionsThatMakeNoSenseAreRefused) {
    const auto refused = [](auto change) {
        RrmOptions options = small();
        change(options);
        EXPECT_THROW(run_rrm(options, {}), std::invalid_argument);
    };
    refused([](RrmOptions& o) { o.n = 133; });
    refused([](RrmOptions& o) { o.n = 0; });
    refused([](RrmOptions& o) { o.columns = 0; });
    refused([](RrmOptions& o) { o.frames = 0; });
    refused([](RrmOptions& o) { o.cases = {"teapot"}; });
    refused([](RrmOptions& o) { o.quality_frames = 1; });
    EXPECT_THROW(parse_rrm_row("{\"case\":1}"), std::invalid_argument);
}

} // namespace
} // namespace macula::bench
