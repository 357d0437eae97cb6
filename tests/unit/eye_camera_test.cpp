// The way from display, head and gaze to what kernels compute from FrameParams, against the true
// angles in head space.
#include <cmath>

#include <gtest/gtest.h>

#include "host/frame/frame_params.hpp"
#include "lib/acuity.h"
#include "lib/camera.h"
#include "scenes/head/pose.hpp"

namespace {

using namespace macula;
using scene::Eye;

scene::Camera tilted_head() {
    scene::Camera head;
    head.eye = {3.0f, -2.0f, 7.0f};
    head.target = {-1.0f, 0.5f, 2.0f};
    head.up = {0.2f, 1.0f, 0.1f};
    return head;
}

shared::FrameParams params_of(const scene::Display& display, Eye eye, const glm::dvec3& gaze) {
    const scene::EyeView& view = display.eye(eye);
    const scene::Camera head = tilted_head();
    const scene::Camera camera = scene::eye_camera(head, view, 1.0);
    const frame::Tangents tangents{
        static_cast<float>(view.tan_left), static_cast<float>(view.tan_right),
        static_cast<float>(view.tan_up), static_cast<float>(view.tan_down)};
    frame::FrameSettings settings;
    settings.width = display.width;
    settings.height = display.height;
    return frame::make_params(settings, 0, frame::make_camera(camera, tangents), {},
                              {glm::vec3(scene::world_from_head(head) * gaze), 1.0f});
}

class EveryDisplay : public testing::TestWithParam<std::string> {};

TEST_P(EveryDisplay, KernelsSeeTheTrueEccentricity) {
    const scene::Display display = scene::find_display(GetParam());
    const glm::dvec3 gaze = scene::direction_of_angles(17.0, -9.0);
    for (const Eye eye : {Eye::mono, Eye::left, Eye::right}) {
        const shared::FrameParams frame = params_of(display, eye, gaze);
        for (int i = 0; i <= 8; ++i)
            for (int j = 0; j <= 8; ++j) {
                const double x = display.width * (i / 8.0), y = display.height * (j / 8.0);
                const shared::float3 d =
                    shared::camera_direction(&frame.camera, frame.width, frame.height,
                                             static_cast<float>(x), static_cast<float>(y));
                const float cosine = shared::dot3(shared::unit3(d, {0.0f, 0.0f, 1.0f}),
                                                  shared::vector_at(frame.gaze));
                const double angle = shared::eccentricity_of_cosine(cosine);
                // A cosine in single precision knows angles near 0 to some hundredths of a degree.
                EXPECT_NEAR(angle, scene::eccentricity(display, eye, x, y, gaze), 0.05)
                    << scene::name(eye) << " at " << x << ", " << y;
            }
    }
}

TEST_P(EveryDisplay, BothEyesPutAFarPointWhereTheDisplayDoes) {
    const scene::Display display = scene::find_display(GetParam());
    const glm::dvec3 far = scene::direction_of_angles(12.0, 7.0);
    for (const Eye eye : {Eye::left, Eye::right}) {
        const shared::FrameParams frame = params_of(display, eye, far);
        double x = 0.0, y = 0.0;
        ASSERT_TRUE(scene::project(display, eye, far, x, y));
        float kernel_x = 0.0f, kernel_y = 0.0f;
        ASSERT_TRUE(shared::camera_project(&frame.camera, frame.width, frame.height,
                                           shared::vector_at(frame.gaze), &kernel_x, &kernel_y));
        EXPECT_NEAR(kernel_x, x, 0.01);
        EXPECT_NEAR(kernel_y, y, 0.01);
    }
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, EveryDisplay, testing::ValuesIn([] {
                             std::vector<std::string> names;
                             for (const scene::Display& display : scene::builtin_displays())
                                 names.push_back(display.name);
                             return names;
                         }()),
                         [](const auto& tested) { return tested.param; });

} // namespace
