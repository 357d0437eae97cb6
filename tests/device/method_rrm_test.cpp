// Method rrm (Smith et al. 2014): which pixels are refreshed when, and that it is method full.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/load.hpp"
#include "tests/support/small_scenes.hpp"
#include "tests/support/weier_frames.hpp"

namespace {
using namespace macula;
using namespace macula::test;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

const scene::Scene& cornell() {
    static const scene::Scene loaded = scene::load("cornell");
    return loaded;
}

WeierSetup rrm(std::uint32_t group_width, std::uint32_t group_height, float fovea) {
    WeierSetup setup;
    setup.method = "rrm";
    setup.rrm.group_width = group_width;
    setup.rrm.group_height = group_height;
    setup.rrm.fovea = fovea;
    return setup;
}

std::vector<std::uint32_t> full(WeierSetup setup, std::uint32_t frame) {
    setup.method = "full";
    WeierFrames frames(device(), cornell(), setup);
    frames.run(frame, cornell().cameras.front());
    return frames.read<std::uint32_t>("colour");
}

TEST(OneFramePerGroup, IsMethodFullBitForBit) {
    for (const auto lights : {frame::LightMode::area, frame::LightMode::ambient_occlusion})
        for (const std::uint32_t samples : {1u, 3u}) {
            WeierSetup setup = rrm(1, 1, 5.0f);
            setup.width = 97;
            setup.height = 81;
            setup.lights = lights;
            setup.samples_per_pixel = samples;
            WeierFrames frames(device(), cornell(), setup);
            for (const std::uint32_t frame : {0u, 1u, 5u}) {
                frames.run(frame, cornell().cameras.front());
                EXPECT_EQ(frames.read<std::uint32_t>("colour"), full(setup, frame));
            }
        }
}

TEST(StillScene, IsMethodFullBitForBitAfterACycle) {
    for (const auto order : {stage::RefreshOrder::horizontal, stage::RefreshOrder::serpentine,
                             stage::RefreshOrder::scattered, stage::RefreshOrder::blue_noise}) {
        WeierSetup setup = rrm(3, 4, 5.0f);
        setup.rrm.order = order;
        setup.rrm.first_frame_full = false;
        WeierFrames frames(device(), cornell(), setup);
        const auto reference = full(setup, 0);
        for (std::uint32_t frame = 0; frame < 12; ++frame) {
            if (frame == 11) {
                EXPECT_NE(frames.read<std::uint32_t>("colour"), reference);
            }
            frames.run(frame, cornell().cameras.front());
        }
        EXPECT_EQ(frames.read<std::uint32_t>("colour"), reference) << stage::name(order);
    }
}

} // namespace
