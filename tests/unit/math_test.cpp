// The portable functions against the double-precision library: errors in ULP of the float result.
#include "lib/math.h"

#include <cmath>
#include <cstdint>
#include <functional>

#include <gtest/gtest.h>

namespace {
using namespace macula;

double ulp_of(double value) {
    const float f = std::fabs(static_cast<float>(value));
    return static_cast<double>(std::nextafterf(f, INFINITY)) - static_cast<double>(f);
}

// Largest error over `count` points spread over [lo, hi] by an irrational stride.
double worst_ulp(double lo, double hi, const std::function<float(float)>& ours,
                 const std::function<double(double)>& exact, double least_ulp = 0.0) {
    double worst = 0.0;
    for (int i = 0; i < 400000; ++i) {
        const double unit = std::fmod(i * 0.6180339887498949, 1.0);
        const auto x = static_cast<float>(lo + (hi - lo) * unit);
        const double truth = exact(x);
        const double unit_error = std::max(ulp_of(truth), least_ulp);
        worst = std::max(worst, std::fabs(static_cast<double>(ours(x)) - truth) / unit_error);
    }
    return worst;
}

constexpr double kUlpOfOne = 0x1p-24;

TEST(Math, SoftwareReciprocalIsCorrectlyRoundedForEveryMantissa) {
    for (std::uint32_t mantissa = 0; mantissa < (1u << 23); ++mantissa) {
        const float x = shared::as_float(0x3f800000u | mantissa);
        ASSERT_EQ(shared::m_reciprocal_in_software(x), 1.0f / x) << std::hexfloat << x;
    }
}

TEST(Math, SoftwareSquareRootIsCorrectlyRoundedForEveryMantissaOfBothParities) {
    for (std::uint32_t bits = 0x3f800000u; bits < 0x40800000u; ++bits) {
        const float x = shared::as_float(bits);
        ASSERT_EQ(shared::m_sqrt_in_software(x), std::sqrt(x)) << std::hexfloat << x;
    }
    EXPECT_EQ(shared::m_sqrt_in_software(0.0f), 0.0f);
}

TEST(Math, SoftwareDivisionIsCorrectlyRoundedOnManyPairs) {
    std::uint32_t state = 1;
    const auto next = [&state] {
        state = state * 1664525u + 1013904223u;
        return shared::as_float(0x3f800000u | (state >> 9)) * ((state & 256u) ? 1024.0f : -0.0625f);
    };
    for (int i = 0; i < 20000000; ++i) {
        const float n = next(), d = next();
        ASSERT_EQ(shared::m_divide_in_software(n, d), n / d) << std::hexfloat << n << " / " << d;
    }
}

TEST(Math, InverseSquareRoot) {
    EXPECT_LE(
        worst_ulp(1e-6, 1e6, shared::m_inverse_sqrt, [](double x) { return 1 / std::sqrt(x); }),
        1.5);
}

TEST(Math, Exponentials) {
    EXPECT_LE(worst_ulp(-125, 127, shared::m_exp2, [](double x) { return std::exp2(x); }), 1.2);
    EXPECT_LE(worst_ulp(-80, 80, shared::m_exp, [](double x) { return std::exp(x); }), 2.0);
}

TEST(Math, Logarithm) {
    EXPECT_LE(worst_ulp(
                  1e-6, 1e6, shared::m_log2, [](double x) { return std::log2(x); }, kUlpOfOne),
              2.0);
}

TEST(Math, PowerWithLargeExponents) {
    for (const float y : {0.45454547f, 2.2f, 8.0f, 64.0f, 1000.0f}) {
        const double lo = std::exp2(-80.0 / y);
        EXPECT_LE(worst_ulp(
                      lo, 1.0, [y](float x) { return shared::m_pow(x, y); },
                      [y](double x) { return std::pow(x, static_cast<double>(y)); }),
                  y <= 8.0f ? 2.0 : 10.0)
            << "exponent " << y;
    }
    EXPECT_EQ(shared::m_pow(0.0f, 0.0f), 1.0f);
    EXPECT_EQ(shared::m_pow(0.0f, 3.0f), 0.0f);
}

TEST(Math, SineAndCosineOfTurns) {
    const auto sine = [](float x) {
        float c = 0.0f;
        return shared::m_sin_cos_pi(x, &c);
    };
    const auto cosine = [](float x) {
        float c = 0.0f;
        shared::m_sin_cos_pi(x, &c);
        return c;
    };
    constexpr double pi = 3.14159265358979323846;
    EXPECT_LE(worst_ulp(
                  -4, 4, sine, [](double x) { return std::sin(pi * x); }, kUlpOfOne),
              2.0);
    EXPECT_LE(worst_ulp(
                  -4, 4, cosine, [](double x) { return std::cos(pi * x); }, kUlpOfOne),
              2.0);
    EXPECT_EQ(sine(0.5f), 1.0f);
    EXPECT_EQ(cosine(1.0f), -1.0f);
}

TEST(Math, ArcFunctions) {
    EXPECT_LE(worst_ulp(
                  -1, 1, shared::m_acos, [](double x) { return std::acos(x); }, 0x1p-23),
              2.0);
    const auto around = [](float x) { return shared::m_atan2(x, 0.7f); };
    const auto behind = [](float x) { return shared::m_atan2(x, -0.7f); };
    EXPECT_LE(worst_ulp(-9, 9, around, [](double x) { return std::atan2(x, 0.7f); }), 4.0);
    EXPECT_LE(worst_ulp(-9, 9, behind, [](double x) { return std::atan2(x, -0.7f); }), 4.0);
    EXPECT_EQ(shared::m_atan2(0.0f, 0.0f), 0.0f);
}

} // namespace
