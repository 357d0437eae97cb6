// The warp for a lens: the identity without distortion, a known polynomial maps known points, each
// colour has its own, and the same bits on another runtime.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/kernel/library.hpp"
#include "host/render/renderer.hpp"
#include "lib/camera.h"
#include "scenes/load.hpp"

namespace {
using namespace macula;
using stage::LensDistortion;
using testing::HasSubstr;
using testing::ThrowsMessage;

// PoCL shows the same CPU by two of its drivers when it is asked to before it starts.
const bool kTwoDrivers = setenv("POCL_DEVICES", "pthread basic", 0) == 0;

constexpr std::uint32_t kWidth = 118, kHeight = 146;
const frame::Tangents kView{1.0586f, 1.0924f, 1.3299f, 1.2f};

struct Float4 {
    float x, y, z, w;
};

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

// The kernel over an image whose colours are all `value(column, row)`.
template <class Value>
std::vector<Float4> warped(const compute::Device& on, const LensDistortion& distortion,
                           Value value) {
    kernel::Library library;
    std::vector<Float4> image;
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
        const float v = value(float(i % kWidth), float(i / kWidth));
        image.push_back({v, v, v, 1.0f});
    }
    const shared::LensParams lens = stage::make_lens(distortion, kView, kWidth, kHeight);
    const compute::Buffer lenses = on.upload(std::span(&lens, 1), "lens"),
                          colour = on.upload(std::span(image), "colour"),
                          out = on.allocate_array<Float4>(image.size(), "warped");
    library.kernel(kernel::VariantKey("remap/lens"), "prewarp", on)
        .set(kWidth, kHeight, lenses, colour, out)
        .launch("warp", {shared::slot_count(kWidth, kHeight)}, {64});
    const auto found = out.map_read<Float4>();
    return {found.begin(), found.end()};
}

float wavy(float x, float y) {
    return 2.0f + std::sin(0.7f * x) * std::cos(1.3f * y);
}

// Where in the rendered image lies what the panel shows at (x, y), by the definition.
glm::dvec2 expected(const LensDistortion& k, std::size_t colour, double x, double y) {
    const auto edge = [&](double tangent) { return scene::undistort(k[1], tangent); };
    const double left = edge(kView.left), right = edge(kView.right), up = edge(kView.up),
                 down = edge(kView.down);
    const double sx = x / kWidth * (left + right) - left, sy = up - y / kHeight * (up + down);
    const double r = std::hypot(sx, sy), factor = scene::distort(k[colour], r) / r;
    return {(sx * factor + kView.left) / (double{kView.left} + kView.right) * kWidth,
            (kView.up - sy * factor) / (double{kView.up} + kView.down) * kHeight};
}

const LensDistortion kLens = {{{0.20, 0.22}, {0.22, 0.24}, {0.25, 0.26, 0.01}}};

TEST(Lens, WithoutDistortionEveryPixelIsItself) {
    for (const LensDistortion& none :
         {LensDistortion{}, LensDistortion{{{0.0}, {0.0, 0.0}, {0.0}}}}) {
        const auto found = warped(device(), none, wavy);
        for (std::uint32_t i = 0; i < found.size(); ++i) {
            const float v = wavy(float(i % kWidth), float(i / kWidth));
            ASSERT_EQ(found[i].x, v) << i;
            ASSERT_EQ(found[i].y, v) << i;
            ASSERT_EQ(found[i].z, v) << i;
        }
    }
}

// The cubic keeps ramps, so that the image of the columns, and of the rows, tells where a pixel's
// colours come from.
TEST(Lens, AKnownPolynomialMapsKnownPointsInEachColour) {
    const auto columns = warped(device(), kLens, [](float x, float) { return x + 0.5f; });
    const auto rows = warped(device(), kLens, [](float, float y) { return y + 0.5f; });
    std::size_t compared = 0, outside = 0;
    for (std::uint32_t i = 0; i < columns.size(); ++i) {
        const float* x = &columns[i].x;
        const float* y = &rows[i].x;
        for (std::size_t colour = 0; colour < 3; ++colour) {
            const glm::dvec2 at =
                expected(kLens, colour, double(i % kWidth) + 0.5, double(i / kWidth) + 0.5);
            if (at.x < -0.01 || at.y < -0.01 || at.x > kWidth + 0.01 || at.y > kHeight + 0.01) {
                ASSERT_EQ(x[colour], 0.0f) << i;
                ++outside;
            } else if (at.x > 2.0 && at.y > 2.0 && at.x < kWidth - 2.0 && at.y < kHeight - 2.0) {
                ASSERT_NEAR(x[colour], at.x, 1.0 / 512 + 1e-4) << i;
                ASSERT_NEAR(y[colour], at.y, 1.0 / 512 + 1e-4) << i;
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 30000u);
    EXPECT_GT(outside, 1000u) << "the corners";
}

// Where the edges are nearest to the axis, the panel shows the whole view in green.
TEST(Lens, ThePanelReachesToTheEdgesOfTheView) {
    const shared::LensParams lens = stage::make_lens(kLens, kView, kWidth, kHeight);
    EXPECT_NEAR(scene::distort(kLens[1], lens.left), kView.left, 1e-6);
    EXPECT_NEAR(scene::distort(kLens[1], lens.up), kView.up, 1e-6);
    const float right = lens.step_x * kWidth - lens.left, down = lens.step_y * kHeight - lens.up;
    EXPECT_NEAR(scene::distort(kLens[1], right), kView.right, 1e-6);
    EXPECT_NEAR(scene::distort(kLens[1], down), kView.down, 1e-6);
    EXPECT_GT(lens.most[0], 1e29f) << "it never turns back";
}

TEST(Lens, APincushionIsInvertedToo) {
    const LensDistortion barrel = {{{-0.05}, {-0.05}, {-0.05}}};
    const shared::LensParams lens = stage::make_lens(barrel, kView, kWidth, kHeight);
    EXPECT_NEAR(scene::distort(barrel[1], lens.left), kView.left, 1e-6);
    EXPECT_GT(lens.left, kView.left);
    // r (1 - 0.15 r^2) grows up to r^2 = 1 / 0.45.
    const LensDistortion strong = {{{-0.15}, {-0.05}, {-0.05}}};
    EXPECT_NEAR(stage::make_lens(strong, kView, kWidth, kHeight).most[0], 1.0 / 0.45, 0.01);
}

TEST(Lens, WhatItCannotDoIsAnError) {
    const auto made = [](const LensDistortion& k) {
        return [k] { stage::make_lens(k, kView, kWidth, kHeight); };
    };
    EXPECT_THAT(made({{{}, {-0.4}, {}}}),
                ThrowsMessage<std::invalid_argument>(HasSubstr("green polynomial turns back")));
    EXPECT_THAT(
        made({{{}, {}, std::vector<double>(9, 0.0)}}),
        ThrowsMessage<std::invalid_argument>(HasSubstr("more than 8 coefficients of blue")));
    render::Options options;
    options.lens = kLens;
    EXPECT_THAT([&] { render::Renderer(device(), scene::load("cornell"), options); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("tangents")));
}

TEST(Lens, TwoRuntimesGiveTheSameBits) {
    ASSERT_TRUE(kTwoDrivers);
    std::optional<compute::Device> basic;
    for (const auto& facts : compute::enumerate())
        if (facts.name.find("basic") != std::string::npos)
            basic = compute::open(std::to_string(facts.index));
    if (!basic)
        GTEST_SKIP() << "PoCL's driver \"basic\" is not there";
    const auto one = warped(device(), kLens, wavy), other = warped(*basic, kLens, wavy);
    EXPECT_EQ(std::memcmp(one.data(), other.data(), one.size() * sizeof(Float4)), 0);
}

// At the end of a frame of any method; the colour itself stays as it is.
TEST(Lens, IsTheLastStageOfAFrame) {
    const scene::Scene cornell = scene::load("cornell");
    for (const char* method : {"full", "weier", "lowres"}) {
        render::Options options;
        options.width = 70;
        options.height = 50;
        options.method = method;
        options.tangents = kView;
        render::Renderer plain(device(), cornell, options);
        options.lens = LensDistortion{};
        render::Renderer flat(device(), cornell, options);
        options.lens = kLens;
        render::Renderer curved(device(), cornell, options);
        std::string hash;
        for (std::uint32_t frame = 0; frame < 2; ++frame) {
            for (render::Renderer* renderer : {&plain, &flat, &curved})
                renderer->render(frame);
            EXPECT_EQ(flat.hash(), plain.hash()) << method;
            EXPECT_NE(curved.hash(), plain.hash()) << method;
            const render::Image a = plain.map("colour"), b = curved.map("colour");
            EXPECT_TRUE(std::equal(a.words.begin(), a.words.end(), b.words.begin())) << method;
        }
        const render::Image shown = curved.picture();
        EXPECT_EQ(shown.floats[0], 0.0f) << "a corner";
        EXPECT_THAT(curved.explain(), HasSubstr("warp for the lens"));
    }
}

} // namespace
