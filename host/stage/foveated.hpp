// What the stages of foveated ray tracing share (Weier et al. 2016): parameters and the support
// grid.
#pragma once

#include <cstdint>
#include <memory>

#include "host/stage/instance_motions.hpp"
#include "host/stage/kit.hpp"
#include "shared/weier.h"

namespace macula::stage {

// Defaults are the paper's where it states one; ranges are checked by make_params().
struct WeierOptions {
    // Foveal region configuration (section 4.1): medium. Degrees, 0 <= r0 <= r1; infinity: full.
    float r0 = 10.0f, r1 = 20.0f;
    float p_min = 0.05f; // 0..1
    bool jitter = false; // rays through a hashed point of the pixel (section 5)
    // Support image and support G-buffer, 2..4096 each; 0: as in the paper 256 x 318 for 1182 x
    // 1464, and as many pixels a sample at other sizes.
    std::uint32_t support_width = 0, support_height = 0;
    // Of section 3.3, which states no values. Depth: part of it, above 0. Luminance: 0..1, 1: off.
    // Edge: a cosine, 0..1. Stretch: pixels now for a pixel then, above 1.
    float depth_threshold = 0.1f, luminance_threshold = 0.45f, edge_threshold = 0.05f,
          stretch_threshold = 2.0f;
    bool resample_new = true; // sample what enters the view; false: fill it, as section 3.3 does
    // Without history (the first frame, after a cut) every pixel is sampled; false: as in any other
    // frame, the rest filled from the support image.
    bool first_frame_full = true;
    // Of section 3.4. Depth: part of it, above 0. Weights: 0 < k_min <= k_max <= 1.
    // Frames: 2..2^19.
    float merge_threshold = 0.05f, k_min = 0.1f, k_max = 0.8f;
    std::uint32_t t_max = 40;
    // What a history is worth after it was read between its texels, as part of what it was: 0..1.
    float resampled_worth = 0.5f;
    std::uint32_t filter_samples = 4; // of a footprint (section 3.2), 0..64; 0: bilinear
    bool post = true;                 // section 3.5, for area lights and ambient occlusion
    std::uint32_t filter_window = 16, filter_tries = 8; // pixels 1..64; n 1..64
    // Where the support samples agree that the history lags behind the view, it is corrected.
    bool catch_up = true;
    bool overlay = false; // draw r0, r1 and the sampled pixels over the image
};

// Throws std::invalid_argument that names the option out of range.
shared::WeierParams make_params(const WeierOptions& options, std::uint32_t width,
                                std::uint32_t height);

// Tables of the support grid on the device, made when the first stage is prepared. The samples
// are spread evenly from the first pixel to the last one.
class SupportGrid {
  public:
    explicit SupportGrid(const shared::WeierParams& params) : params_(params) {}
    // Uploads once.
    void prepare(const Kit& kit);

    const shared::WeierParams& params() const { return params_; }
    std::uint32_t samples() const { return params_.support_width * params_.support_height; }

    compute::Buffer params_buffer;
    // From a pixel's column or row to the support sample's, or MACULA_NO_CELL.
    compute::Buffer cell_columns, cell_rows;
    // Places of the samples in pixels; of the mesh the outermost ones lie on the image's edge.
    compute::Buffer columns, rows, mesh_columns, mesh_rows;

  private:
    shared::WeierParams params_;
};

struct FoveatedKit {
    Kit kit;
    std::shared_ptr<SupportGrid> grid;
    std::string image = "colour"; // the resource that is shown and kept as history
    // Null where the scene is one mesh that cannot move.
    std::shared_ptr<InstanceMotions> motions = {};

    bool can_move() const { return motions != nullptr; }
    // Instances that moved since the last frame.
    std::uint32_t moved() const { return motions ? motions->moved() : 0; }

    std::uint32_t packets() const { return kit.slots() / MACULA_RAY_BLOCK; }
    frame::Resource per_support(const std::string& name, std::uint32_t element_bytes) const {
        return {name, element_bytes, grid->samples()};
    }
};

} // namespace macula::stage
