#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/metric/statistics.hpp"

namespace {
using namespace macula::metric;
using Values = std::vector<double>;

TEST(Percentile, OfOneValueIsThatValue) {
    for (const double p : {0.0, 0.3, 0.5, 1.0})
        EXPECT_EQ(percentile(Values{7.0}, p), 7.0);
}

TEST(Percentile, EndsAreLeastAndGreatest) {
    const Values values{3.0, -1.0, 8.0, 2.0};
    EXPECT_EQ(percentile(values, 0.0), -1.0);
    EXPECT_EQ(percentile(values, 1.0), 8.0);
}

TEST(Percentile, InterpolatesBetweenOrderStatistics) {
    const Values values{10.0, 40.0, 20.0, 30.0, 50.0};
    EXPECT_DOUBLE_EQ(percentile(values, 0.95), 48.0);
    EXPECT_DOUBLE_EQ(percentile(values, 0.25), 20.0);
}

TEST(Percentile, KeepsAnInfinityWithoutMakingANaN) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(percentile(Values{1.0, infinity, infinity}, 0.75), infinity);
}

TEST(Percentile, RefusesNoValuesNaNAndPOutsideItsRange) {
    EXPECT_THROW(percentile({}, 0.5), std::invalid_argument);
    EXPECT_THROW(percentile(Values{1.0}, 1.5), std::invalid_argument);
    EXPECT_THROW(percentile(Values{1.0}, -0.1), std::invalid_argument);
    EXPECT_THROW(percentile(Values{1.0, std::numeric_limits<double>::quiet_NaN()}, 0.5),
                 std::invalid_argument);
}

TEST(Median, OfAnEvenNumberIsTheMiddleOfTheTwoInnermost) {
    EXPECT_DOUBLE_EQ(median(Values{4.0, 1.0, 3.0, 100.0}), 3.5);
    EXPECT_DOUBLE_EQ(median(Values{5.0, 1.0, 3.0}), 3.0);
}

TEST(GeometricMean, OfReciprocalsIsOne) {
    EXPECT_DOUBLE_EQ(geometric_mean(Values{0.5, 2.0, 0.25, 4.0}), 1.0);
    EXPECT_NEAR(geometric_mean(Values{1.0, 8.0}), 2.8284271247, 1e-9);
}

TEST(GeometricMean, RefusesWhatHasNoLogarithm) {
    EXPECT_THROW(geometric_mean({}), std::invalid_argument);
    EXPECT_THROW(geometric_mean(Values{1.0, 0.0}), std::invalid_argument);
    EXPECT_THROW(geometric_mean(Values{1.0, -2.0}), std::invalid_argument);
}

TEST(Ratios, CancelASlowRound) {
    // The machine was three times slower in the second round; the ratio does not see it.
    EXPECT_THAT(ratios(Values{2.0, 6.0, 2.0}, Values{1.0, 3.0, 1.0}), testing::Each(2.0));
    EXPECT_THROW(ratios(Values{1.0}, Values{}), std::invalid_argument);
}

TEST(Interleave, RunsEachOnceARoundInAlternatingOrder) {
    std::string order;
    const std::vector<Measurement> measurements{
        [&] {
            order += 'a';
            return 1.0;
        },
        [&] {
            order += 'b';
            return 2.0;
        },
    };
    const auto results = interleave(measurements, 3);
    EXPECT_EQ(order, "abbaab");
    ASSERT_EQ(results.size(), 2U);
    EXPECT_THAT(results[0], testing::ElementsAre(1.0, 1.0, 1.0));
    EXPECT_THAT(results[1], testing::ElementsAre(2.0, 2.0, 2.0));
}

} // namespace
