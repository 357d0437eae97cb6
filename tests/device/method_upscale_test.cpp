// What gathers samples over frames: where it must be exact, and where it must converge.
#include <gtest/gtest.h>

#include "tests/support/upscale_pictures.hpp"

namespace {
using namespace macula;
using namespace macula::test;
using namespace macula::test::upscale;

TEST(Jitter, IsHaltonsSequenceAboutThePixelsMiddle) {
    EXPECT_EQ(frame::jitter_of(7, 0).x, 0.0f);
    EXPECT_EQ(frame::jitter_of(0, 64).x, 0.0f);
    EXPECT_FLOAT_EQ(frame::jitter_of(0, 64).y, 1.0f / 3.0f - 0.5f);
    EXPECT_FLOAT_EQ(frame::jitter_of(2, 64).x, 0.75f - 0.5f);
    EXPECT_FLOAT_EQ(frame::jitter_of(3, 64).y, 4.0f / 9.0f - 0.5f);
    EXPECT_EQ(frame::jitter_of(5, 64).x, frame::jitter_of(69, 64).x);
}

TEST(Jitter, RepeatsAfterSixteenFramesForEachRenderedPixel) {
    const method::TemporalOptions twice{.ratio = 2.0f}, defaults;
    EXPECT_EQ(method::find_method("full").jitter_phases(1920, defaults), 0u);
    EXPECT_EQ(method::find_method("logpolar+taa").jitter_phases(1920, defaults), 16u);
    EXPECT_EQ(method::find_method("full+upscale").jitter_phases(1920, defaults), 64u);
    EXPECT_EQ(method::find_method("full+upscale").jitter_phases(1920, twice), 64u);
}

TEST(RenderSize, IsThePictureDividedByTheRatio) {
    const method::Method& m = method::find_method("logpolar+taa+upscale");
    EXPECT_EQ(m.render_size(1920, 1080, {}).width, 1067u);
    EXPECT_EQ(m.render_size(1920, 1080, {}).height, 600u);
    EXPECT_EQ(m.render_size(1, 1, {.ratio = 4.0f}).height, 1u);
    EXPECT_EQ(method::find_method("logpolar").render_size(50, 40, {}).width, 50u);
    for (const float bad : {0.9f, 4.1f, NAN})
        EXPECT_THROW(m.render_size(64, 64, {.ratio = bad}), std::invalid_argument);
}

TEST(Upscale, ByOneWithoutJitterReturnsItsInput) {
    for (const char* method : {"full+upscale", "weier+upscale"}) {
        WeierSetup setup = of_method(method);
        setup.temporal.ratio = 1.0f;
        setup.jitter = false;
        WeierFrames frames(device(), cornell(), setup);
        for (std::uint32_t frame = 0; frame < 4; ++frame) {
            frames.run(frame, moved(cornell(), {0.02f * float(frame / 2), 0, 0}));
            EXPECT_TRUE(
                same_bits(frames.read<Float4>(frames.picture()), frames.read<Float4>("colour")))
                << method << ", frame " << frame;
        }
    }
}

TEST(Antialiasing, WithoutAHistoryReturnsItsInput) {
    WeierFrames frames(device(), cornell(), of_method("logpolar+taa"));
    for (std::uint32_t frame = 0; frame < 2; ++frame) {
        frames.run(2 * frame, cornell().cameras.front());
        EXPECT_TRUE(same_bits(frames.read<Float4>("stable colour"), frames.read<Float4>("colour")));
        frames.run(2 * frame + 1, cornell().cameras.front());
        EXPECT_FALSE(
            same_bits(frames.read<Float4>("stable colour"), frames.read<Float4>("colour")));
        frames.forget();
    }
}

TEST(Antialiasing, OfAStillViewConvergesToTheMeanOverTheJitter) {
    for (const bool disk : {true, false}) {
        WeierFrames frames(device(), cornell(),
                           disk ? whole_disk("logpolar+taa") : of_method("logpolar+taa"));
        constexpr std::uint32_t kCycle = 16;
        std::vector<Picture> smoothed;
        Picture mean;
        for (std::uint32_t frame = 0; frame < 4 * kCycle; ++frame) {
            frames.run(frame, cornell().cameras.front());
            smoothed.push_back(frames.read<Float4>("stable colour"));
            const Picture now = frames.read<Float4>("colour");
            mean.resize(now.size(), {});
            for (std::size_t i = 0; i < now.size(); ++i) {
                mean[i].x += now[i].x / (4 * kCycle);
                mean[i].y += now[i].y / (4 * kCycle);
                mean[i].z += now[i].z / (4 * kCycle);
            }
        }
        const double first = mean_error(smoothed[0], mean);
        const double later = mean_error(smoothed[kCycle - 1], mean);
        const double last = mean_error(smoothed.back(), mean);
        // Beyond the disk a texel's jitter goes from surface to surface, and what is taken for
        // another one starts anew.
        EXPECT_LT(later, 0.5 * first) << "disk " << disk;
        EXPECT_LT(last, (disk ? 0.2 : 0.45) * first) << "disk " << disk;
    }
}

TEST(Upscale, OfAStillViewComesCloserToTheTruthThanAPictureOfOneSample) {
    WeierFrames frames(device(), cornell(), of_method("full+upscale"));
    WeierSetup setup = of_method("full");
    WeierFrames full(device(), cornell(), setup);
    setup.samples_per_pixel = 64;
    WeierFrames truth(device(), cornell(), setup);
    full.run(0, cornell().cameras.front());
    truth.run(0, cornell().cameras.front());
    const Picture reference = truth.read<Float4>("colour");
    std::vector<double> errors;
    for (std::uint32_t frame = 0; frame < 64; ++frame) {
        frames.run(frame, cornell().cameras.front());
        errors.push_back(mean_error(frames.read<Float4>(frames.picture()), reference));
    }
    EXPECT_LT(errors[15], 0.7 * errors[0]);
    EXPECT_LT(errors[63], errors[15]);
    EXPECT_LT(errors[63], mean_error(full.read<Float4>("colour"), reference));
}

TEST(Upscale, AfterMethodWeierConvergesInAStillView) {
    WeierSetup setup = of_method("weier+upscale");
    WeierFrames frames(device(), cornell(), setup);
    setup.method = "full";
    setup.samples_per_pixel = 64;
    WeierFrames truth(device(), cornell(), setup);
    truth.run(0, cornell().cameras.front());
    const Picture reference = truth.read<Float4>("colour");
    std::vector<double> errors;
    for (std::uint32_t frame = 0; frame < 64; ++frame) {
        frames.run(frame, cornell().cameras.front());
        errors.push_back(mean_error(frames.read<Float4>(frames.picture()), reference));
    }
    EXPECT_LT(errors[15], 0.9 * errors[0]);
    EXPECT_LT(errors[63], errors[15]);
}

TEST(Upscale, AfterAFullFovealRegionIsThatAfterMethodFullBitForBit) {
    WeierSetup setup = of_method("weier+upscale");
    setup.weier.r0 = setup.weier.r1 = INFINITY;
    setup.weier.p_min = 1.0f;
    WeierFrames foveated(device(), cornell(), setup);
    setup.method = "full+upscale";
    WeierFrames full(device(), cornell(), setup);
    for (std::uint32_t frame = 0; frame < 5; ++frame) {
        const scene::Camera view = moved(cornell(), {0.02f * float(frame / 2), 0, 0});
        foveated.run(frame, view);
        full.run(frame, view);
        EXPECT_TRUE(
            same_bits(foveated.read<Float4>(foveated.picture()), full.read<Float4>(full.picture())))
            << "frame " << frame;
    }
}

// The place of a pixel of the picture among `from` samples, of which it has `to`.
struct Between {
    int nearest;
    double weights[3];
};

Between between(std::uint32_t pixel, std::uint32_t to, std::uint32_t from) {
    const double at = (pixel + 0.5) * from / to - 0.5, nearest = std::nearbyint(at);
    const double t = std::abs(at - nearest), before = t * t - 0.5 * t, after = t * t + 0.5 * t;
    return {static_cast<int>(nearest),
            {at > nearest ? before : after, 1.0 - 2.0 * t * t, at > nearest ? after : before}};
}

// Dodgson's quadratic between the three by three samples around a pixel.
double quadratic(const Picture& samples, int width, int height, const Between& across,
                 const Between& down) {
    double sum = 0.0;
    for (int k = 0; k < 9; ++k) {
        const int x = std::clamp(across.nearest + k % 3 - 1, 0, width - 1);
        const int y = std::clamp(down.nearest + k / 3 - 1, 0, height - 1);
        sum += across.weights[k % 3] * down.weights[k / 3] * samples[y * width + x].y;
    }
    return std::max(sum, 0.0);
}

TEST(Upscale, BeyondTheDiskThePictureIsAQuadraticBetweenItsSamples) {
    for (const float ratio : {1.0f, 1.8f, 4.0f}) {
        WeierSetup setup = of_method("logpolar+taa+upscale");
        setup.width = 101; // no whole strip, no whole block of rows
        setup.height = 75;
        setup.temporal.ratio = ratio;
        setup.outputs = {"fovea", "stable colour"};
        WeierFrames frames(device(), cornell(), setup);
        frames.run(0, cornell().cameras.front());
        const auto fovea = frames.read<shared::Fovea>("fovea").front();
        const Picture samples = frames.read<Float4>("stable colour");
        const Picture picture = frames.read<Float4>(frames.picture());
        const auto [width, height] = method::find_method(setup.method)
                                         .render_size(setup.width, setup.height, setup.temporal);
        double worst = 0.0;
        std::size_t beyond = 0;
        for (std::uint32_t i = 0; i < picture.size(); ++i) {
            const std::uint32_t x = i % setup.width, y = i / setup.width;
            const double dx = (x + 0.5) * width / setup.width - fovea.x;
            const double dy = (y + 0.5) * height / setup.height - fovea.y;
            if (std::hypot(dx, dy) < fovea.radius + 0.01)
                continue;
            ++beyond;
            const double expected =
                quadratic(samples, int(width), int(height), between(x, setup.width, width),
                          between(y, setup.height, height));
            worst = std::max(worst, std::abs(expected - picture[i].y));
        }
        EXPECT_LT(worst, 1e-5) << "ratio " << ratio;
        EXPECT_GT(beyond, picture.size() / 2);
    }
}

} // namespace
