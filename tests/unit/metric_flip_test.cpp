// FLIP on pictures whose errors are known, and its laws.
#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include "host/metric/flip.hpp"
#include "host/metric/pool.hpp"
#include "tests/support/pictures.hpp"

namespace macula::metric {
namespace {

using test::noise;
using test::plain;

TEST(Flip, OfIdenticalPicturesIsZeroEverywhere) {
    const Picture picture = noise(61, 47, 1);
    EXPECT_THAT(flip(picture, picture).values, testing::Each(0.0f));
    const Picture bright = noise(61, 47, 2, 40.0f);
    EXPECT_THAT(hdr_flip(bright, bright).values, testing::Each(0.0f));
}

TEST(Flip, OfGreenAndBlueIsOne) {
    const ScalarMap errors = flip(plain(24, 17, 0, 1, 0), plain(24, 17, 0, 0, 1));
    EXPECT_THAT(errors.values, testing::Each(testing::FloatNear(1.0f, 1e-5f)));
}

TEST(Flip, OfBlackAndWhiteFollowsFromLightnessAlone) {
    // Without edges the error is the colours': 100 of lightness between black and white, which lies
    // past the knee, 0.4 of the greatest distance (green to blue) to the power of 0.7.
    const auto lab = [](double x, double y, double z) {
        const double l = 116.0 * y - 16.0;
        return std::array<double, 3>{l, 0.01 * l * 500.0 * (x - y), 0.01 * l * 200.0 * (y - z)};
    };
    const auto green =
        lab(std::cbrt(0.357576 / 0.950429), std::cbrt(0.715152), std::cbrt(0.119192 / 1.0889));
    const auto blue =
        lab(std::cbrt(0.180437 / 0.950429), std::cbrt(0.072175), std::cbrt(0.950304 / 1.0889));
    const double most = std::pow(
        std::fabs(green[0] - blue[0]) + std::hypot(green[1] - blue[1], green[2] - blue[2]), 0.7);
    const double distance = std::pow(100.0, 0.7), knee = 0.4 * most;
    ASSERT_GT(distance, knee);
    const double expected = 0.95 + 0.05 * (distance - knee) / (most - knee);
    const ScalarMap errors = flip(plain(24, 17, 0, 0, 0), plain(24, 17, 1, 1, 1));
    EXPECT_THAT(errors.values,
                testing::Each(testing::FloatNear(static_cast<float>(expected), 1e-5f)));
}

TEST(Flip, DoesNotDependOnTheNumberOfThreads) {
    const Picture a = noise(97, 83, 3), b = noise(97, 83, 4);
    const ScalarMap many = flip(a, b);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(flip(a, b).values, many.values);
}

TEST(Flip, TakesPicturesThatAreSmallerThanItsFilters) {
    for (const auto& [width, height] : {std::pair{1u, 1u}, {1u, 9u}, {9u, 1u}, {2u, 2u}}) {
        const ScalarMap errors = flip(noise(width, height, 5), noise(width, height, 6), 300.0);
        EXPECT_EQ(errors.values.size(), std::size_t{width} * height);
        EXPECT_THAT(errors.values,
                    testing::Each(testing::AllOf(testing::Ge(0.0f), testing::Le(1.0f))));
    }
}

TEST(Flip, ClampsWhatADisplayCannotShow) {
    EXPECT_EQ(flip(plain(9, 9, -5, 0.5f, 7), plain(9, 9, 0, 0.5f, 1)).values,
              std::vector<float>(81, 0.0f));
}

TEST(Flip, RefusesWhatItCannotJudge) {
    const Picture good = noise(8, 8, 7);
    Picture bad = good;
    bad.rgb[3 * (2 * 8 + 5) + 1] = std::nanf("");
    const auto message = [](auto&& run) -> std::string {
        try {
            run();
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "nothing thrown";
    };
    EXPECT_THAT(message([&] { flip(good, bad); }),
                testing::HasSubstr("pixel (5, 2) is not a number"));
    EXPECT_THAT(message([&] { flip(good, noise(8, 9, 1)); }),
                testing::HasSubstr("the sizes differ: 8 x 8 and 8 x 9"));
    EXPECT_THAT(message([&] { flip({}, {}); }), testing::HasSubstr("0 x 0 pixels"));
    for (const double ppd : {0.0, -1.0, 1e9, std::nan("")})
        EXPECT_THAT(message([&] { flip(good, good, ppd); }),
                    testing::HasSubstr("pixels per degree"));
    bad = good;
    bad.rgb.pop_back();
    EXPECT_THAT(message([&] { flip(bad, good); }), testing::HasSubstr("191 values"));
}

TEST(HdrFlip, SeesWhatOneExposureHides) {
    // A light of 50 in place of one of 100: white on a display, another at a lower exposure.
    Picture reference = noise(40, 30, 8), test = reference;
    for (std::size_t i = 3 * 600; i < 3 * 640; ++i) {
        reference.rgb[i] = 100.0f;
        test.rgb[i] = 50.0f;
    }
    EXPECT_EQ(pool(flip(reference, test).values).max, 0.0);
    EXPECT_GT(pool(hdr_flip(reference, test).values).max, 0.1);
}

TEST(HdrFlip, ExposuresBringBrightestAndMedianPixelToTheSameGrey) {
    Picture picture = plain(3, 1, 1.0f, 1.0f, 1.0f);
    picture.rgb = {0.5f, 0.5f, 0.5f, 1.0f, 1.0f, 1.0f, 16.0f, 16.0f, 16.0f};
    const Exposures e = find_exposures(picture);
    EXPECT_NEAR(e.stop - e.start, 4.0, 1e-6);
    EXPECT_EQ(e.count, 4u);
    const double x = 0.6 * std::exp2(e.stop);
    EXPECT_NEAR((2.51 * x * x + 0.03 * x) / (2.43 * x * x + 0.59 * x + 0.14), 0.85, 1e-6);
}

TEST(HdrFlip, ABlackReferenceHasOneExposure) {
    const Exposures e = find_exposures(plain(4, 4, 0, 0, 0));
    EXPECT_EQ(e.count, 1u);
    EXPECT_GT(pool(hdr_flip(plain(4, 4, 0, 0, 0), plain(4, 4, 1, 1, 1)).values).mean, 0.5);
}

TEST(HdrFlip, TheUpperOfTwoMiddlePixelsIsTheMedianAndBlackIsNone) {
    Picture picture = plain(2, 1, 1.0f, 1.0f, 1.0f);
    picture.rgb = {1.0f, 1.0f, 1.0f, 4.0f, 4.0f, 4.0f};
    EXPECT_EQ(find_exposures(picture).stop, find_exposures(picture).start);
    EXPECT_EQ(find_exposures(picture).count, 2u);
    picture = plain(3, 1, 0.0f, 0.0f, 0.0f);
    picture.rgb[0] = 1.0f;
    EXPECT_EQ(find_exposures(picture).count, 21u) << "23 stops from 0.2126 to the step of a float";
}

TEST(HdrFlip, RefusesExposuresThatAreNone) {
    const Picture picture = noise(4, 4, 9);
    for (const Exposures& e :
         {Exposures{1.0, 0.0, 2}, Exposures{0.0, 1.0, 0}, Exposures{0.0, 1.0, 1},
          Exposures{0.0, 1.0, 100000}, Exposures{std::nan(""), 1.0, 2}})
        EXPECT_THROW(hdr_flip(picture, picture, 67.02, e), std::invalid_argument);
}

} // namespace
} // namespace macula::metric
