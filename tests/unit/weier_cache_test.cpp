// The cache's arithmetic (Weier et al. 2016, section 3.4): weights, ages, what a colour is worth.
#include <cmath>

#include <gtest/gtest.h>

#include "lib/cache_info.h"

namespace {
using namespace macula::shared;

// k_min 0.1, k_max 0.8, t_max 40.
float k_of(uint age) {
    const float least = std::log2(0.1f);
    return least_weight(age, least, (std::log2(0.8f) - least) / 39.0f, 0.8f);
}

TEST(LeastWeight, RunsFromTheLeastToTheMostAndStaysThere) {
    EXPECT_NEAR(k_of(1), 0.1f, 1e-6f);
    EXPECT_NEAR(k_of(40), 0.8f, 1e-5f);
    EXPECT_EQ(k_of(41), 0.8f);
    EXPECT_EQ(k_of(1u << 20), 0.8f);
    for (uint age = 1; age < 60; ++age)
        EXPECT_LE(k_of(age), k_of(age + 1));
    // Exponential: equal steps of age are equal factors.
    EXPECT_NEAR(k_of(21) / k_of(11), k_of(31) / k_of(21), 1e-5f);
}

TEST(BlendingWeight, IsTheLargerOfTheTwo) {
    EXPECT_EQ(blending_weight(0.0f, 0.1f), 1.0f); // a guess is replaced
    EXPECT_EQ(blending_weight(1.0f, 0.1f), 0.5f);
    EXPECT_FLOAT_EQ(blending_weight(3.0f, 0.1f), 0.25f);
    EXPECT_EQ(blending_weight(1000.0f, 0.1f), 0.1f);
}

TEST(Worth, CountsEqualSamplesUntilTheLimit) {
    float rho = 0.0f;
    for (int n = 1; n <= 8; ++n) {
        rho = samples_worth(blending_weight(rho, 0.0f), rho);
        EXPECT_NEAR(rho, float(n), 1e-4f);
    }
    for (int n = 0; n < 500; ++n)
        rho = samples_worth(blending_weight(rho, 0.1f), rho);
    // The fixed point of rho = 1 / (k^2 + (1 - k)^2 / rho): (2 - k) / k.
    EXPECT_NEAR(rho, 19.0f, 0.01f);
    EXPECT_EQ(samples_worth(1.0f, 7.0f), 1.0f);
    EXPECT_EQ(samples_worth(0.5f, 0.0f), 1.0f); // never a division by zero
}

TEST(Touch, AgesAreRightAcrossTheWrapOfTheFrameIndex) {
    for (const uint frame : {0u, 1u, 77u, 0xfffffu, 0x100000u, 0xfffffff0u}) {
        const uint word = pack_touch(1.0f, frame);
        EXPECT_EQ(alpha_of_touch(word), 1.0f);
        EXPECT_EQ(age_of_touch(word, frame), 1u); // the same frame again
        EXPECT_EQ(age_of_touch(word, frame + 1), 1u);
        EXPECT_EQ(age_of_touch(word, frame + 300), 300u);
    }
}

TEST(Touch, AlphaIsKeptToOnePartIn4095) {
    for (const float alpha : {0.0f, 0.1f, 0.5f, 0.7f})
        EXPECT_NEAR(alpha_of_touch(pack_touch(alpha, 5)), alpha, 0.5f / 4095.0f + 1e-7f);
}

} // namespace
