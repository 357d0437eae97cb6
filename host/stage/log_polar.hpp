// Kernel log-polar foveation (Mrad 2022, sections 2.2.2 and 4.2; after Meng et al. 2018): a buffer
// of samples that lie uniformly in a log-polar space around the gaze, and a disk of pixels there.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "host/stage/kit.hpp"
#include "shared/log_polar.h"

namespace macula::stage {

// How far textures are filtered for the samples of the buffer.
enum class LodRule : std::uint8_t {
    footprint, // for the width of the sample's texel in the image
    thesis,    // for a pixel, and 0.3 + phi levels more (equations 4.2 and 4.3)
};
// "footprint", "thesis".
const char* name(LodRule rule);
// Throws std::invalid_argument that lists the names.
LodRule parse_lod_rule(std::string_view text);

// Defaults are the thesis's (sections 4.2.1 and 4.2.3).
struct LogPolarOptions {
    float alpha = 4.0f; // of the kernel function K(x) = x^alpha, 1..16
    float sigma = 1.8f; // pixels of the picture for a texel of the buffer along each axis, 1..16
    // Radius of the foveal disk: part of half of the image's diagonal, 0..10; the thesis takes the
    // distance to the furthest corner, so that its disk grows when the gaze leaves the centre.
    float disk = 0.15f;
    float disk_degrees = 0.0f; // above 0: the disk's radius as an angle instead, below 80
    float fade = 0.15f;        // part of the radius in which it passes into the buffer, 0..1
    LodRule lod = LodRule::footprint;
    float rect_alpha = 1.0f; // what method logrect has instead of alpha, 1..16
};

// For width x height pixels to be rendered, of which a picture of another size may be made: 0: the
// same. Throws std::invalid_argument that names the option out of range.
shared::LogPolarParams make_params(const LogPolarOptions& options, std::uint32_t width,
                                   std::uint32_t height, std::uint32_t picture_width = 0,
                                   std::uint32_t picture_height = 0);

// Parameters on the device, uploaded when the first stage is prepared.
class LogPolarBuffer {
  public:
    explicit LogPolarBuffer(const shared::LogPolarParams& params) : params_(params) {}
    void prepare(const Kit& kit);

    const shared::LogPolarParams& params() const { return params_; }
    // With the empty texels at the ends of its rows, and two behind the last: four are read
    // at once.
    std::uint64_t texels() const { return std::uint64_t{params_.pitch} * params_.height + 2; }

    compute::Buffer params_buffer;

  private:
    shared::LogPolarParams params_;
};

struct LogPolarKit {
    Kit kit;
    std::shared_ptr<LogPolarBuffer> buffer;
    // The buffer is log-rectilinear (Li et al. 2021): columns and rows are the image's, each warped
    // around the gaze.
    bool rectangular = false;
    // antialias() or upscale() follows, which know what to make of a colour's alpha: see
    // remap_log_polar().
    bool smoothed = false;

    std::uint32_t disk_packets() const; // of 4 x 4 pixels
    std::uint32_t packets() const;      // and of 4 x 4 texels
    // The key of a program that knows both kinds of buffer.
    kernel::VariantKey program(const char* name) const;
};

// "fovea": where the gaze meets the image.
frame::Stage place_fovea(const LogPolarKit& kit);
// "sampling masks", "list offsets" and "list length"; "log-polar colour" is emptied.
frame::Stage choose_samples(const LogPolarKit& kit);
// "primary rays", "pixel of slot" (the pixel's index; beyond the last one's the texel's), "spread
// of slot" (pixels across a sample's footprint) and "ray count".
frame::Stage log_polar_rays(const LogPolarKit& kit);
// "sampled colour" -> "colour". Where frames are smoothed it is sharper, and alpha says how near a
// sample lies to the pixel, 0..1 (1: in its middle).
frame::Stage remap_log_polar(const LogPolarKit& kit);

} // namespace macula::stage
