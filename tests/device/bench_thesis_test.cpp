#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "bench/thesis.hpp"

namespace macula::bench {
namespace {

// Everything runs, at a size at which it takes no time.
ThesisOptions small() {
    ThesisOptions options;
    options.views = {"temple statue"};
    options.lights = frame::LightMode::point;
    options.width = 96;
    options.height = 54;
    options.warm_up = 2;
    options.frames = 2;
    options.orbit = 2;
    options.reference_spp = 4;
    options.orbit_spp = 1;
    return options;
}

class File {
  public:
    explicit File(const char* name)
        : path_(std::filesystem::temp_directory_path() / ("macula_thesis_" + std::string(name))) {
        std::filesystem::remove(path_);
    }
    ~File() { std::filesystem::remove(path_); }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

TEST(BenchThesis, EveryModeHasARowWithItsTimesAndScores) {
    const auto rows = run_thesis(small(), {});
    ASSERT_EQ(rows.size(), thesis_modes().size());
    for (const ThesisRow& row : rows) {
        SCOPED_TRACE(row.mode);
        EXPECT_GT(row.ms, 0.0);
        EXPECT_GT(row.samples, 0.0);
        EXPECT_GE(row.rays, row.samples);
        EXPECT_GT(row.flip_weighted_median, 0.0);
        EXPECT_LT(row.flip_weighted_median, 1.0);
        ASSERT_TRUE(row.flicker);
        EXPECT_GE(*row.flicker, 0.0);
    }
    EXPECT_LT(rows[1].samples, rows[0].samples) << "a foveated frame has fewer samples";
    for (const ThesisRow& row : rows) {
        if (row.mode == "logpolar+taa+upscale") {
            for (const double ms : row.stage_ms)
                EXPECT_GT(ms, 0.0) << "a stage without its column";
        }
    }
    EXPECT_NE(thesis_summary(rows).find("FLIP added by upscaling"), std::string::npos);
}

TEST(BenchThesis, ALineIsReadBackAndNotMeasuredAgain) {
    const File file("resume.jsonl");
    ThesisOptions options = small();
    options.views = {"cornell box"};
    options.modes = {"logpolar"};
    options.resume = file.path();
    const auto first = run_thesis(options, {});
    std::size_t measured = 0;
    ThesisProgress progress;
    progress.row = [&](const ThesisRow&, bool is_new) { measured += is_new ? 1 : 0; };
    const auto second = run_thesis(options, progress);
    ASSERT_EQ(first.size(), 1u);
    ASSERT_EQ(second.size(), 1u);
    EXPECT_EQ(measured, 0u);
    EXPECT_EQ(json_line(first.front()), json_line(second.front()));
}

TEST(BenchThesis, ALineOfOtherLightsOrWithoutMotionIsNoAnswer) {
    const File file("other.jsonl");
    ThesisOptions options = small();
    options.views = {"cornell box"};
    options.modes = {"logpolar"};
    options.orbit = 0;
    options.resume = file.path();
    std::size_t measured = 0;
    ThesisProgress progress;
    progress.row = [&](const ThesisRow&, bool is_new) { measured += is_new ? 1 : 0; };
    run_thesis(options, progress);
    options.lights = frame::LightMode::soft;
    run_thesis(options, progress);
    EXPECT_EQ(measured, 2u);
    options.orbit = 2;
    const auto rows = run_thesis(options, progress);
    EXPECT_EQ(measured, 3u);
    EXPECT_TRUE(rows.front().flicker);
    options.orbit = 0;
    run_thesis(options, progress);
    EXPECT_EQ(measured, 3u) << "more than is asked for will do";
}

// Equation 5.1 against the rays of the frames.
TEST(BenchThesis, TheSweepsSamplesAreThePredictedOnesButForTheDisksEdgeAndTexelsOutside) {
    ThesisOptions options = small();
    options.views = {"sponza overview"};
    options.modes = {"logpolar"};
    options.width = 480;
    options.height = 270;
    options.frames = 1;
    options.orbit = 0;
    options.sweep = true;
    std::set<double> radii;
    for (const ThesisRow& row : run_thesis(options, {})) {
        if (!row.disk)
            continue;
        radii.insert(*row.disk);
        SCOPED_TRACE(*row.disk);
        // Where the disk fades out, both it and the buffer are sampled; a part of the buffer lies
        // outside of the image.
        EXPECT_LT(row.samples, 1.03 * *row.predicted);
        EXPECT_GT(row.samples, 0.8 * *row.predicted);
        if (*row.disk >= 1.0) {
            EXPECT_NEAR(row.samples, 480.0 * 270.0, 1.0);
        }
    }
    EXPECT_GE(radii.size(), 10u);
}

TEST(BenchThesis, EquationFiveOneByHand) {
    // No disk: the whole buffer.
    EXPECT_DOUBLE_EQ(predicted_samples(192, 108, 0.0, 4.0, 1.0), 192.0 * 108.0);
    EXPECT_DOUBLE_EQ(predicted_samples(180, 90, 0.0, 4.0, 1.8), 100.0 * 50.0);
    // All of it: the image.
    EXPECT_DOUBLE_EQ(predicted_samples(192, 108, 1.0, 4.0, 1.0), 192.0 * 108.0);
}

TEST(BenchThesis, FramesThatNobodyCouldWaitForAreRefused) {
    ThesisOptions options = small();
    options.warm_up = 0xffffffffu; // with the measured ones it would wrap around
    EXPECT_THROW(run_thesis(options, {}), std::invalid_argument);
    options = small();
    options.orbit = 100001;
    EXPECT_THROW(run_thesis(options, {}), std::invalid_argument);
}

TEST(BenchThesis, UnknownNamesAreRefusedWithTheKnownOnes) {
    try {
        find_thesis_views({"sponza basement"});
        FAIL() << "was taken";
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("sponza central"), std::string::npos);
    }
    EXPECT_THROW(find_thesis_modes({"logpolar+magic"}), std::invalid_argument);
    EXPECT_THROW(parse_thesis_row("{\"scene\":1}"), std::invalid_argument);
}

} // namespace
} // namespace macula::bench
