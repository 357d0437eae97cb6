// Table 1 on few pixels: the rows must be complete, consistent, and found again by a second run.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#ifdef MACULA_WITH_BENCH
#include <nlohmann/json.hpp>

#include "bench/figure5.hpp"
#include "bench/table1.hpp"

namespace {
using namespace macula;
using bench::FoveationOptions;
using bench::FoveationRow;
using bench::StageGroup;
using frame::LightMode;
using ::testing::HasSubstr;

FoveationOptions small(std::vector<LightMode> lights) {
    FoveationOptions options;
    options.scenes = {"cornell"};
    options.lights = std::move(lights);
    options.width = 96;
    options.height = 80;
    options.frames = 3;
    options.segments = 2;
    options.warm_up = 1;
    return options;
}

class BenchTable1File : public ::testing::Test {
  protected:
    BenchTable1File() { std::filesystem::remove(path_); }
    ~BenchTable1File() override { std::filesystem::remove(path_); }

    std::string text() const {
        std::ifstream file(path_);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    std::filesystem::path path_ =
        std::filesystem::path(::testing::TempDir()) /
        (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".jsonl");
};

TEST(BenchTable1, ThePapersRowsAddUpToTheirTotals) {
    ASSERT_EQ(bench::paper_rows().size(), 12U);
    double speedups = 0.0, efficiencies = 0.0;
    for (const bench::PaperRow& row : bench::paper_rows()) {
        SCOPED_TRACE(std::string(row.scene) + ", " + frame::name(row.lights));
        EXPECT_NEAR(row.ray_tracing_full, row.ms_full, 1e-9);
        // Two of the paper's totals are 0.2 more than their columns' sum.
        EXPECT_NEAR(row.reproject + row.ray_tracing_ours + row.cache_update + row.merge + row.post,
                    row.ms_ours, 0.25);
        EXPECT_NEAR(row.ms_full / row.ms_ours, row.speedup, 0.02);
        speedups += row.speedup / 12.0;
        efficiencies += row.efficiency() / 12.0;
    }
    EXPECT_NEAR(speedups, 2.62, 0.005) << "the text of the paper says 2.55";
    EXPECT_NEAR(efficiencies, 0.54, 0.02);
}

TEST(BenchTable1, EveryStageOfEveryLightingHasAColumnAndTheColumnsAddUp) {
    const auto rows =
        run_foveation(small({LightMode::point, LightMode::area, LightMode::ambient_occlusion}),
                      {bench::table1_region()}, {});
    ASSERT_EQ(rows.size(), 3U);
    for (const FoveationRow& row : rows) {
        SCOPED_TRACE(frame::name(row.lights));
        EXPECT_EQ(row.frames, 3U);
        EXPECT_GT(row.rays_full, row.rays_ours);
        EXPECT_GT(row.sampled, 0.05);
        EXPECT_LT(row.sampled, 1.0);
        EXPECT_GT(row.speedup, 0.0);
        EXPECT_LE(row.speedup_p10, row.speedup);
        EXPECT_GE(row.speedup_p90, row.speedup);
        EXPECT_NEAR(row.efficiency, row.speedup * row.rays_ours / row.rays_full, 1e-12);
        EXPECT_GE(row.wall_ms_ours, 0.5 * row.ms_ours);
        for (const StageGroup group : {StageGroup::reproject, StageGroup::ray_tracing,
                                       StageGroup::cache_update, StageGroup::merge})
            EXPECT_TRUE(!row.device_clock || row.ms[static_cast<std::size_t>(group)] > 0.0)
                << name(group);
    }
    EXPECT_EQ(rows[0].ms[static_cast<std::size_t>(StageGroup::post)], 0.0);
}

TEST(BenchTable1, AnUnknownStageIsNotCountedSomewhere) {
    EXPECT_EQ(bench::group_of("trace shadow rays"), StageGroup::ray_tracing);
    EXPECT_THROW(bench::group_of("paint"), std::invalid_argument);
}

TEST(BenchTable1, AJsonLineComesBackAndHasThePapersFigures) {
    FoveationRow row;
    row.scene = "sibenik";
    row.lights = LightMode::ambient_occlusion;
    row.frc = "medium";
    row.ms = {1.0, 2.0, 3.0, 4.0, 5.0};
    row.ms_full = 100.0;
    row.speedup = 2.5;
    row.gaze = "a \"gaze\"";
    const std::string line = json_line(row, bench::paper_fields(row));
    const auto json = nlohmann::json::parse(line);
    for (const char* key :
         {"scene", "lights", "rays_full", "rays_ours", "ms_full", "ms_ours", "ms", "speedup",
          "efficiency", "paper_speedup", "frames", "device", "driver", "commit", "gaze"})
        EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json["paper_speedup"], 3.02);
    EXPECT_NEAR(json["overhead"].get<double>(), 0.13, 1e-12);
    const FoveationRow back = bench::parse_row(line);
    EXPECT_EQ(json_line(back), json_line(row));
    row.scene = "cornell";
    EXPECT_TRUE(
        nlohmann::json::parse(json_line(row, bench::paper_fields(row)))["paper_speedup"].is_null());
}

TEST(BenchFigure5, TheFullRegionTracesEveryRayAndSmallerOnesFewer) {
    const auto rows = run_foveation(small({LightMode::point}), bench::figure5_regions(), {});
    ASSERT_EQ(rows.size(), 4U);
    for (std::size_t i = 1; i < rows.size(); ++i)
        EXPECT_GT(rows[i].rays_ours, rows[i - 1].rays_ours) << rows[i].frc;
    EXPECT_EQ(rows[3].frc, "full");
    EXPECT_EQ(rows[3].rays_ours, rows[3].rays_full);
    EXPECT_EQ(rows[3].sampled, 1.0);
}

TEST_F(BenchTable1File, AnInterruptedRunGoesOnBehindItsLastWholeRow) {
    FoveationOptions options = small({LightMode::point});
    options.resume = path_;
    run_foveation(options, {bench::table1_region()}, {});
    const std::string first = text();
    std::ofstream(path_, std::ios::app) << "{\"scene\":\"corn";

    options.lights = {LightMode::point, LightMode::ambient_occlusion};
    std::vector<bool> is_new;
    bench::FoveationProgress progress;
    progress.row = [&](const FoveationRow&, bool fresh) { is_new.push_back(fresh); };
    const auto rows = run_foveation(options, {bench::table1_region()}, progress);
    EXPECT_EQ(is_new, (std::vector<bool>{false, true}));
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(json_line(rows[0]) + "\n", first);
    EXPECT_EQ(text(), first + json_line(rows[1]) + "\n");
}

TEST_F(BenchTable1File, ALineThatIsNoRowIsNamed) {
    std::ofstream(path_) << "{\"scene\":\"cornell\"}\n";
    FoveationOptions options = small({LightMode::point});
    options.resume = path_;
    try {
        run_foveation(options, {bench::table1_region()}, {});
        FAIL() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("line 1"));
        EXPECT_THAT(error.what(), HasSubstr(path_.filename().string()));
    }
}

TEST(BenchTable1, OptionsThatMakeNoSenseAreRefused) {
    const auto refused = [](auto change) {
        FoveationOptions options = small({LightMode::point});
        change(options);
        EXPECT_THROW(run_foveation(options, {bench::table1_region()}, {}), std::invalid_argument);
    };
    refused([](FoveationOptions& o) { o.frames = 0; });
    refused([](FoveationOptions& o) { o.segments = 4; });
    refused([](FoveationOptions& o) { o.warm_up = 0; });
    refused([](FoveationOptions& o) { o.gaze = "udp:0"; });
    refused([](FoveationOptions& o) { o.display = "no such display"; });
}

} // namespace

#else

TEST(BenchTable1, NeedsTheBenchmarks) {
    GTEST_SKIP() << "built without MACULA_BUILD_BENCH";
}

#endif
