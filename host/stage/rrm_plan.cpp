// Which pixels a frame of refresh rate modulation renders: the foveal rectangle on the image, and
// the regions of packets around it.
#include "host/stage/rrm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "lib/acuity.h"
#include "lib/camera.h"
#include "shared/ray.h"

namespace macula::stage {
namespace {

constexpr float kEverywhere = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kMostBlocks = 132;

void require(bool holds, const std::string& what) {
    if (!holds)
        throw std::invalid_argument("method rrm: " + what);
}

void check(const std::vector<RefreshRing>& rings, float fovea, std::uint32_t blocks) {
    require(rings.size() <= 5, fmt::format("there are at most 5 rings, not {}", rings.size()));
    float inside = fovea;
    for (const RefreshRing& ring : rings) {
        require(ring.degrees >= inside,
                fmt::format("a ring's edge at {} degrees lies within what it surrounds ({})",
                            ring.degrees, inside));
        require(ring.period >= 1 && blocks % ring.period == 0,
                fmt::format("a ring's period {} does not divide N = {}", ring.period, blocks));
        inside = ring.degrees;
    }
}

void check(const BusyOptions& o) {
    require(o.change >= 0.0f && o.change <= 1.0f, "the change of a colour is 0 to 1");
    require(o.motion >= 0.0f && o.motion <= 1e6f, "the motion is 0 to 1e6 pixels a frame");
    require(o.times >= 2 && o.times <= kMostBlocks, "busy groups are refreshed 2 to 132 times");
    require(o.frames >= 1 && o.frames <= 65536, "groups stay busy for 1 to 65536 frames");
    require(o.budget >= 0.0f && o.budget <= 1.0f, "the budget is 0 to 1 of the picture");
}

void check(const RrmOptions& o) {
    require(o.fovea >= 0.0f, fmt::format("the fovea must be 0 degrees or more, not {}", o.fovea));
    const std::uint64_t blocks = std::uint64_t{o.group_width} * o.group_height;
    require(blocks >= 1 && blocks <= kMostBlocks && o.group_width <= kMostBlocks &&
                o.group_height <= kMostBlocks,
            fmt::format("a refresh group has 1 to {} blocks, not {} x {}", kMostBlocks,
                        o.group_width, o.group_height));
    require(o.foveal_samples >= 1 && o.foveal_samples <= 65536,
            fmt::format("the fovea has 1 to 65536 samples a pixel, not {}", o.foveal_samples));
    require(o.block_width == 2 || o.block_width == 4,
            fmt::format("a block is 2 or 4 pixels wide, not {}", o.block_width));
    check(o.rings, o.fovea, static_cast<std::uint32_t>(blocks));
    check(o.busy);
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

// The squared cosine of half the angle between directions on either side of an axis.
float half_angle(float tangent_a, float tangent_b) {
    const float cosine = (1.0f - tangent_a * tangent_b) /
                         std::sqrt((1.0f + tangent_a * tangent_a) * (1.0f + tangent_b * tangent_b));
    return 0.5f * (1.0f + cosine);
}

// True where the view has turned by more than the smaller of its half angles of view.
bool is_cut(const shared::FrameParams& params) {
    const shared::Camera& c = params.camera;
    const float smaller =
        std::max(half_angle(c.tan_left, c.tan_right), half_angle(c.tan_up, c.tan_down));
    const float turned = shared::dot3(shared::vector_at(c.forward),
                                      shared::vector_at(params.previous_camera.forward));
    return turned < 0.0f || turned * turned < smaller;
}

RefreshCycle::RefreshCycle(const RrmOptions& options, std::uint32_t width, std::uint32_t height)
    : options_(options), width_(width), height_(height),
      most_packets_(shared::slot_count(width, height) / MACULA_RAY_BLOCK),
      used_slots_(std::make_shared<std::uint32_t>(static_cast<std::uint32_t>(kGroup))) {
    check(options_);
}

std::uint32_t RefreshCycle::quads() const {
    return divided_up(width_, 4 * options_.group_width) *
           divided_up(height_, 4 * options_.group_height);
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

void RefreshCycle::add_fovea(const PixelRectangle& fovea) {
    plan_.x0 = fovea.x0;
    plan_.y0 = fovea.y0;
    plan_.x1 = fovea.x1;
    plan_.y1 = fovea.y1;
    if (fovea.empty())
        return;
    const std::uint32_t columns = divided_up(fovea.x1 - fovea.x0, 4);
    const std::uint32_t rows = divided_up(fovea.y1 - fovea.y0, 4);
    plan_.region[plan_.regions++] = {0, fovea.x0, fovea.y0, columns, rows, 0};
    plan_.packets = plan_.foveal_packets = columns * rows;
}

// Rings around the fovea, and what is around the last one. They end where packets do.
void RefreshCycle::add_periphery(const shared::FrameParams& params) {
    const std::uint32_t wide = 4 * plan_.group_width, high = 4 * plan_.group_height;
    const PixelRectangle all{0, 0, divided_up(width_, wide), divided_up(height_, high)};
    // Packets that lie in the fovea with all their groups.
    PixelRectangle hole{divided_up(plan_.x0, wide), divided_up(plan_.y0, high),
                        plan_.x1 == width_ ? all.x1 : plan_.x1 / wide,
                        plan_.y1 == height_ ? all.y1 : plan_.y1 / high};
    plan_.corner_period = plan_.group_blocks;
    if (!options_.rings.empty())
        plan_.corner_period = options_.rings.front().period;
    for (const RefreshRing& ring : options_.rings) {
        const PixelRectangle r =
            foveal_rectangle(params, ring.degrees * params.gaze_widening, options_.block_width);
        const PixelRectangle packets{r.x0 / wide, r.y0 / high, divided_up(r.x1, wide),
                                     divided_up(r.y1, high)};
        if (packets.empty())
            continue;
        add_around(hole, packets, ring.period);
        hole = packets;
    }
    add_around(hole, all, plan_.group_blocks);
}

// Packets that the fovea's edge cuts are listed on both sides of it: where the fovea leaves next to
// nothing, the list would be longer than the picture.
void RefreshCycle::make_full() {
    plan_.regions = plan_.packets = plan_.disk = 0;
    add_fovea({0, 0, width_, height_});
}

void RefreshCycle::plan_busy() {
    const BusyOptions& busy = options_.busy;
    const std::uint32_t further = std::min(busy.times, plan_.group_blocks) - 1;
    plan_.quads = quads();
    plan_.quads_across = divided_up(width_, 4 * plan_.group_width);
    if (!busy.wanted() || further == 0)
        return;
    const double share = double{busy.budget} * width_ * height_ / MACULA_RAY_BLOCK / further;
    const std::uint32_t room = (most_packets_ - std::min(plan_.packets, most_packets_)) / further;
    plan_.busy_quads = std::min({static_cast<std::uint32_t>(share), room, plan_.quads});
    plan_.busy_packets = plan_.busy_quads > 0 ? further : 0;
    plan_.first_quad = shared::random_bits(0, plan_.frame, 1) % plan_.quads;
    plan_.hold = busy.frames;
    plan_.change = busy.change;
    plan_.motion_squared = busy.motion * busy.motion;
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
    plan_.samples = params.samples_per_pixel;
    plan_.foveal_samples = std::max(plan_.samples, o.foveal_samples);
    const auto root = static_cast<std::uint32_t>(std::lround(std::sqrt(plan_.foveal_samples)));
    plan_.foveal_grid = root * root == plan_.foveal_samples ? root : 0;
    const float degrees = o.fovea * params.gaze_widening;
    const bool full = first ? o.first_frame_full : o.cut_full && is_cut(params);
    add_fovea(full ? PixelRectangle{0, 0, width_, height_}
                   : foveal_rectangle(params, degrees, o.block_width));
    plan_.disk = o.disk && !full ? 1 : 0;
    plan_.cosine = shared::cosine_of_eccentricity(degrees);
    add_periphery(params);
    if (plan_.packets > most_packets_)
        make_full();
    plan_busy();
    return plan_;
}

void RefreshCycle::begin_sample(std::uint32_t sample) {
    const auto group = static_cast<std::uint32_t>(kGroup);
    const std::uint32_t packets = sample < plan_.samples
                                      ? plan_.packets + plan_.busy_quads * plan_.busy_packets
                                      : plan_.foveal_packets;
    *used_slots_ = std::max(divided_up(packets * MACULA_RAY_BLOCK, group), 1u) * group;
}

} // namespace macula::stage
