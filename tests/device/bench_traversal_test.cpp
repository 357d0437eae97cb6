// The benchmark itself, on few rays: what it reports must be complete and free of mismatches.
#include <set>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#ifdef MACULA_WITH_BENCH
#include <nlohmann/json.hpp>

#include "bench/report.hpp"
#include "bench/traversal.hpp"
#include "bench/tuner.hpp"
#include "host/cl/device.hpp"

namespace {
using namespace macula;
using kernel::RayClass;

bench::TraversalOptions small(std::vector<RayClass> classes) {
    bench::TraversalOptions options;
    options.scenes = {"cornell"};
    options.classes = std::move(classes);
    options.rounds = 1;
    options.rays.size = 48;
    return options;
}

TEST(BenchTraversal, EveryApplicableVariantAgreesWithEmbreeAndTheReference) {
    const bench::TraversalReport report =
        run_traversal(small({RayClass::shadow, RayClass::diffuse}), {});
    ASSERT_EQ(report.records.size(), 2 * kernel::variants().size());
    int chosen = 0, measured = 0;
    for (const bench::TraversalRecord& r : report.records) {
        SCOPED_TRACE(r.variant);
        chosen += r.chosen ? 1 : 0;
        if (!r.skipped.empty())
            continue;
        ++measured;
        EXPECT_EQ(r.mismatches_embree, 0U);
        EXPECT_EQ(r.mismatches_reference, 0U);
        EXPECT_GT(r.mrays_per_s, 0.0);
        EXPECT_GT(r.ratio, 0.0);
        EXPECT_GT(r.ray_count, 0U);
    }
    EXPECT_EQ(chosen, 2);
    EXPECT_GE(measured, 4);
}

TEST(BenchTraversal, AJsonLineHasTheFieldsThatAreDocumented) {
    bench::TraversalOptions options = small({RayClass::ambient_occlusion});
    options.variants = {kernel::reference_variant().name};
    const bench::TraversalReport report = run_traversal(options, {});
    ASSERT_EQ(report.records.size(), 1U);
    const std::string line = json_line(report, report.records[0]);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const auto json = nlohmann::json::parse(line);
    for (const char* key :
         {"scene", "rays", "variant", "chosen", "mrays_per_s", "embree_best", "embree_mrays_per_s",
          "ratio", "mismatches", "device", "driver", "commit", "rounds", "ray_count"})
        EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json["scene"], "cornell");
    EXPECT_EQ(json["rays"], "ao");
    EXPECT_EQ(json["variant"], kernel::reference_variant().name);
    EXPECT_EQ(json["mismatches"]["embree"], 0);
    EXPECT_EQ(json["mismatches"]["reference"], 0);
    EXPECT_NE(json["commit"], "");
}

TEST(BenchTraversal, AVariantBeyondTheTimeLimitIsLeftOutWithTheReason) {
    bench::TraversalOptions options = small({RayClass::random});
    options.rays.size = 512;
    options.limit_seconds = 1e-3;
    options.rounds = 1000;
    options.variants = {kernel::reference_variant().name};
    const bench::TraversalReport report = run_traversal(options, {});
    ASSERT_EQ(report.records.size(), 1U);
    EXPECT_THAT(report.records[0].skipped, testing::HasSubstr("beyond the limit"));
}

TEST(BenchTraversal, RefusesOptionsThatMakeNoSense) {
    bench::TraversalOptions options = small({});
    options.rounds = 0;
    EXPECT_THROW(run_traversal(options, {}), std::invalid_argument);
    options = small({});
    options.variants = {"no_such_variant"};
    EXPECT_THROW(run_traversal(options, {}), std::invalid_argument);
    options = small({});
    options.rays.size = 1;
    EXPECT_THROW(run_traversal(options, {}), std::invalid_argument);
}

TEST(Tuner, TriesStepsOfTwoInsideTheRange) {
    const kernel::Parameter group{"work_group", 1, 1024, 64, true, kernel::ParameterUse::launch,
                                  "work-items"};
    EXPECT_THAT(bench::values_to_try(group, 8, 4096),
                testing::ElementsAre(8, 16, 32, 64, 128, 256, 512));
    EXPECT_THAT(bench::values_to_try(group, 8, 128), testing::ElementsAre(8, 16, 32, 64, 128));
    const kernel::Parameter fetch{
        "rays_per_fetch", 1, 6, 3, false, kernel::ParameterUse::literal, "rays"};
    EXPECT_THAT(bench::values_to_try(fetch, 8, 128), testing::ElementsAre(1, 3, 6));
    EXPECT_THAT(bench::values_to_try(fetch, 1, 128), testing::ElementsAre(3));
}

TEST(Tuner, FindsAChoiceForEveryRayClass) {
    compute::Device device = compute::open();
    bench::TuneOptions options = bench::TuneOptions::quick();
    options.scenes = {"cornell"};
    options.rounds = 1;
    options.furthest = 1;
    options.rays.size = 64;
    const auto classes = tune(device, options, [](const std::string&) {});
    ASSERT_EQ(classes.size(), kernel::kRayClasses.size());
    for (const bench::TuneClass& measured : classes) {
        SCOPED_TRACE(kernel::name(measured.rays));
        EXPECT_EQ(measured.candidates.size(), kernel::variants().size());
        const bench::TuneCandidate& first = measured.candidates.front();
        EXPECT_TRUE(first.skipped.empty());
        EXPECT_GT(first.mrays_per_s, 0.0);
        EXPECT_NO_THROW(kernel::check_parameters(*first.choice.variant, first.choice.parameters));
    }
}

} // namespace
#else
TEST(BenchTraversal, NeedsTheBenchmarks) {
    GTEST_SKIP() << "built without MACULA_BUILD_BENCH";
}
#endif
