// MSE, PSNR and SSIM against values by hand.
#include <cmath>

#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include "host/metric/classic.hpp"
#include "host/metric/heat_map.hpp"
#include "tests/support/pictures.hpp"

namespace macula::metric {
namespace {

using test::noise;
using test::plain;

double encoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

TEST(Classic, IdenticalPicturesScoreNothingOneAndInfinity) {
    const Picture picture = noise(37, 29, 1);
    EXPECT_EQ(mse(picture, picture), 0.0);
    EXPECT_TRUE(std::isinf(psnr(mse(picture, picture))));
    EXPECT_EQ(ssim(picture, picture), 1.0);
}

TEST(Classic, MeanSquaredErrorIsOfWhatADisplayShows) {
    // One channel of three differs, by the encoded step from 0.2 to 0.5.
    const double step = encoded(0.5) - encoded(0.2);
    const double found = mse(plain(8, 5, 0.2f, 0.4f, 0.6f), plain(8, 5, 0.5f, 0.4f, 0.6f));
    EXPECT_NEAR(found, step * step / 3.0, 1e-7);
    EXPECT_EQ(mse(plain(8, 5, 1, 1, 1), plain(8, 5, 9, 9, 9)), 0.0) << "both are white";
    EXPECT_NEAR(mse(plain(8, 5, 0, 0, 0), plain(8, 5, 1, 1, 1)), 1.0, 1e-6);
    EXPECT_EQ(psnr(1.0), 0.0);
    EXPECT_NEAR(psnr(0.001), 30.0, 1e-12);
}

TEST(Classic, SimilarityOfPlainPicturesIsThatOfTheirMeans) {
    // Without variance the second factor is 1; grey has the encoded value as its luma.
    const double a = encoded(0.2), b = encoded(0.5), c1 = 1e-4;
    const double expected = (2.0 * a * b + c1) / (a * a + b * b + c1);
    for (const std::uint32_t side : {40u, 11u, 10u, 3u, 1u})
        EXPECT_NEAR(ssim(plain(side, side, 0.2f, 0.2f, 0.2f), plain(side, side, 0.5f, 0.5f, 0.5f)),
                    expected, 1e-6)
            << side;
}

TEST(Classic, SimilarityOfANegativeIsNegative) {
    Picture picture = noise(40, 40, 2), negative = picture;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        const bool white = picture.rgb[i / 3 * 3] > 0.5f;
        picture.rgb[i] = white ? 1.0f : 0.0f;
        negative.rgb[i] = white ? 0.0f : 1.0f;
    }
    EXPECT_LT(ssim(picture, negative), -0.8);
}

TEST(Classic, DoNotDependOnTheNumberOfThreads) {
    const Picture a = noise(201, 83, 3), b = noise(201, 83, 4);
    const double m = mse(a, b), s = ssim(a, b);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(mse(a, b), m);
    EXPECT_EQ(ssim(a, b), s);
}

TEST(HeatMap, IsMagma) {
    using Rgb = std::array<std::uint8_t, 3>;
    EXPECT_EQ(magma(0.0f), (Rgb{0, 0, 4}));
    EXPECT_EQ(magma(1.0f), (Rgb{252, 253, 191}));
    EXPECT_EQ(magma(128.0f / 255.0f), (Rgb{183, 55, 121}));
    EXPECT_EQ(magma(-1.0f), magma(0.0f));
    EXPECT_EQ(magma(7.0f), magma(1.0f));
    EXPECT_EQ(magma(std::nanf("")), magma(0.0f));
    ScalarMap errors(2, 1);
    errors.values = {0.0f, 1.0f};
    EXPECT_EQ(heat_map(errors), (std::vector<std::uint8_t>{0, 0, 4, 252, 253, 191}));
}

} // namespace
} // namespace macula::metric
