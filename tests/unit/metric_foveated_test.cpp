// Scores around the gaze.
#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include "host/metric/flip.hpp"
#include "host/metric/foveated.hpp"
#include "host/metric/score.hpp"
#include "tests/support/pictures.hpp"

namespace macula::metric {
namespace {

using scene::Eye;
using test::blurred_at;
using test::noise;
using test::texture;

constexpr glm::dvec3 kAhead{0.0, 0.0, -1.0};

// 80 degrees wide and 40 high at its centre's density.
struct Screen {
    scene::Display display = flat_display(320, 160, 4.0);
    ScalarMap density = density_map(display, Eye::mono);

    ScalarMap eccentricity(double x, double y) const {
        return eccentricity_map(display, Eye::mono, pixel_direction(display, Eye::mono, x, y));
    }
};

double mean(const ScalarMap& map) {
    return pool(map.values).mean;
}

TEST(Foveated, AFlatDisplayHasItsDensityAtTheCentre) {
    const scene::Display display = flat_display(201, 101, 12.5);
    EXPECT_NEAR(density_map(display, Eye::mono).values[50 * 201 + 100], 12.5, 1e-5);
    const ScalarMap e = eccentricity_map(display, Eye::mono, kAhead);
    EXPECT_NEAR(e.values[50 * 201 + 100], 0.0, 1e-6);
    // One pixel is 1 / 12.5 degrees on the plane: its arc tangent is the angle.
    const double pixel = std::atan(100 / 12.5 * M_PI / 180.0) * 180.0 / M_PI;
    EXPECT_NEAR(e.values[50 * 201 + 200], pixel, 1e-4);
}

TEST(Foveated, EqualsFlipAtTheGaze) {
    const Picture a = noise(60, 50, 1), b = noise(60, 50, 2);
    EXPECT_EQ(foveated_flip(a, b, ScalarMap(60, 50), ScalarMap(60, 50, 16.0f)).values,
              flip(a, b, 16.0).values);
}

TEST(Foveated, IsFlipAtTheDensityThatTheEccentricityMakes) {
    // All pixels at 2.3 degrees: detail is half as fine, as on a display of twice the density.
    const Picture a = noise(60, 50, 1), b = noise(60, 50, 2);
    const ScalarMap errors = foveated_flip(a, b, ScalarMap(60, 50, 2.3f), ScalarMap(60, 50, 16.0f));
    const ScalarMap expected = flip(a, b, 32.0);
    for (std::size_t i = 0; i < errors.values.size(); ++i)
        EXPECT_NEAR(errors.values[i], expected.values[i], 1e-5);
}

TEST(Foveated, HalvedPicturesGiveNearlyTheSameErrors) {
    // Half of the pixels at the density of the base, the others where pictures are halved first.
    const Picture a = texture(120, 90);
    Picture b = a;
    for (std::size_t i = 0; i < b.rgb.size(); ++i)
        b.rgb[i] *= i / 3 % 120 < 80 ? 0.8f : 1.1f;
    ScalarMap density(120, 90, 100.0f);
    for (std::size_t i = 0; i < density.values.size(); ++i)
        density.values[i] = i % 120 < 40 ? 100.0f : 400.0f;
    const ScalarMap found = foveated_flip(a, b, ScalarMap(120, 90), density);
    const ScalarMap fine = flip(a, b, 400.0);
    double difference = 0.0, total = 0.0;
    for (std::uint32_t y = 0; y < 90; ++y) {
        for (std::uint32_t x = 40; x < 120; ++x) {
            difference += std::fabs(found.values[y * 120 + x] - fine.values[y * 120 + x]);
            total += fine.values[y * 120 + x];
        }
    }
    EXPECT_GT(total, 0.0);
    EXPECT_LT(difference, 0.05 * total);
}

TEST(Foveated, OfIdenticalPicturesIsZero) {
    const Screen screen;
    const Picture picture = texture(320, 160);
    EXPECT_THAT(foveated_flip(picture, picture, screen.eccentricity(40, 80), screen.density).values,
                testing::Each(0.0f));
}

TEST(Foveated, ABlurFarFromTheGazeCostsLessThanAtTheGaze) {
    const Screen screen;
    const Picture reference = texture(320, 160), test = blurred_at(reference, 60, 80, 20);
    // The gaze on the blur, then 30 degrees to the right of it.
    const glm::dvec3 at = pixel_direction(screen.display, Eye::mono, 60.5, 80.5);
    const glm::dvec2 angles = scene::angles_of_direction(at);
    const glm::dvec3 beside = scene::direction_of_angles(angles.x + 30.0, angles.y);
    const auto cost = [&](const glm::dvec3& gaze) {
        return mean(foveated_flip(
            reference, test, eccentricity_map(screen.display, Eye::mono, gaze), screen.density));
    };
    EXPECT_GT(cost(at), 0.0);
    EXPECT_LT(cost(beside), 0.6 * cost(at));
    // The further, the less.
    double last = cost(at);
    for (const double degrees : {5.0, 10.0, 20.0, 30.0, 45.0}) {
        const double now = cost(scene::direction_of_angles(angles.x + degrees, angles.y));
        EXPECT_LT(now, last) << degrees;
        last = now;
    }
}

TEST(Foveated, DoesNotDependOnTheNumberOfThreads) {
    const Screen screen;
    const Picture a = texture(320, 160), b = blurred_at(a, 200, 80, 25);
    const ScalarMap e = screen.eccentricity(160, 80);
    const ScalarMap many = foveated_flip(a, b, e, screen.density);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(foveated_flip(a, b, e, screen.density).values, many.values);
}

TEST(Foveated, RefusesMapsThatDoNotFit) {
    const Picture a = noise(8, 6, 1);
    const ScalarMap fits(8, 6, 10.0f), other(6, 8, 10.0f);
    EXPECT_THROW(foveated_flip(a, a, other, fits), std::invalid_argument);
    EXPECT_THROW(foveated_flip(a, a, fits, other), std::invalid_argument);
    EXPECT_THROW(foveated_flip(a, a, ScalarMap(8, 6, -1.0f), fits), std::invalid_argument);
    EXPECT_THROW(foveated_flip(a, a, ScalarMap(8, 6, std::nanf("")), fits), std::invalid_argument);
    EXPECT_THROW(foveated_flip(a, a, fits, ScalarMap(8, 6, 0.0f)), std::invalid_argument);
    EXPECT_THROW(band_scores(fits, other, default_bands()), std::invalid_argument);
}

TEST(Bands, ShareOutAllPixelsByEccentricity) {
    ScalarMap e(6, 1), errors(6, 1);
    e.values = {0.0f, 2.59f, 2.6f, 4.3f, 9.2f, 180.0f};
    errors.values = {0.1f, 0.3f, 0.5f, 0.6f, 0.7f, 0.9f};
    const auto scores = band_scores(errors, e, default_bands());
    ASSERT_EQ(scores.size(), 4u);
    std::vector<std::size_t> pixels;
    std::vector<double> means;
    for (const BandScore& score : scores) {
        pixels.push_back(score.pixels);
        means.push_back(score.errors.mean);
    }
    EXPECT_THAT(pixels, testing::ElementsAre(2, 1, 1, 2));
    EXPECT_THAT(means, testing::Pointwise(testing::DoubleNear(1e-6), {0.2, 0.5, 0.6, 0.8}));
    const Band none[] = {{"none", 20.0, 30.0}};
    EXPECT_EQ(band_scores(errors, e, none)[0].pixels, 0u);
    EXPECT_EQ(band_scores(errors, e, none)[0].errors.max, 0.0);
}

TEST(Score, AveragesFramesAndLeavesOutBandsThatAFrameDoesNotSee) {
    const Screen screen;
    const Picture a = texture(320, 160), b = blurred_at(a, 160, 80, 25);
    const View inside{screen.eccentricity(160, 80), screen.density};
    const View outside{eccentricity_map(screen.display, Eye::mono, {0, 1, 0}), screen.density};
    ScoreOptions options;
    options.pixels_per_degree = 4.0;
    const FrameScores frames[] = {score(a, b, options, &inside), score(a, a, options, &outside)};
    EXPECT_EQ(frames[1].bands[0].pixels, 0u);
    const FrameScores both = average(frames);
    EXPECT_DOUBLE_EQ(both.flip.mean, 0.5 * frames[0].flip.mean);
    EXPECT_EQ(both.flip.max, frames[0].flip.max);
    EXPECT_EQ(both.flip.min, 0.0);
    EXPECT_DOUBLE_EQ(both.bands[0].errors.mean, frames[0].bands[0].errors.mean);
    EXPECT_NEAR(both.psnr, frames[0].psnr + 10.0 * std::log10(2.0), 1e-9);
    EXPECT_DOUBLE_EQ(both.ssim, 0.5 * (frames[0].ssim + 1.0));
    EXPECT_THROW(average({}), std::invalid_argument);
}

} // namespace
} // namespace macula::metric
