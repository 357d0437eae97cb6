#include "host/stage/lens.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "lib/camera.h"

namespace macula::stage {
namespace {

constexpr const char* kColours[] = {"red", "green", "blue"};

// d/dr of r (1 + k[0] r^2 + ...).
double slope(const scene::Distortion& k, double r) {
    double sum = 1.0, power = 1.0;
    for (std::size_t i = 0; i < k.size(); ++i) {
        power *= r * r;
        sum += k[i] * power * static_cast<double>(2 * i + 3);
    }
    return sum;
}

// The least r up to `end` from which on the polynomial no longer grows; infinity: none.
double turning_point(const scene::Distortion& k, double end) {
    constexpr int kSteps = 4096;
    for (int step = 1; step <= kSteps; ++step)
        if (const double r = end * step / kSteps; !(slope(k, r) > 0.0))
            return r;
    return std::numeric_limits<double>::infinity();
}

// Where on the panel the edge of the view lies, by the green polynomial.
double panel_edge(const scene::Distortion& k, double tangent) {
    const double r = scene::undistort(k, tangent);
    const bool reached = std::fabs(scene::distort(k, r) - tangent) < 1e-9 * tangent;
    if (!reached || turning_point(k, r) <= r)
        throw std::invalid_argument(fmt::format(
            "the lens cannot show the view's edge at the tangent {:g}: its {} polynomial turns "
            "back before",
            tangent, kColours[1]));
    return r;
}

} // namespace

shared::LensParams make_lens(const LensDistortion& distortion, const frame::Tangents& view,
                             std::uint32_t width, std::uint32_t height) {
    shared::LensParams lens{};
    for (std::size_t colour = 0; colour < 3; ++colour) {
        if (distortion[colour].size() > MACULA_LENS_TERMS)
            throw std::invalid_argument(fmt::format("the lens has more than {} coefficients of {}",
                                                    MACULA_LENS_TERMS, kColours[colour]));
        std::transform(distortion[colour].begin(), distortion[colour].end(),
                       lens.k + colour * MACULA_LENS_TERMS,
                       [](double k) { return static_cast<float>(k); });
    }
    const scene::Distortion& green = distortion[1];
    const double left = panel_edge(green, view.left), right = panel_edge(green, view.right);
    const double up = panel_edge(green, view.up), down = panel_edge(green, view.down);
    const double step_x = (left + right) / width, step_y = (up + down) / height;
    const double per_x = width / (double{view.left} + view.right);
    const double per_y = height / (double{view.up} + view.down);
    lens.left = static_cast<float>(left);
    lens.up = static_cast<float>(up);
    lens.step_x = static_cast<float>(step_x);
    lens.step_y = static_cast<float>(step_y);
    lens.scale_x = static_cast<float>(step_x * per_x);
    lens.shift_x = static_cast<float>((view.left - left) * per_x);
    lens.scale_y = static_cast<float>(step_y * per_y);
    lens.shift_y = static_cast<float>((view.up - up) * per_y);
    lens.per_x = static_cast<float>(per_x);
    lens.per_y = static_cast<float>(per_y);
    const double corner = std::hypot(std::max(left, right), std::max(up, down));
    for (std::size_t colour = 0; colour < 3; ++colour) {
        const double turn = turning_point(distortion[colour], corner);
        lens.most[colour] = static_cast<float>(std::min(turn * turn, 1e30));
    }
    return lens;
}

frame::Stage prewarp(const Kit& kit, const shared::LensParams& lens, const std::string& picture) {
    frame::Stage stage;
    stage.name = "warp for the lens";
    stage.reads = {picture};
    const std::uint32_t width = kit.picture_width(), height = kit.picture_height();
    stage.writes = {{"lens image", 16, std::uint64_t{width} * height}};
    stage.prepare = [=, name = stage.name] {
        const compute::Buffer params = kit.device.upload(std::span(&lens, 1), "lens");
        auto kernel = kit.library.kernel(kernel::VariantKey("remap/lens"), "prewarp", kit.device);
        return [=](frame::Run& run) mutable {
            kernel.set(width, height, params, run[picture], run["lens image"])
                .launch(name, {shared::slot_count(width, height)}, {kGroup});
        };
    };
    return stage;
}

} // namespace macula::stage
