// Two eyes: each renderer has its own history, on one device in turns, on two devices at once; and
// the gaze that reaches a frame. PoCL makes two devices at its first use, so this is a program of
// its own.
#include <stdlib.h>

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/cl/device.hpp"
#include "host/render/renderer.hpp"
#include "scenes/display.hpp"
#include "scenes/head/pose.hpp"
#include "scenes/load.hpp"

namespace {
using namespace macula;
using scene::Eye;

const int kTwoPocls = setenv("POCL_DEVICES", "pthread basic", 1);

const scene::Scene& cornell() {
    static const scene::Scene loaded = scene::load("cornell");
    return loaded;
}

render::Options options_of(const scene::Display& display, Eye eye) {
    const scene::EyeView& view = display.eye(eye);
    render::Options o;
    o.width = 60;
    o.height = 74;
    o.tangents =
        frame::Tangents{static_cast<float>(view.tan_left), static_cast<float>(view.tan_right),
                        static_cast<float>(view.tan_up), static_cast<float>(view.tan_down)};
    return o;
}

scene::Camera camera_of(const scene::Display& display, Eye eye, std::uint32_t frame) {
    return scene::eye_camera(frame::camera_on_path(cornell(), frame), display.eye(eye),
                             1.0 / cornell().metres_per_unit);
}

// The hashes of both eyes over three frames.
std::vector<std::string> render_both(const compute::Device& left, const compute::Device& right,
                                     bool at_once) {
    const scene::Display display = scene::find_display("pimax_8k_large");
    render::Renderer one(left, cornell(), options_of(display, Eye::left));
    render::Renderer two(right, cornell(), options_of(display, Eye::right));
    std::vector<std::string> hashes;
    for (std::uint32_t frame = 0; frame < 3; ++frame) {
        one.start(frame, camera_of(display, Eye::left, frame));
        if (!at_once) {
            EXPECT_EQ(one.finish().frame, frame);
        }
        two.start(frame, camera_of(display, Eye::right, frame));
        if (at_once) {
            EXPECT_EQ(one.finish().frame, frame);
        }
        const render::FrameReport report = two.finish();
        EXPECT_EQ(report.frame, frame);
        EXPECT_GT(report.total_rays(), 60u * 74u);
        hashes.push_back(one.hash());
        hashes.push_back(two.hash());
    }
    return hashes;
}

TEST(Stereo, TwoDevicesAtOnceGiveTheBitsOfOneInTurns) {
    ASSERT_EQ(kTwoPocls, 0);
    if (compute::enumerate().size() < 2)
        GTEST_SKIP() << "there is only one device: PoCL is not installed";
    const compute::Device first = compute::open("0"), second = compute::open("1");
    const std::vector<std::string> one = render_both(first, first, false);
    EXPECT_EQ(render_both(first, second, true), one);
    EXPECT_NE(one[0], one[1]) << "the eyes see different pictures";
}

// Two renderers of one device scene give the bits of two with a scene each, and the scene lies in
// memory once.
TEST(Stereo, TwoViewsShareTheSceneAndKeepTheirBits) {
    const compute::Device device = compute::open();
    const scene::Display display = scene::find_display("dk2");
    const scene::Scene scene = scene::load("whitted");
    render::Options of_left = options_of(display, Eye::left),
                    of_right = options_of(display, Eye::right);
    of_left.method = of_right.method = "weier";
    const auto rendered = [&](render::Renderer& left, render::Renderer& right) {
        std::vector<std::string> hashes;
        for (std::uint32_t frame = 0; frame < 3; ++frame) {
            for (render::Renderer* view : {&left, &right}) {
                view->render(10 * frame);
                hashes.push_back(view->hash());
            }
        }
        return hashes;
    };
    std::vector<std::string> apart, together;
    std::uint64_t bytes_apart = 0, bytes_together = 0, bytes_of_scene = 0;
    const std::uint64_t before = device.allocated_bytes();
    {
        render::Renderer left(device, scene, of_left);
        left.render(0);
        const std::uint64_t one = device.allocated_bytes() - before;
        left.reset();
        render::Renderer right(device, scene, of_right);
        apart = rendered(left, right);
        bytes_apart = device.allocated_bytes() - before;
        EXPECT_EQ(bytes_apart, 2 * one);
    }
    EXPECT_EQ(device.allocated_bytes(), before);
    {
        auto shared = std::make_shared<render::DeviceScene>(device, scene);
        bytes_of_scene = device.allocated_bytes() - before;
        render::Renderer left(shared, scene, of_left), right(shared, scene, of_right);
        shared.reset(); // the views keep it
        together = rendered(left, right);
        bytes_together = device.allocated_bytes() - before;
    }
    EXPECT_EQ(device.allocated_bytes(), before);
    EXPECT_EQ(together, apart);
    // What traversal lays out at its first ray is shared, too.
    EXPECT_GT(bytes_of_scene, 100000u);
    EXPECT_LE(bytes_together, bytes_apart - bytes_of_scene);
}

// Something that moves has moved once for both eyes, whoever renders first.
TEST(Stereo, TwoViewsOfAMovingSceneSeeTheSameMotion) {
    const compute::Device device = compute::open();
    const scene::Scene& scene = cornell();
    render::Options options;
    options.width = options.height = 48;
    options.images = {"motion"};
    options.geometry.merge_static = false;
    std::vector<scene::Transform> moved;
    for (const scene::Instance& instance : scene.instances) {
        moved.push_back(instance.world_from_object);
        moved.back().row[0].w += 0.05f;
    }
    const auto motion_of = [](const render::Renderer& view) {
        const render::Image image = view.map("motion");
        return std::vector<std::uint32_t>(image.words.begin(), image.words.end());
    };
    render::Renderer alone(device, scene, options);
    const auto shared = std::make_shared<render::DeviceScene>(device, scene, options.geometry);
    render::Renderer left(shared, scene, options), right(shared, scene, options);
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        if (frame == 1) {
            alone.set_transforms(moved);
            right.set_transforms(moved);
        }
        for (render::Renderer* view : {&alone, &left, &right})
            view->render(0);
        EXPECT_EQ(left.hash(), alone.hash()) << frame;
        EXPECT_EQ(right.hash(), alone.hash()) << frame;
        EXPECT_EQ(motion_of(left), motion_of(alone)) << frame;
        EXPECT_EQ(motion_of(right), motion_of(alone)) << frame;
    }
}

TEST(Stereo, AnEyeHasTheHistoryOfItsOwnView) {
    const compute::Device device = compute::open();
    const scene::Display display = scene::find_display("dk2");
    render::Options options = options_of(display, Eye::left);
    options.images = {"motion"};
    render::Renderer left(device, cornell(), options), right(device, cornell(), options);
    // A standing view has no motion, whatever the other eye saw in between.
    for (std::uint32_t frame = 0; frame < 2; ++frame) {
        left.render(frame, camera_of(display, Eye::left, 0));
        right.render(frame, camera_of(display, Eye::right, 0));
    }
    const render::Image motion = left.map("motion");
    for (const float pixels : motion.floats)
        ASSERT_TRUE(std::fabs(pixels) < 1e-3f || pixels >= 1e5f) << pixels;
}

TEST(Gaze, ReachesTheFrameAsAUnitVectorAndDefaultsToTheViewAxis) {
    const scene::Camera view = cornell().cameras.front();
    const shared::Camera camera = frame::make_camera(view, frame::tangents_of(60.0f, 4, 3));
    const frame::FrameSettings settings;
    const shared::FrameParams ahead = frame::make_params(settings, 0, camera, {});
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(ahead.gaze[i], camera.forward[i]);
    EXPECT_EQ(ahead.gaze_widening, 1.0f);
    const shared::FrameParams aside =
        frame::make_params(settings, 0, camera, {}, {glm::vec3(3.0f, 0.0f, -4.0f), 1.5f});
    EXPECT_NEAR(aside.gaze[0], 0.6f, 1e-6f);
    EXPECT_NEAR(aside.gaze[2], -0.8f, 1e-6f);
    EXPECT_EQ(aside.gaze_widening, 1.5f);
}

TEST(Gaze, WithoutDirectionOrWithABadWideningIsAnError) {
    const shared::Camera camera =
        frame::make_camera(cornell().cameras.front(), frame::tangents_of(60.0f, 4, 3));
    const auto params = [&](const frame::Gaze& gaze) {
        return [&camera, gaze] { frame::make_params({}, 0, camera, {}, gaze); };
    };
    using testing::ThrowsMessage, testing::HasSubstr;
    EXPECT_THAT(params({glm::vec3(0.0f), 1.0f}),
                ThrowsMessage<std::invalid_argument>(HasSubstr("gaze")));
    EXPECT_THAT(params({glm::vec3(NAN, 0.0f, 1.0f), 1.0f}),
                ThrowsMessage<std::invalid_argument>(HasSubstr("gaze")));
    EXPECT_THAT(params({{}, 0.5f}), ThrowsMessage<std::invalid_argument>(HasSubstr("widened")));
    EXPECT_THAT(params({{}, NAN}), ThrowsMessage<std::invalid_argument>(HasSubstr("widened")));
}

} // namespace
