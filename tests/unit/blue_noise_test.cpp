// The mask of spatio-temporal blue noise: its histograms, and its spectra in the image and in time
// beside white noise; the points that are drawn from it.
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <xxhash.h>

#include "host/frame/blue_noise.hpp"
#include "lib/blue_noise.h"

namespace {
using namespace macula;

constexpr std::uint32_t kSide = MACULA_NOISE_SIDE, kSlices = MACULA_NOISE_SLICES;
constexpr std::uint32_t kSlice = kSide * kSide;

enum class Half { u, v };

// The numbers of one dimension in [0, 1), slice by slice.
std::vector<double> numbers(Half half) {
    std::vector<double> out;
    for (const std::uint32_t texel : frame::blue_noise())
        out.push_back((half == Half::u ? texel >> 16 : texel & 0xffffu) / 65536.0);
    return out;
}

std::vector<double> white_numbers() {
    std::vector<double> out;
    for (std::uint32_t i = 0; i < kSlice * kSlices; ++i)
        out.push_back(shared::random_unit(shared::random_key(i, 3, 4), 0, 0));
    return out;
}

double power(double real, double imaginary, double count) {
    return (real * real + imaginary * imaginary) / count;
}

// Mean power of a slice's waves of at most `most` periods across it, without the mean.
double low_power(const std::vector<double>& numbers, std::uint32_t slice, int most) {
    double sum = 0.0;
    int waves = 0;
    for (int ky = -most; ky <= most; ++ky)
        for (int kx = -most; kx <= most; ++kx) {
            if ((kx == 0 && ky == 0) || kx * kx + ky * ky > most * most)
                continue;
            double real = 0.0, imaginary = 0.0;
            for (std::uint32_t i = 0; i < kSlice; ++i) {
                const double turn =
                    2.0 * std::numbers::pi / kSide * (kx * int(i % kSide) + ky * int(i / kSide));
                real += numbers[slice * kSlice + i] * std::cos(turn);
                imaginary += numbers[slice * kSlice + i] * std::sin(turn);
            }
            sum += power(real, imaginary, kSlice);
            ++waves;
        }
    return sum / waves;
}

// Mean power over all pixels of the wave of k periods in all slices.
double power_in_time(const std::vector<double>& numbers, int k) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < kSlice; ++i) {
        double real = 0.0, imaginary = 0.0;
        for (std::uint32_t t = 0; t < kSlices; ++t) {
            const double turn = 2.0 * std::numbers::pi * k * t / kSlices;
            real += numbers[t * kSlice + i] * std::cos(turn);
            imaginary += numbers[t * kSlice + i] * std::sin(turn);
        }
        sum += power(real, imaginary, kSlices);
    }
    return sum / kSlice;
}

TEST(BlueNoise, EachSliceHoldsEachRankOnce) {
    const std::vector<std::uint16_t> ranks = frame::make_blue_noise(7);
    ASSERT_EQ(ranks.size(), std::size_t{kSlice} * kSlices);
    for (std::uint32_t slice = 0; slice < kSlices; ++slice) {
        const std::set<std::uint16_t> seen(ranks.begin() + slice * kSlice,
                                           ranks.begin() + (slice + 1) * kSlice);
        EXPECT_EQ(seen.size(), kSlice);
        EXPECT_EQ(*seen.rbegin(), kSlice - 1);
    }
}

TEST(BlueNoise, IsTheSameOnEveryMachine) {
    const auto& texels = frame::blue_noise();
    EXPECT_EQ(XXH3_64bits(texels.data(), texels.size() * sizeof(texels[0])), 3569097093130026171u);
}

class EachHalf : public testing::TestWithParam<Half> {};

TEST_P(EachHalf, HasAlmostNoLowFrequenciesInASlice) {
    const std::vector<double> blue = numbers(GetParam()), white = white_numbers();
    for (const std::uint32_t slice : {0u, 5u, 15u}) {
        const double part = low_power(blue, slice, 8) / low_power(white, slice, 8);
        EXPECT_LT(part, 0.05) << "slice " << slice;
        RecordProperty("low_power_of_white", std::to_string(part));
    }
}

TEST_P(EachHalf, HasFewLowFrequenciesAtAPixelInTime) {
    const std::vector<double> blue = numbers(GetParam()), white = white_numbers();
    for (const int k : {1, 2}) {
        const double part = power_in_time(blue, k) / power_in_time(white, k);
        EXPECT_LT(part, 0.2) << k << " periods in " << kSlices << " frames";
    }
}

INSTANTIATE_TEST_SUITE_P(Mask, EachHalf, testing::Values(Half::u, Half::v),
                         [](const auto& half) { return half.param == Half::u ? "u" : "v"; });

TEST(BlueNoise, ItsTwoNumbersAreUncorrelated) {
    const std::vector<double> u = numbers(Half::u), v = numbers(Half::v);
    double sum = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i)
        sum += (u[i] - 0.5) * (v[i] - 0.5);
    // The variance of a uniform number is 1/12; independent ones give a correlation of 0.004.
    EXPECT_LT(std::fabs(12.0 * sum / double(u.size())), 0.02);
}

TEST(BluePoints, OfOnePixelFillTheSquareEvenly) {
    // 36 samples of 3 rays: each cell of 6 x 6 should get 3.
    for (const std::uint32_t texel : {0u, 0x12345678u, 0xfff0fff0u}) {
        std::vector<int> cells(36);
        for (std::uint32_t i = 0; i < 108; ++i) {
            float u, v;
            shared::blue_point(texel, i, &u, &v);
            ASSERT_GE(std::min(u, v), 0.0f);
            ASSERT_LT(std::max(u, v), 1.0f);
            ++cells[std::size_t(u * 6.0f) * 6 + std::size_t(v * 6.0f)];
        }
        for (const int count : cells) {
            EXPECT_GE(count, 1);
            EXPECT_LE(count, 5);
        }
    }
}

TEST(BluePoints, FindTheirTexelFromAnyPlaceFrameAndShift) {
    std::set<std::uint32_t> seen;
    for (std::uint32_t y = 0; y < kSide; ++y)
        for (std::uint32_t x = 0; x < kSide; ++x)
            seen.insert(shared::noise_texel(x + 640, y + 6400, 17, 0xabcdef12u));
    EXPECT_EQ(seen.size(), kSlice) << "a shifted slice is a whole slice";
    EXPECT_LT(shared::noise_texel(~0u, ~0u, ~0u, ~0u), kSlice * kSlices);
}

} // namespace
