// Which pixels a frame of refresh rate modulation renders: the foveal rectangle on the image, and
// the regions of packets around it.
#include "host/stage/rrm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "lib/acuity.h"
#include "shared/ray.h"

namespace macula::stage {
namespace {

constexpr float kEverywhere = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kMostBlocks = 132;

void check(const RrmOptions& o) {
    const auto require = [](bool holds, const std::string& what) {
        if (!holds)
            throw std::invalid_argument("method rrm: " + what);
    };
    require(o.fovea >= 0.0f, fmt::format("the fovea must be 0 degrees or more, not {}", o.fovea));
    const std::uint64_t blocks = std::uint64_t{o.group_width} * o.group_height;
    require(blocks >= 1 && blocks <= kMostBlocks && o.group_width <= kMostBlocks &&
                o.group_height <= kMostBlocks,
            fmt::format("a refresh group has 1 to {} blocks, not {} x {}", kMostBlocks,
                        o.group_width, o.group_height));
    require(o.block_width == 2 || o.block_width == 4,
            fmt::format("a block is 2 or 4 pixels wide, not {}", o.block_width));
}

struct Interval {
    float low, high;
};

// Tangents, along an axis of the image, between which the cone of a half angle with sine `sine`
// around the gaze lies. `side`, `forward`: the gaze's components along that axis and the view's.
// The planes that touch the cone are asin(sine / length) off its axis, seen along the other axis.
Interval tangents_of_cone(float side, float forward, float sine) {
    using shared::m_divide;
    const float squared = std::fma(side, side, forward * forward);
    const float rest = std::fma(-sine, sine, squared);
    if (rest <= 0.0f)
        return {-kEverywhere, kEverywhere};
    const float cosine = shared::m_sqrt(rest);
    const float low_forward = std::fma(forward, cosine, side * sine);
    const float high_forward = std::fma(forward, cosine, -(side * sine));
    const float beyond = side >= 0.0f ? kEverywhere : -kEverywhere;
    Interval t{beyond, beyond};
    if (low_forward > 0.0f)
        t.low = m_divide(std::fma(side, cosine, -(forward * sine)), low_forward);
    if (high_forward > 0.0f)
        t.high = m_divide(std::fma(side, cosine, forward * sine), high_forward);
    return t;
}

// The pixels with their middles in [low, high] on an axis of `count` pixels, in whole blocks.
std::pair<std::uint32_t, std::uint32_t> pixels_between(float low, float high, std::uint32_t count,
                                                       std::uint32_t block) {
    const auto limit = [&](float x) {
        return static_cast<std::uint32_t>(std::clamp(x, 0.0f, static_cast<float>(count)));
    };
    const std::uint32_t first = limit(std::ceil(low - 0.5f));
    const std::uint32_t end = limit(std::floor(high - 0.5f) + 1.0f);
    if (first >= end)
        return {0, 0};
    return {first / block * block, std::min((end + block - 1) / block * block, count)};
}

std::uint32_t divided_up(std::uint32_t a, std::uint32_t b) {
    return (a + b - 1) / b;
}

} // namespace

PixelRectangle foveal_rectangle(const shared::FrameParams& params, float degrees,
                                std::uint32_t block_width) {
    const shared::Camera& c = params.camera;
    if (degrees >= 90.0f)
        return {0, 0, params.width, params.height};
    const auto along = [&](const float* axis) {
        return shared::dot3(shared::vector_at(params.gaze), shared::vector_at(axis));
    };
    float cosine;
    const float sine = shared::m_sin_cos_pi(degrees * MACULA_HALF_TURN_OF_DEGREE, &cosine);
    const Interval x = tangents_of_cone(along(c.right), along(c.forward), sine);
    const Interval y = tangents_of_cone(along(c.up), along(c.forward), sine);
    const float per_x =
        shared::m_divide(static_cast<float>(params.width), c.tan_left + c.tan_right);
    const float per_y = shared::m_divide(static_cast<float>(params.height), c.tan_up + c.tan_down);
    const auto [x0, x1] = pixels_between((x.low + c.tan_left) * per_x,
                                         (x.high + c.tan_left) * per_x, params.width, block_width);
    const auto [y0, y1] = pixels_between((c.tan_up - y.high) * per_y, (c.tan_up - y.low) * per_y,
                                         params.height, 4 / block_width);
    if (x0 >= x1 || y0 >= y1)
        return {};
    return {x0, y0, x1, y1};
}

RefreshCycle::RefreshCycle(const RrmOptions& options, std::uint32_t width, std::uint32_t height)
    : options_(options), width_(width), height_(height),
      used_slots_(std::make_shared<std::uint32_t>(static_cast<std::uint32_t>(kGroup))) {
    check(options_);
}

void RefreshCycle::add_region(const PixelRectangle& packets, std::uint32_t period) {
    if (packets.empty())
        return;
    const std::uint32_t columns = packets.x1 - packets.x0, rows = packets.y1 - packets.y0;
    plan_.region[plan_.regions++] = {plan_.packets, packets.x0, packets.y0, columns, rows, period};
    plan_.packets += columns * rows * (plan_.group_blocks / period);
}

// `all` without `hole`, in packets.
void RefreshCycle::add_around(const PixelRectangle& hole, const PixelRectangle& all,
                              std::uint32_t period) {
    if (hole.empty()) {
        add_region(all, period);
        return;
    }
    add_region({all.x0, all.y0, all.x1, hole.y0}, period);
    add_region({all.x0, hole.y0, hole.x0, hole.y1}, period);
    add_region({hole.x1, hole.y0, all.x1, hole.y1}, period);
    add_region({all.x0, hole.y1, all.x1, all.y1}, period);
}

const shared::RefreshPlan& RefreshCycle::plan(const shared::FrameParams& params, bool first) {
    const RrmOptions& o = options_;
    if (first)
        frame_ = 0;
    plan_ = {};
    plan_.group_width = o.group_width;
    plan_.group_height = o.group_height;
    plan_.group_blocks = o.group_width * o.group_height;
    plan_.turn = static_cast<std::uint32_t>(frame_ % plan_.group_blocks);
    plan_.frame = static_cast<std::uint32_t>(frame_);
    ++frame_;
    const PixelRectangle fovea =
        first && o.first_frame_full
            ? PixelRectangle{0, 0, width_, height_}
            : foveal_rectangle(params, o.fovea * params.gaze_widening, o.block_width);
    plan_.x0 = fovea.x0;
    plan_.y0 = fovea.y0;
    plan_.x1 = fovea.x1;
    plan_.y1 = fovea.y1;
    if (!fovea.empty()) {
        const std::uint32_t columns = divided_up(fovea.x1 - fovea.x0, 4);
        const std::uint32_t rows = divided_up(fovea.y1 - fovea.y0, 4);
        plan_.region[plan_.regions++] = {0, fovea.x0, fovea.y0, columns, rows, 0};
        plan_.packets = columns * rows;
    }
    // Pixels of the groups of a packet.
    const std::uint32_t wide = 4 * o.group_width, high = 4 * o.group_height;
    const PixelRectangle all{0, 0, divided_up(width_, wide), divided_up(height_, high)};
    // Packets that lie in the fovea with all their groups.
    const PixelRectangle hole{divided_up(fovea.x0, wide), divided_up(fovea.y0, high),
                              fovea.x1 == width_ ? all.x1 : fovea.x1 / wide,
                              fovea.y1 == height_ ? all.y1 : fovea.y1 / high};
    add_around(hole, all, plan_.group_blocks);
    const auto group = static_cast<std::uint32_t>(kGroup);
    *used_slots_ = std::max(divided_up(plan_.packets * MACULA_RAY_BLOCK, group), 1u) * group;
    return plan_;
}

} // namespace macula::stage
