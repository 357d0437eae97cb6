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

// But for alpha, which in "colour" says how near a sample lies.
bool same_colours(Picture a, Picture b) {
    for (Picture* picture : {&a, &b})
        for (Float4& pixel : *picture)
            pixel.w = 1.0f;
    return same_bits(a, b);
}

TEST(Antialiasing, WithoutAHistoryReturnsItsInput) {
    WeierFrames frames(device(), cornell(), of_method("logpolar+taa"));
    for (std::uint32_t frame = 0; frame < 2; ++frame) {
        frames.run(2 * frame, cornell().cameras.front());
        EXPECT_TRUE(
            same_colours(frames.read<Float4>("stable colour"), frames.read<Float4>("colour")));
        frames.run(2 * frame + 1, cornell().cameras.front());
        EXPECT_FALSE(
            same_colours(frames.read<Float4>("stable colour"), frames.read<Float4>("colour")));
        frames.forget();
    }
}

// A mean over frames: of all colours alike, or each with the weight that it has at rest.
class Mean {
  public:
    explicit Mean(bool weighted) : weighted_(weighted) {}

    void add(const Picture& picture) {
        sums_.resize(picture.size(), {});
        for (std::size_t i = 0; i < picture.size(); ++i) {
            const Float4& c = picture[i];
            const float weight = weighted_ ? c.w * c.w : 1.0f;
            Float4& sum = sums_[i];
            sum = {sum.x + weight * c.x, sum.y + weight * c.y, sum.z + weight * c.z,
                   sum.w + weight};
        }
    }
    Picture picture() const {
        Picture mean = sums_;
        for (Float4& c : mean)
            c = {c.x / c.w, c.y / c.w, c.z / c.w, 1.0f};
        return mean;
    }

  private:
    bool weighted_;
    Picture sums_;
};

TEST(Antialiasing, OfAStillViewConvergesToTheMeanOverTheJitter) {
    for (const bool disk : {true, false}) {
        WeierFrames frames(device(), cornell(),
                           disk ? whole_disk("logpolar+taa") : of_method("logpolar+taa"));
        constexpr std::uint32_t kCycle = 16;
        std::vector<Picture> smoothed;
        Mean mean(true);
        for (std::uint32_t frame = 0; frame < 4 * kCycle; ++frame) {
            frames.run(frame, cornell().cameras.front());
            smoothed.push_back(frames.read<Float4>("stable colour"));
            mean.add(frames.read<Float4>("colour"));
        }
        const double first = mean_error(smoothed[0], mean.picture());
        const double later = mean_error(smoothed[kCycle - 1], mean.picture());
        const double last = mean_error(smoothed.back(), mean.picture());
        // Beyond the disk a texel's jitter goes from surface to surface, and what is taken for
        // another one starts anew.
        // In it all frames count alike.
        EXPECT_LT(later, (disk ? 0.03 : 0.5) * first) << "disk " << disk;
        EXPECT_LT(last, (disk ? 0.03 : 0.45) * first) << "disk " << disk;
    }
}

// The mean over beyond the disk of the difference to the truth, which has no value above 1: lamps
// are shown as white.
double error_beyond_disk(Picture a, Picture b, int width, int height, double radius) {
    double sum = 0.0, count = 0.0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (std::hypot(x + 0.5 - 0.5 * width, y + 0.5 - 0.5 * height) < radius)
                continue;
            const Float4 &p = a[std::size_t(y * width + x)], &q = b[std::size_t(y * width + x)];
            sum += std::abs(std::min(p.x, 1.0f) - std::min(q.x, 1.0f)) +
                   std::abs(std::min(p.y, 1.0f) - std::min(q.y, 1.0f)) +
                   std::abs(std::min(p.z, 1.0f) - std::min(q.z, 1.0f));
            count += 3.0;
        }
    return sum / count;
}

TEST(Antialiasing, OfAStillViewResolvesMoreThanTheBuffersTexels) {
    WeierSetup setup = of_method("full");
    setup.samples_per_pixel = 64;
    WeierFrames truth(device(), cornell(), setup);
    truth.run(0, cornell().cameras.front());
    const Picture reference = truth.read<Float4>("colour");
    setup.samples_per_pixel = 1;
    const auto error = [&](const Picture& picture) {
        const double half = 0.5 * std::hypot(double(setup.width), double(setup.height));
        return error_beyond_disk(picture, reference, int(setup.width), int(setup.height),
                                 setup.log_polar.disk * half);
    };
    setup.method = "logpolar";
    WeierFrames foveated(device(), cornell(), setup);
    foveated.run(0, cornell().cameras.front());
    const double one_frame = error(foveated.read<Float4>("colour"));
    // Here texels of the log-rectilinear buffer take but two pixels by two.
    for (const auto& [method, bound] : {std::pair("logpolar+taa", 0.85), {"logrect+taa", 0.97}}) {
        setup.method = method;
        WeierFrames frames(device(), cornell(), setup);
        Mean mean(false);
        for (std::uint32_t frame = 0; frame < 64; ++frame) {
            frames.run(frame, cornell().cameras.front());
            mean.add(frames.read<Float4>("colour"));
        }
        const double gathered = error(frames.read<Float4>("stable colour"));
        EXPECT_LT(gathered, bound * error(mean.picture())) << method;
        EXPECT_LT(gathered, 0.6 * one_frame) << method;
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

// Dodgson's quadratic between three values, within what they span.
double quadratic(const Between& place, const double (&values)[3]) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
        sum += place.weights[k] * values[k];
    const auto [least, most] = std::minmax({values[0], values[1], values[2]});
    return std::clamp(sum, least, most);
}

// Along the rows of the three by three samples around a pixel, then between these.
double quadratic(const Picture& samples, int width, int height, const Between& across,
                 const Between& down) {
    double rows[3];
    for (int j = 0; j < 3; ++j) {
        const int y = std::clamp(down.nearest + j - 1, 0, height - 1);
        double row[3];
        for (int i = 0; i < 3; ++i)
            row[i] = samples[y * width + std::clamp(across.nearest + i - 1, 0, width - 1)].y;
        rows[j] = quadratic(across, row);
    }
    return quadratic(down, rows);
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
