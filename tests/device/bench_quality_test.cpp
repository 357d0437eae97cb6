// Quality and time on few pixels: complete, consistent, found again by a second run, and nothing
// gained by a cache that is broken.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#ifdef MACULA_WITH_BENCH
#include <nlohmann/json.hpp>

#include "bench/quality_cases.hpp"
#include "bench/quality_pictures.hpp"
#include "bench/scene_hash.hpp"
#include "host/report/results_file.hpp"
#include "scenes/load.hpp"

namespace {
using namespace macula;
using bench::QualityOptions;
using report::QualityCase;
using ::testing::HasSubstr;

class BenchQuality : public ::testing::Test {
  protected:
    BenchQuality() {
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    ~BenchQuality() override { std::filesystem::remove_all(folder_); }

    QualityOptions small() const {
        QualityOptions options;
        options.scenes = {"cornell"};
        options.methods = {"full"};
        options.width = 96;
        options.height = 80;
        options.frames = 3;
        options.segments = 2; // stretches of one and two frames
        options.warm_up = 2;
        options.reference_spp = 9;
        options.gaze = "5,-3";
        options.head = "scene";
        options.pictures = 1;
        options.reference_cache = folder_ / "references";
        return options;
    }
    std::string text(const std::string& name) const {
        std::ifstream file(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    std::filesystem::path folder_ =
        std::filesystem::path(::testing::TempDir()) /
        (std::string("quality_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(BenchQuality, EveryMethodHasAllFiguresAndTheirOrderIsRight) {
    QualityOptions options = small();
    options.methods = {};
    options.results = folder_ / "results.jsonl";
    const auto cases = run_quality(options, {});
    ASSERT_EQ(cases.size(), 4U);
    const auto pixels = 96.0 * 80.0;
    for (const QualityCase& c : cases) {
        SCOPED_TRACE(c.name);
        EXPECT_GT(c.time_ms.median, 0.0);
        EXPECT_LE(c.time_ms.median, c.time_ms.p95);
        EXPECT_LE(c.time_ms.p95, c.time_ms.p99);
        EXPECT_FALSE(c.stages.empty());
        EXPECT_GT(c.scores.flip.mean, 0.0);
        EXPECT_LT(c.scores.flip.mean, 0.5);
        EXPECT_LE(c.scores.flip.q1, c.scores.flip.weighted_median);
        EXPECT_LE(c.scores.flip.weighted_median, c.scores.flip.q3);
        EXPECT_GT(c.scores.psnr.value(), 15.0);
        EXPECT_GT(c.scores.flicker_energy.value(), 0.0);
        EXPECT_TRUE(c.scores.instability.has_value());
        ASSERT_EQ(c.series.frame.size(), 3U);
        EXPECT_FALSE(c.series.flicker_energy[0].has_value()) << "a stretch's first frame";
        EXPECT_FALSE(c.series.flicker_energy[1].has_value()) << "a stretch's first frame";
        EXPECT_TRUE(c.series.flicker_energy[2].has_value());
        double part = 0.0;
        for (const report::Band& band : c.bands)
            part += band.part;
        EXPECT_NEAR(part, 1.0, 1e-9);
        ASSERT_EQ(c.pictures.size(), 1U);
        EXPECT_TRUE(std::filesystem::exists(folder_ / c.pictures[0].heat_map));
        ASSERT_TRUE(c.pictures[0].gaze.has_value());
    }
    const QualityCase &full = cases[0], &weier = cases[1], &samples = cases[2];
    EXPECT_EQ(full.samples, pixels);
    EXPECT_EQ(full.against_full.flip, 0.0);
    EXPECT_EQ(full.against_full.flip_inside_r0, 0.0);
    EXPECT_LT(weier.samples, pixels);
    EXPECT_EQ(weier.against_full.flip_inside_r0, 0.0) << "every pixel there is sampled";
    EXPECT_GT(samples.against_full.flip_inside_r0, 0.0);
    EXPECT_NEAR(samples.samples / weier.samples, 1.0, 0.1);
    EXPECT_EQ(samples.parameters.equal_to, weier.name);
    EXPECT_EQ(samples.parameters.time_ratio, std::nullopt);
    EXPECT_GT(cases[3].parameters.time_ratio.value(), 0.0);
    EXPECT_GT(cases[3].parameters.scale.value(), 0.0);

    const auto back = report::read_results(options.results);
    ASSERT_EQ(back.size(), 4U);
    EXPECT_EQ(json_line(back[3]), json_line(cases[3]));
    const auto summary = nlohmann::json::parse(bench::google_benchmark(cases));
    ASSERT_EQ(summary["benchmarks"].size(), 4U);
    EXPECT_EQ(summary["benchmarks"][1]["name"], "quality/cornell/area/weier medium");
    EXPECT_EQ(summary["benchmarks"][1]["time_unit"], "ms");
}

TEST_F(BenchQuality, TheReferenceItselfHasNoError) {
    QualityOptions options = small();
    options.reference_spp = 1;
    const auto cases = run_quality(options, {});
    ASSERT_EQ(cases.size(), 1U);
    EXPECT_EQ(cases[0].scores.flip.max, 0.0);
    EXPECT_EQ(cases[0].scores.foveated_flip.max, 0.0);
    EXPECT_EQ(cases[0].scores.psnr, std::nullopt);
    EXPECT_NEAR(cases[0].scores.ssim, 1.0, 1e-12);
    EXPECT_EQ(cases[0].scores.flicker_energy, 0.0);
    EXPECT_EQ(cases[0].scores.instability, 0.0);
}

TEST_F(BenchQuality, AnInterruptedRunGoesOnBehindItsLastWholeLine) {
    QualityOptions options = small();
    options.results = folder_ / "results.jsonl";
    run_quality(options, {});
    const std::string first = text("results.jsonl");
    std::ofstream(options.results, std::ios::app) << "{\"schema\":1,\"sce";

    options.spp = {1, 4};
    std::vector<bool> is_new;
    bench::QualityProgress progress;
    progress.done = [&](const QualityCase&, bool fresh) { is_new.push_back(fresh); };
    const auto cases = run_quality(options, progress);
    EXPECT_EQ(is_new, (std::vector<bool>{false, true}));
    EXPECT_EQ(text("results.jsonl"), first + json_line(cases[1]) + "\n");
    EXPECT_LT(cases[1].scores.flip.mean, cases[0].scores.flip.mean) << "four samples beat one";
}

TEST_F(BenchQuality, ReferencesAreKeptByContentAndABrokenFileIsMadeAnew) {
    const QualityOptions options = small();
    const compute::Device device = compute::open("");
    const bench::QualityFlight flight(options, device, "cornell");
    const auto lights = frame::LightMode::area;
    const std::uint32_t frame = flight.spots().front().frame;
    bench::References first(flight, options, lights);
    const auto rgb = first.at(frame).converged.rgb;
    EXPECT_EQ(first.rendered(), 1U);

    bench::References second(flight, options, lights);
    EXPECT_EQ(second.at(frame).converged.rgb, rgb);
    EXPECT_EQ(second.rendered(), 0U);

    std::fstream file(second.file_of(frame), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(2000);
    file.put('\x55');
    file.put('\xaa');
    file.close();
    bench::References third(flight, options, lights);
    EXPECT_EQ(third.at(frame).converged.rgb, rgb);
    EXPECT_EQ(third.rendered(), 1U);
    std::filesystem::resize_file(third.file_of(frame), 5000);
    EXPECT_EQ(third.at(frame).converged.rgb, rgb);
    EXPECT_EQ(third.rendered(), 2U);

    QualityOptions other = options;
    other.seed = 1;
    bench::References fourth(flight, other, lights);
    EXPECT_NE(fourth.file_of(frame), first.file_of(frame));
    EXPECT_NE(fourth.file_of(frame), fourth.file_of(frame + 1));
}

TEST_F(BenchQuality, AChangeOfTheSceneIsAnotherScene) {
    scene::Scene scene = scene::load("cornell");
    const std::string before = bench::scene_hash(scene);
    EXPECT_EQ(before.size(), 32U);
    scene.name = "another name";
    scene.cameras.clear();
    EXPECT_EQ(bench::scene_hash(scene), before);
    scene.lights[0].colour.x *= 1.001f;
    const std::string lit = bench::scene_hash(scene);
    EXPECT_NE(lit, before);
    scene.materials.back().diffuse.y += 0.01f;
    EXPECT_NE(bench::scene_hash(scene), lit);
}

TEST(BenchQualityNames, FilesHaveNoOddCharacters) {
    EXPECT_EQ(bench::file_name_of("lowres, equal time"), "lowres_equal_time");
    EXPECT_EQ(bench::file_name_of("weier 5,10,0.01"), "weier_5_10_0_01");
    int pictured = 0;
    for (std::uint32_t i = 0; i < 12; ++i)
        pictured += bench::is_pictured(i, 12, 2) ? 1 : 0;
    EXPECT_EQ(pictured, 2);
}

TEST_F(BenchQuality, ParametersOfWeierMakeACaseOfTheirOwn) {
    QualityOptions options = small();
    options.methods = {"weier"};
    bench::QualityWeier eager;
    eager.changes = "eps-lum=0.01,t-max=10";
    bench::parse_weier_changes(eager.changes, eager.options);
    EXPECT_EQ(eager.options.t_max, 10U);
    options.weier = {bench::QualityWeier{}, eager};
    const auto cases = run_quality(options, {});
    ASSERT_EQ(cases.size(), 2U);
    EXPECT_EQ(cases[1].name, "weier medium eps-lum=0.01,t-max=10");
    EXPECT_NE(identity(cases[0]), identity(cases[1]));
    EXPECT_GT(cases[1].samples, cases[0].samples);
    stage::WeierOptions weier;
    for (const char* wrong : {"eps-lum", "eps-lum=", "=1", "eps-lum=x", "eps-lum=1x", "eps-lum=nan",
                              "hue=1", "t-max=1.5", "t-max=-1", "k-min=1,,k-max=1"})
        EXPECT_THROW(bench::parse_weier_changes(wrong, weier), std::invalid_argument) << wrong;
}

TEST_F(BenchQuality, WhatMakesNoSenseIsRefused) {
    const auto refused = [&](auto change) {
        QualityOptions options = small();
        change(options);
        EXPECT_THROW(run_quality(options, {}), std::invalid_argument);
    };
    refused([](QualityOptions& o) { o.frames = 0; });
    refused([](QualityOptions& o) { o.segments = 4; });
    refused([](QualityOptions& o) { o.warm_up = 0; });
    refused([](QualityOptions& o) { o.reference_spp = 0; });
    refused([](QualityOptions& o) { o.pictures = 4; });
    refused([](QualityOptions& o) { o.scenes = {}; });
    refused([](QualityOptions& o) { o.methods = {"half"}; });
    refused([](QualityOptions& o) { o.equal = {"beauty"}; });
    refused([](QualityOptions& o) { o.gaze = "udp:0"; });
    refused([](QualityOptions& o) { o.display = "no such display"; });
    refused([](QualityOptions& o) { o.tracker = "latency=-1"; });
    QualityOptions options = small();
    options.gaze = "";
    options.trace = "no such trace.csv";
    EXPECT_THROW(run_quality(options, {}), std::runtime_error);
}

} // namespace

#else

TEST(BenchQuality, NeedsTheBenchmarks) {
    GTEST_SKIP() << "built without MACULA_BUILD_BENCH";
}

#endif
