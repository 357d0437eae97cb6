// Pooled errors by hand.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "host/metric/pool.hpp"

namespace macula::metric {
namespace {

TEST(Pool, WeightedQuantilesAreWhereTheRunningSumPasses) {
    // Sorted 0.1 0.2 0.3 0.4, running sums 0.1 0.3 0.6 1.0: a quarter is passed at 0.2, half at
    // 0.3, three quarters at 0.4.
    const std::vector<float> errors = {0.3f, 0.1f, 0.4f, 0.2f};
    const Pooled p = pool(errors);
    EXPECT_EQ(p.weighted_q1, 0.2f);
    EXPECT_EQ(p.weighted_median, 0.3f);
    EXPECT_EQ(p.weighted_q3, 0.4f);
    EXPECT_NEAR(p.mean, 0.25, 1e-7);
    EXPECT_EQ(p.min, 0.1f);
    EXPECT_EQ(p.max, 0.4f);
}

TEST(Pool, ASumThatIsJustReachedIsNotPassed) {
    // Half of the total of 1 is reached by the first two, and passed by the third.
    const std::vector<float> errors = {0.25f, 0.25f, 0.5f};
    EXPECT_EQ(weighted_quantile(errors, 0.5), 0.5);
    EXPECT_EQ(weighted_quantile(errors, 0.49), 0.25);
    EXPECT_EQ(weighted_quantile(errors, 1.0), 0.5);
    EXPECT_EQ(weighted_quantile(errors, 0.0), 0.25);
}

TEST(Pool, AFewLargeErrorsOutweighManySmall) {
    std::vector<float> errors(1000, 0.001f);
    errors[500] = errors[700] = 1.0f;
    EXPECT_EQ(pool(errors).weighted_median, 1.0);
    EXPECT_LT(pool(errors).mean, 0.01);
}

TEST(Pool, OfNothingWrongIsZero) {
    const Pooled p = pool(std::vector<float>(7, 0.0f));
    for (const double value :
         {p.mean, p.weighted_median, p.weighted_q1, p.weighted_q3, p.min, p.max})
        EXPECT_EQ(value, 0.0);
}

TEST(Pool, RefusesNoErrorsAndErrorsThatAreNone) {
    EXPECT_THROW(pool({}), std::invalid_argument);
    EXPECT_THROW(pool(std::vector<float>{0.1f, -0.1f}), std::invalid_argument);
    EXPECT_THROW(pool(std::vector<float>{0.1f, std::nanf("")}), std::invalid_argument);
}

} // namespace
} // namespace macula::metric
