// Every method where an object moves, against `full`: nothing stays behind it beyond what the
// method documents, and what is gathered over frames goes along with it.
#include <algorithm>
#include <cmath>
#include <deque>

#include <gtest/gtest.h>

#include "tests/support/moving_scenes.hpp"

namespace {
using namespace macula;
using namespace macula::test;

constexpr std::uint32_t kWidth = 160, kHeight = 120, kFrames = 30;
constexpr float kPixelsAFrame = 3.0f;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

// The red panel crosses the view, before the green and blue wall.
scene::Scene crossing() {
    scene::Scene scene = panel_before_a_wall(-6.0f);
    const float pixel = 2.0f * 6.0f * std::tan(glm::radians(30.0f)) / float(kHeight);
    const float half = 0.5f * kPixelsAFrame * pixel * float(kFrames);
    scene::MotionNode& node = scene.motion.nodes.emplace_back();
    node.translation.frames = {0.0f, float(kFrames)};
    node.translation.values = {{-half, 0, 0}, {half, 0, 0}};
    scene.motion.instances.push_back({1, 0, glm::mat4(1.0f)});
    place_instances(scene, 0.0f);
    scene.ambient = glm::vec3(1.0f);
    return scene;
}

using Mask = std::vector<bool>;

Mask red_pixels(const render::Image& colour) {
    Mask mask(pixels(colour));
    for (std::uint32_t i = 0; i < mask.size(); ++i)
        mask[i] = at(colour, i).x > at(colour, i).y;
    return mask;
}

// Whether any pixel within `margin` of this one is `wanted`.
bool near(const Mask& mask, std::uint32_t pixel, int margin, bool wanted) {
    const int x = int(pixel % kWidth), y = int(pixel / kWidth);
    for (int v = std::max(y - margin, 0); v <= std::min(y + margin, int(kHeight) - 1); ++v)
        for (int u = std::max(x - margin, 0); u <= std::min(x + margin, int(kWidth) - 1); ++u)
            if (mask[std::size_t(v) * kWidth + std::size_t(u)] == wanted)
                return true;
    return false;
}

struct Allowed {
    int margin = 0;          // pixels from the outline: those of a method's coarsest sample
    std::size_t history = 1; // frames, this one included, in which a pixel may have been refreshed
};

// A history of 1.8 pixels to a sample goes with the nearest of three by three samples: a seam of
// less than four pixels around an object is of both.
constexpr int kSeam = 4;

Allowed allowed(const std::string& method) {
    const int seam = method.find('+') == std::string::npos ? 0 : kSeam;
    if (method == "rrm")
        return {0, 12}; // 3 x 4 blocks in turn
    if (method.starts_with("log"))
        return {6 + seam};
    if (method.starts_with("lowres"))
        return {4};
    return {seam};
}

render::Options options(const std::string& method) {
    render::Options o;
    o.width = kWidth;
    o.height = kHeight;
    o.method = method;
    o.log_polar.alpha = 1.5f;
    return o;
}

class EachMethod : public testing::TestWithParam<std::string> {};

TEST_P(EachMethod, LeavesNoTrailAndLosesNothing) {
    const Allowed limits = allowed(GetParam());
    const scene::Scene scene = crossing();
    render::Renderer full(device(), scene, options("full"));
    render::Renderer tested(device(), scene, options(GetParam()));
    std::deque<Mask> panel; // in the last frames, the newest one first
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
        full.render(frame);
        tested.render(frame);
        panel.push_front(red_pixels(full.map("colour")));
        if (panel.size() > limits.history)
            panel.pop_back();
        ASSERT_GT(std::ranges::count(panel.front(), true), 600) << "frame " << frame;
        const Mask shown = red_pixels(tested.map("colour"));
        std::size_t trail = 0, lost = 0;
        for (std::uint32_t i = 0; i < shown.size(); ++i) {
            const bool known = std::ranges::any_of(
                panel, [&](const Mask& mask) { return near(mask, i, limits.margin, shown[i]); });
            trail += shown[i] && !known;
            lost += !shown[i] && !known;
        }
        EXPECT_EQ(trail, 0u) << "frame " << frame;
        EXPECT_EQ(lost, 0u) << "frame " << frame;
    }
}

// Two stripes of the panel differ in green. What follows the picture instead of the object mixes
// them up after a few frames. (rrm follows nothing: there a pixel is up to twelve frames old.)
TEST_P(EachMethod, FollowsTheObjectsPattern) {
    const std::string method = GetParam();
    const scene::Scene scene = crossing();
    render::Renderer full(device(), scene, options("full"));
    render::Renderer tested(device(), scene, options(method));
    std::size_t right = 0, all = 0;
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
        full.render(frame);
        tested.render(frame);
        if (frame < 12)
            continue;
        const render::Image truth = full.map("colour"), shown = tested.map("colour");
        const Mask panel = red_pixels(truth);
        double lo = 1e9, hi = 0.0;
        for (std::uint32_t i = 0; i < panel.size(); ++i)
            if (panel[i]) {
                lo = std::min(lo, at(truth, i).y);
                hi = std::max(hi, at(truth, i).y);
            }
        const double level = 0.5 * (lo + hi);
        for (std::uint32_t i = 0; i < panel.size(); ++i) {
            if (near(panel, i, 6, false))
                continue;
            ++all;
            right += (at(truth, i).y > level) == (at(shown, i).y > level);
        }
    }
    ASSERT_GT(all, 1000u);
    RecordProperty("right", std::to_string(double(right) / double(all)));
    EXPECT_GT(double(right), (method == "rrm" ? 0.5 : 0.9) * double(all));
}

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const method::Method& method : method::methods())
        all.emplace_back(method.name);
    return all;
}

INSTANTIATE_TEST_SUITE_P(Registry, EachMethod, testing::ValuesIn(names()), [](const auto& tested) {
    std::string name = tested.param;
    std::ranges::replace_if(
        name, [](char c) { return !std::isalnum(c); }, '_');
    return name;
});

} // namespace
