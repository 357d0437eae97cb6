// Method rrm (Smith et al. 2014): which pixels are refreshed when, and that it is method full.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/load.hpp"
#include "tests/support/small_scenes.hpp"
#include "tests/support/weier_frames.hpp"

namespace {
using namespace macula;
using namespace macula::test;

constexpr std::uint32_t kNever = 1048575;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

const scene::Scene& cornell() {
    static const scene::Scene loaded = scene::load("cornell");
    return loaded;
}

const scene::Camera& view() {
    return cornell().cameras.front();
}

WeierSetup rrm(std::uint32_t group_width, std::uint32_t group_height, float fovea) {
    WeierSetup setup;
    setup.method = "rrm";
    setup.outputs = {"cache age"};
    setup.rrm.group_width = group_width;
    setup.rrm.group_height = group_height;
    setup.rrm.fovea = fovea;
    return setup;
}

// Odd, and in no way a multiple of blocks or groups.
WeierSetup odd_sized(WeierSetup setup) {
    setup.width = 97;
    setup.height = 83;
    return setup;
}

using Words = std::vector<std::uint32_t>;

Words full(WeierSetup setup, std::uint32_t frame) {
    setup.method = "full";
    setup.outputs = {};
    WeierFrames frames(device(), cornell(), setup);
    frames.run(frame, view());
    return frames.read<std::uint32_t>("colour");
}

stage::PixelRectangle fovea_of(const WeierFrames& frames, const WeierSetup& setup) {
    return stage::foveal_rectangle(frames.params, setup.rrm.fovea, setup.rrm.block_width);
}

bool holds(const stage::PixelRectangle& r, std::uint32_t x, std::uint32_t y) {
    return x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1;
}

TEST(GroupsOfOneBlock, AreMethodFullBitForBit) {
    for (const auto lights : {frame::LightMode::area, frame::LightMode::ambient_occlusion})
        for (const std::uint32_t samples : {1u, 3u}) {
            WeierSetup setup = odd_sized(rrm(1, 1, 5.0f));
            setup.lights = lights;
            setup.samples_per_pixel = samples;
            WeierFrames frames(device(), cornell(), setup);
            for (const std::uint32_t frame : {0u, 1u, 5u}) {
                frames.run(frame, view());
                EXPECT_EQ(frames.read<std::uint32_t>("colour"), full(setup, frame));
            }
        }
}

TEST(FoveaOverAll, IsMethodFullBitForBit) {
    for (const bool disk : {false, true}) {
        WeierSetup setup = odd_sized(rrm(3, 4, 90.0f));
        setup.rrm.disk = disk;
        setup.lights = frame::LightMode::area;
        WeierFrames frames(device(), cornell(), setup);
        for (const std::uint32_t frame : {0u, 3u}) {
            frames.run(frame, view());
            EXPECT_EQ(frames.read<std::uint32_t>("colour"), full(setup, frame));
        }
    }
}

// With a gaze that wanders, too, and beyond the picture.
TEST(StillScene, IsMethodFullBitForBitAfterACycleInAnyOrder) {
    using stage::RefreshOrder;
    const std::uint32_t reflections = 2;
    for (const auto order : {RefreshOrder::horizontal, RefreshOrder::serpentine,
                             RefreshOrder::scattered, RefreshOrder::blue_noise})
        for (const bool interlaced : {false, true}) {
            WeierSetup setup = odd_sized(rrm(3, 4, 5.0f));
            setup.depth = reflections;
            setup.rrm.order = order;
            setup.rrm.interlaced = interlaced;
            setup.rrm.block_width = interlaced ? 2 : 4;
            setup.rrm.first_frame_full = false;
            WeierFrames frames(device(), cornell(), setup);
            const Words reference = full(setup, 0);
            for (std::uint32_t frame = 0; frame < 12; ++frame) {
                if (frame == 11) {
                    EXPECT_NE(frames.read<std::uint32_t>("colour"), reference);
                }
                frames.run(frame, view(), gaze_through(view(), 13.0f * frame - 40.0f, 30.0f));
            }
            EXPECT_EQ(frames.read<std::uint32_t>("colour"), reference) << stage::name(order);
        }
}

// What every other law follows from, under a moving camera.
TEST(EveryPixel, IsThatOfMethodFullInTheFrameOfItsRefresh) {
    WeierSetup setup = odd_sized(rrm(3, 4, 8.0f));
    setup.lights = frame::LightMode::area;
    setup.rrm.order = stage::RefreshOrder::blue_noise;
    WeierSetup every = setup;
    every.method = "full";
    every.outputs = {};
    WeierFrames frames(device(), cornell(), setup), reference(device(), cornell(), every);
    std::vector<Words> of_frame;
    for (std::uint32_t frame = 0; frame < 30; ++frame) {
        scene::Camera moved = view();
        moved.eye.x += 0.01f * static_cast<float>(frame);
        frames.run(frame, moved, gaze_through(view(), 3.0f * frame, 40.0f));
        reference.run(frame, moved);
        of_frame.push_back(reference.read<std::uint32_t>("colour"));
        const Words colour = frames.read<std::uint32_t>("colour");
        const Words age = frames.read<std::uint32_t>("cache age");
        for (std::size_t i = 0; i < age.size(); ++i) {
            ASSERT_LT(age[i], 12u);
            for (std::size_t k = 4 * i; k < 4 * i + 4; ++k)
                ASSERT_EQ(colour[k], of_frame[frame - age[i]][k]);
        }
    }
}

// Counts the refreshes of each pixel over two cycles, and the rays.
void expect_turns(const WeierSetup& setup, const frame::Gaze& gaze) {
    WeierFrames frames(device(), cornell(), setup);
    const std::uint32_t n = setup.rrm.group_width * setup.rrm.group_height;
    std::vector<std::uint32_t> refreshed(std::size_t{setup.width} * setup.height);
    std::uint64_t rays = 0, expected = 0;
    for (std::uint32_t frame = 0; frame < 2 * n; ++frame) {
        frames.run(frame, view(), gaze);
        const Words age = frames.read<std::uint32_t>("cache age");
        for (std::size_t i = 0; i < age.size(); ++i)
            refreshed[i] += age[i] == 0 ? 1 : 0;
        const auto now = static_cast<std::uint64_t>(std::count(age.begin(), age.end(), 0u));
        EXPECT_EQ(frames.rays(kernel::RayClass::sparse) - rays, now);
        rays += now;
    }
    const stage::PixelRectangle fovea = fovea_of(frames, setup);
    for (std::uint32_t i = 0; i < refreshed.size(); ++i) {
        const bool foveal = holds(fovea, i % setup.width, i / setup.width);
        ASSERT_EQ(refreshed[i], foveal ? 2 * n : 2) << i;
        expected += refreshed[i];
    }
    EXPECT_EQ(rays, expected);
}

TEST(Turns, RefreshThePeripheryOncePerCycleAndTheFoveaInEveryFrame) {
    for (const bool interlaced : {true, false})
        for (const std::uint32_t block : {2u, 4u}) {
            WeierSetup setup = odd_sized(rrm(3, 4, 7.0f));
            setup.rrm.first_frame_full = false;
            setup.rrm.interlaced = interlaced;
            setup.rrm.block_width = block;
            setup.rrm.order = stage::RefreshOrder::blue_noise;
            expect_turns(setup, gaze_through(view(), 41.3f, 22.9f));
        }
    for (const auto& [width, height] : {std::pair{1u, 2u}, {5u, 1u}, {11u, 12u}}) {
        WeierSetup setup = odd_sized(rrm(width, height, 7.0f));
        setup.rrm.first_frame_full = false;
        setup.rrm.order = stage::RefreshOrder::scattered;
        expect_turns(setup, gaze_through(view(), 2.0f, 80.0f));
    }
}

TEST(Turns, GoOnWhereTheGazeLeavesThePicture) {
    WeierSetup setup = odd_sized(rrm(3, 4, 5.0f));
    setup.rrm.first_frame_full = false;
    expect_turns(setup, gaze_through(view(), -300.0f, 40.0f));
    const scene::Camera& c = view();
    expect_turns(setup, {c.eye - c.target, 1.0f}); // backwards
}

TEST(SamplesOfAFrame, AreTheFoveaAndAnNthOfThePeriphery) {
    WeierSetup setup = rrm(3, 4, 0.0f); // 96 x 80: groups of 6 x 8 pixels fit
    setup.rrm.first_frame_full = false;
    // The gaze is a point between four pixels of a block, so that there is no fovea.
    for (const float fovea : {0.0f, 10.0f, 25.0f}) {
        setup.rrm.fovea = fovea;
        WeierFrames frames(device(), cornell(), setup);
        std::uint64_t rays = 0, foveal = 0, all = 0;
        for (std::uint32_t frame = 0; frame < 12; ++frame) {
            frames.run(frame, view(), gaze_through(view(), 48.0f, 40.0f));
            const stage::PixelRectangle r = fovea_of(frames, setup);
            foveal = std::uint64_t{r.x1 - r.x0} * (r.y1 - r.y0);
            const std::uint64_t now = frames.rays(kernel::RayClass::sparse) - all;
            all += now;
            if (fovea == 0.0f) {
                EXPECT_EQ(now, 96 * 80 / 12);
            }
            rays += now;
        }
        EXPECT_EQ(rays, 12 * foveal + (96 * 80 - foveal));
    }
}

TEST(Restart, RepeatsEveryBit) {
    WeierSetup setup = odd_sized(rrm(3, 4, 5.0f));
    setup.lights = frame::LightMode::area;
    setup.rrm.first_frame_full = false;
    setup.rrm.busy.change = 0.01f;
    WeierFrames frames(device(), cornell(), setup);
    std::vector<Words> first;
    for (const bool again : {false, true}) {
        frames.forget();
        for (std::uint32_t frame = 0; frame < 5; ++frame) {
            frames.run(frame, view());
            const Words colour = frames.read<std::uint32_t>("colour");
            if (again)
                EXPECT_EQ(colour, first[frame]);
            else
                first.push_back(colour);
        }
    }
}

TEST(FirstFrame, IsFullOrWhatIsDueOnBlack) {
    for (const bool whole : {true, false}) {
        WeierSetup setup = rrm(3, 4, 5.0f);
        setup.rrm.first_frame_full = whole;
        WeierFrames frames(device(), cornell(), setup);
        frames.run(0, view());
        const Words age = frames.read<std::uint32_t>("cache age");
        const auto colour = frames.read<float>("colour");
        for (std::size_t i = 0; i < age.size(); ++i) {
            EXPECT_TRUE(age[i] == 0 || (!whole && age[i] == kNever));
            EXPECT_TRUE(age[i] == 0 || colour[4 * i + 3] == 0.0f);
        }
    }
}

TEST(Cut, RendersEveryPixelOrLeavesThemStale) {
    for (const bool whole : {true, false}) {
        WeierSetup setup = rrm(3, 4, 5.0f);
        setup.rrm.cut_full = whole;
        WeierFrames frames(device(), cornell(), setup);
        frames.run(0, view());
        scene::Camera turned = view();
        turned.target = turned.eye + glm::vec3(1.0f, 0.0f, 0.0f);
        frames.run(1, turned);
        const Words age = frames.read<std::uint32_t>("cache age");
        EXPECT_EQ(std::count(age.begin(), age.end(), 0u) == 96 * 80, whole);
    }
}

TEST(OptionsOutOfRange, AreErrors) {
    const auto refused = [](auto change) {
        WeierSetup setup = rrm(3, 4, 5.0f);
        change(setup.rrm);
        EXPECT_THROW(WeierFrames(device(), cornell(), setup), std::invalid_argument);
    };
    refused([](auto& o) { o.fovea = -1.0f; });
    refused([](auto& o) { o.fovea = NAN; });
    refused([](auto& o) { o.group_width = 0; });
    refused([](auto& o) { o.group_width = 34; });
    refused([](auto& o) { o.block_width = 3; });
    refused([](auto& o) { o.foveal_samples = 0; });
    refused([](auto& o) { o.rings = {{10.0f, 5}}; });
    refused([](auto& o) { o.rings = {{4.0f, 3}}; });
    refused([](auto& o) { o.busy.change = 2.0f; });
    refused([](auto& o) { o.busy.times = 1; });
    stage::RrmOptions options;
    EXPECT_THROW(stage::set_group(options, 0), std::invalid_argument);
    EXPECT_THROW(stage::set_group(options, 133), std::invalid_argument);
    stage::set_group(options, 132);
    EXPECT_EQ(options.group_width * options.group_height, 132u);
    EXPECT_EQ(options.group_width, 11u);
    EXPECT_THROW(stage::parse_refresh_order("random"), std::invalid_argument);
}

} // namespace
