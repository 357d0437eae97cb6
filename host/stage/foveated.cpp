#include "host/stage/foveated.hpp"

#include <bit>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "lib/camera.h"

namespace macula::stage {
namespace {

void require(bool holds, const char* what) {
    if (!holds)
        throw std::invalid_argument(std::string("method weier: ") + what);
}

void check(const WeierOptions& o) {
    require(o.r0 >= 0.0f && o.r1 >= o.r0, "0 <= r0 <= r1 degrees was expected");
    require(o.p_min >= 0.0f && o.p_min <= 1.0f, "p_min must be 0 to 1");
    require(o.depth_threshold > 0.0f, "the depth threshold must be above 0");
    require(o.luminance_threshold >= 0.0f && o.luminance_threshold <= 1.0f,
            "the luminance threshold must be 0 to 1");
    require(o.edge_threshold >= 0.0f && o.edge_threshold <= 1.0f,
            "the edge threshold must be 0 to 1");
    require(o.stretch_threshold > 1.0f, "the stretch threshold must be above 1");
    require(o.merge_threshold > 0.0f, "the merge's depth threshold must be above 0");
    require(o.k_min > 0.0f && o.k_max >= o.k_min && o.k_max <= 1.0f,
            "0 < k_min <= k_max <= 1 was expected");
    require(o.t_max >= 2 && o.t_max <= 1u << 19, "t_max must be 2 to 524288 frames");
    require(o.resampled_worth >= 0.0f && o.resampled_worth <= 1.0f,
            "what a resampled history is worth must be 0 to 1");
    require(o.filter_samples <= 64, "at most 64 footprint samples are possible");
    require(o.filter_window >= 1 && o.filter_window <= 64, "the filter's window is 1 to 64 pixels");
    require(o.filter_tries >= 1 && o.filter_tries <= 64, "the filter's tries are 1 to 64");
}

// The paper's cells have 1182 / 256 by 1464 / 318 pixels.
std::uint32_t support_size(std::uint32_t wanted, std::uint32_t pixels, double cell) {
    if (wanted == 0)
        wanted = static_cast<std::uint32_t>(std::lround(pixels / cell));
    wanted = std::min(std::max(wanted, 2u), std::max(pixels, 2u));
    return wanted;
}

// The pixel of a sample. The outermost samples are the outermost pixels: what lay between them and
// the image's edge would be in no cell of the mesh, and would stay there when it leaves the view.
std::uint32_t pixel_of(std::uint32_t sample, std::uint32_t samples, std::uint32_t pixels) {
    const std::uint64_t steps = samples - 1;
    return static_cast<std::uint32_t>((std::uint64_t{sample} * (pixels - 1) + steps / 2) / steps);
}

struct Axis {
    std::vector<std::uint32_t> cells;
    std::vector<float> places, mesh;
};

Axis make_axis(std::uint32_t samples, std::uint32_t pixels) {
    Axis axis;
    axis.cells.assign(std::size_t{shared::tiles_across(pixels)} * MACULA_TILE, MACULA_NO_CELL);
    for (std::uint32_t i = 0; i < samples; ++i) {
        axis.cells[pixel_of(i, samples, pixels)] = i;
        axis.places.push_back(static_cast<float>(pixel_of(i, samples, pixels)) + 0.5f);
    }
    axis.mesh = axis.places;
    axis.mesh.front() = 0.0f;
    axis.mesh.back() = static_cast<float>(pixels);
    return axis;
}

} // namespace

shared::WeierParams make_params(const WeierOptions& o, std::uint32_t width, std::uint32_t height) {
    check(o);
    shared::WeierParams p{};
    p.r0 = o.r0;
    p.r1 = o.r1;
    p.p_min = o.p_min;
    p.jitter = o.jitter ? 1 : 0;
    require(width >= 2 && height >= 2, "the image needs at least 2 x 2 pixels");
    require(o.support_width <= 4096 && o.support_height <= 4096,
            "the support image has at most 4096 x 4096 samples");
    p.support_width = support_size(o.support_width, width, 1182.0 / 256.0);
    p.support_height = support_size(o.support_height, height, 1464.0 / 318.0);
    p.pitch = shared::tiles_across(width) * MACULA_TILE;
    p.cell_bits_x = static_cast<std::uint32_t>(std::bit_width(p.support_width - 1));
    p.cell_bits_y = static_cast<std::uint32_t>(std::bit_width(p.support_height - 1));
    // 31 - 22 = 9 bits at the least: 32 octaves of depth in steps of a sixteenth of an octave.
    require(p.cell_bits_x + p.cell_bits_y <= 22, "the support image has too many samples");
    p.depth_bits = 31 - p.cell_bits_x - p.cell_bits_y;
    p.depth_threshold = o.depth_threshold;
    p.luminance_threshold = o.luminance_threshold;
    p.edge_threshold = o.edge_threshold;
    p.stretch_threshold = o.stretch_threshold;
    p.resample_new = o.resample_new ? 1 : 0;
    p.first_frame_full = o.first_frame_full ? 1 : 0;
    p.merge_threshold = o.merge_threshold;
    p.filter_samples = o.filter_samples;
    p.log2_k_min = std::log2(o.k_min);
    p.log2_k_slope = (std::log2(o.k_max) - p.log2_k_min) / static_cast<float>(o.t_max - 1);
    p.k_max = o.k_max;
    p.resampled_worth = o.resampled_worth;
    p.filter_window = o.filter_window;
    p.filter_tries = o.filter_tries;
    return p;
}

void SupportGrid::prepare(const Kit& kit) {
    if (params_buffer)
        return;
    const Axis x = make_axis(params_.support_width, kit.width);
    const Axis y = make_axis(params_.support_height, kit.height);
    const auto upload = [&](const auto& values, const char* what) {
        return kit.device.upload(std::span(values), what);
    };
    cell_columns = upload(x.cells, "support column of a pixel column");
    cell_rows = upload(y.cells, "support row of a pixel row");
    columns = upload(x.places, "support columns");
    rows = upload(y.places, "support rows");
    mesh_columns = upload(x.mesh, "mesh columns");
    mesh_rows = upload(y.mesh, "mesh rows");
    params_buffer = kit.device.upload(std::span(&params_, 1), "parameters of the method");
}

} // namespace macula::stage
