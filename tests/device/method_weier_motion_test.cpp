// Method weier where objects move: histories go with them, and stay behind with nobody.
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "tests/support/moving_scenes.hpp"
#include "tests/support/weier_frames.hpp"

namespace {
using namespace macula;
using namespace macula::test;

struct Float4 {
    float x, y, z, w;
};

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

// Without a foveal region, 160 x 120 pixels; instances can be placed.
WeierSetup peripheral() {
    WeierSetup setup;
    setup.width = 160;
    setup.height = 120;
    setup.weier.r0 = setup.weier.r1 = 0.0f;
    setup.geometry.merge_static = false;
    return setup;
}

template <class T>
void expect_same_bits(const WeierFrames& a, const WeierFrames& b, const char* resource) {
    const auto x = a.read<T>(resource), y = b.read<T>(resource);
    ASSERT_EQ(x.size(), y.size());
    EXPECT_EQ(std::memcmp(x.data(), y.data(), x.size() * sizeof(T)), 0) << resource;
}

// All places are sums of a few powers of two, so that nothing is rounded.
TEST(WeierMotion, MovingEverythingIsMovingTheCamera) {
    const scene::Scene scene = panel_before_a_wall(-6.0f);
    WeierSetup setup = peripheral();
    setup.outputs = {"mesh vertices", "pixel keys", "reprojected colour"};
    WeierFrames walking(device(), scene, setup), pushed(device(), scene, setup);
    const scene::Camera still = scene.cameras.front();
    const glm::vec3 step(0.125f, -0.0625f, 0.25f);
    scene::Camera moved = still;
    moved.eye += step;
    moved.target += step;
    walking.run(0, still);
    pushed.run(0, still);
    walking.run(1, moved);
    pushed.place(std::vector(2, moved_by(-step)));
    pushed.run(1, still);
    expect_same_bits<Float4>(walking, pushed, "mesh vertices");
    expect_same_bits<std::uint32_t>(walking, pushed, "pixel keys");
    expect_same_bits<Float4>(walking, pushed, "reprojected colour");
}

// About the upright axis through the eye; positive turns the view to the left.
scene::Transform turned(float degrees) {
    const float c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
    scene::Transform t;
    t.row[0] = {c, 0, s, 0};
    t.row[2] = {-s, 0, c, 0};
    return t;
}

TEST(WeierMotion, TurningEverythingIsTurningTheCamera) {
    const scene::Scene scene = panel_before_a_wall(-6.0f);
    WeierSetup setup = peripheral();
    setup.outputs = {"mesh vertices"};
    WeierFrames looking(device(), scene, setup), pushed(device(), scene, setup);
    const scene::Camera still = scene.cameras.front();
    scene::Camera aside = still;
    aside.target = aside.eye + turned(3.0f).apply({0, 0, -1});
    looking.run(0, still);
    pushed.run(0, still);
    looking.run(1, aside);
    pushed.place(std::vector(2, turned(-3.0f)));
    pushed.run(1, still);
    const auto a = looking.read<Float4>("mesh vertices"), b = pushed.read<Float4>("mesh vertices");
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_NEAR(a[i].x, b[i].x, 1e-3f) << i;
        ASSERT_NEAR(a[i].y, b[i].y, 1e-3f) << i;
        ASSERT_NEAR(a[i].z, b[i].z, 1e-5f * a[i].z) << i;
    }
}

bool is_red(const Float4& colour) {
    return colour.x > colour.y;
}

// The panel goes to the right by so many pixels a frame, for twelve frames.
class PanelOnItsWay {
  public:
    PanelOnItsWay(const WeierSetup& setup, scene::Scene of, float pixels_a_frame)
        : scene(std::move(of)), foveated(device(), scene, setup),
          full(device(), scene, of_full(setup)) {
        const float depth = -scene.meshes[1].positions[0].z;
        const float pixel = 2.0f * depth * std::tan(glm::radians(30.0f)) / float(setup.height);
        step_ = pixels_a_frame * pixel;
    }

    // `walking`: the eye goes to the left instead, and the panel stands still.
    void run(std::uint32_t frame, bool walking = false) {
        const float x = step_ * (float(frame) - 6.0f);
        const std::vector<scene::Transform> places = {{}, moved_by({walking ? 0 : x, 0, 0})};
        scene::Camera view = scene.cameras.front();
        view.eye.x -= walking ? x : 0;
        view.target.x -= walking ? x : 0;
        for (WeierFrames* frames : {&foveated, &full}) {
            if (frame == 0)
                frames->place(places); // nothing moved before the first frame
            frames->place(places);
            frames->run(frame, view);
        }
        shown = foveated.read<Float4>("colour");
        truth = full.read<Float4>("colour");
    }

    scene::Scene scene;
    WeierFrames foveated, full;
    std::vector<Float4> shown, truth;

  private:
    static WeierSetup of_full(WeierSetup setup) {
        setup.method = "full";
        setup.outputs = {};
        return setup;
    }
    float step_ = 0.0f;
};

class EachSpeed : public testing::TestWithParam<float> {};

TEST_P(EachSpeed, TheObjectKeepsItsColour) {
    WeierSetup setup = peripheral();
    setup.weier.p_min = 0.0f;
    setup.outputs = {"reprojected colour"};
    PanelOnItsWay way(setup, panel_before_a_wall(-6.0f), GetParam());
    for (std::uint32_t frame = 0; frame < 12; ++frame) {
        way.run(frame);
        const auto reprojected = way.foveated.read<Float4>("reprojected colour");
        std::size_t kept = 0, all = 0;
        double error = 0.0;
        for (std::size_t i = 0; i < way.truth.size(); ++i) {
            all += is_red(way.truth[i]);
            if (!is_red(way.truth[i]) || reprojected[i].w == 0.0f)
                continue;
            ++kept;
            error += std::abs(reprojected[i].y - way.truth[i].y);
            EXPECT_TRUE(is_red(reprojected[i])) << "pixel " << i << " of frame " << frame;
        }
        EXPECT_TRUE(frame == 0 || kept > all / 3) << frame;
        EXPECT_LT(error, 0.008 * double(kept) + 1e-9) << frame; // stripes have 0.02 and 0.06
    }
}

TEST_P(EachSpeed, NoHistoryStaysBehindTheObject) {
    PanelOnItsWay way(peripheral(), panel_before_a_wall(-6.0f), GetParam());
    for (std::uint32_t frame = 0; frame < 12; ++frame) {
        way.run(frame);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < way.truth.size(); ++i)
            wrong += is_red(way.shown[i]) != is_red(way.truth[i]);
        EXPECT_EQ(wrong, 0u) << "frame " << frame;
    }
}

double mean_error(const std::vector<Float4>& a, const std::vector<Float4>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::abs(a[i].x - b[i].x) + std::abs(a[i].y - b[i].y) + std::abs(a[i].z - b[i].z);
    return sum / (3.0 * double(a.size()));
}

TEST_P(EachSpeed, AMovingObjectCostsNoMoreThanAMovingEye) {
    double errors[2] = {0.0, 0.0};
    for (const bool walking : {false, true}) {
        PanelOnItsWay way(peripheral(), panel_before_a_wall(-6.0f), GetParam());
        for (std::uint32_t frame = 0; frame < 12; ++frame) {
            way.run(frame, walking);
            errors[walking ? 1 : 0] += mean_error(way.shown, way.truth);
        }
    }
    EXPECT_GT(errors[1], 0.0);
    EXPECT_LT(errors[0], errors[1]);
}

INSTANTIATE_TEST_SUITE_P(PixelsAFrame, EachSpeed, testing::Values(0.25f, 1.5f, 4.0f, 9.0f));

// In the frame in which it enters the last frame knows nothing of it: only its outline, as wide as
// half a cell of the mesh, may then show what was there before.
TEST(WeierMotion, WhatLeapsIntoTheViewCoversWhatWasThere) {
    PanelOnItsWay way(peripheral(), panel_before_a_wall(-6.0f), 40.0f);
    for (std::uint32_t frame = 0; frame < 12; ++frame) {
        way.run(frame);
        std::size_t wrong = 0, entered = 0;
        for (std::size_t i = 0; i < way.truth.size(); ++i) {
            wrong += is_red(way.shown[i]) != is_red(way.truth[i]);
            entered += is_red(way.truth[i]);
        }
        EXPECT_LE(wrong, frame == 4 || frame == 5 ? entered / 3 : 0) << "frame " << frame;
    }
}

// The shadow of the panel on the wall: a light to the left of the eye casts it beside the panel.
TEST(WeierMotion, AShadowHasATrailOfACellAndNoMore) {
    scene::Scene scene = panel_before_a_wall(-6.0f);
    scene.lights.emplace_back();
    scene.lights[0].position = {-4, 0, 0};
    scene.lights[0].colour = glm::vec3(15.0f); // too faint for --eps-lum
    const WeierSetup setup = peripheral();
    PanelOnItsWay way(setup, scene, 2.0f);
    std::vector<int> since(std::size_t{setup.width} * setup.height, 100); // it changed in `full`
    std::vector<Float4> before;
    int oldest = 0;
    std::size_t trail = 0, changed = 0;
    for (std::uint32_t frame = 0; frame < 12; ++frame) {
        way.run(frame);
        for (std::size_t i = 0; frame > 0 && i < since.size(); ++i) {
            const auto differ = [&](const Float4& a, const Float4& b) {
                return std::abs(a.y - b.y) > 0.25f * std::max(a.y, b.y);
            };
            const bool now = differ(way.truth[i], before[i]);
            since[i] = now ? 0 : since[i] + 1;
            changed += now;
            if (differ(way.shown[i], way.truth[i])) {
                ++trail;
                oldest = std::max(oldest, since[i]);
            }
        }
        before = way.truth;
    }
    EXPECT_LE(oldest, 4) << "frames for which a pixel is wrong after it changed";
    EXPECT_LT(trail, changed / 4) << "wrong pixels, of so many that changed";
}

} // namespace
