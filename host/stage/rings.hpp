// Rectangular rings of pixel blocks around the gaze, each with one sample, and the blur over them:
// the multi-resolution renderer that refresh rate modulation replaced (Smith et al. 2014, section
// 3.2.1, figure 8).
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "host/stage/kit.hpp"
#include "shared/rings.h"

namespace macula::stage {

// The paper states neither edges nor the number of levels.
struct RingOptions {
    // Degrees from the gaze to the edges of the foveal rectangle and of the rings of blocks of 2
    // and 4 pixels along each axis, ascending from 0 on; beyond the last one blocks are 8 pixels
    // wide. From 90 on: everything.
    std::array<float, MACULA_RING_EDGES> edges = {5.0f, 10.0f, 20.0f};
    bool blur = true;  // false: blocks as they are
    bool grid = false; // draw the blocks' outlines (figure 8a)
};

// Throws std::invalid_argument that names the option out of range.
shared::RingParams make_params(const RingOptions& options);

// Samples of a frame with these parameters: blocks that lie at least partly in the picture.
std::uint64_t count_blocks(const shared::FrameParams& frame, const shared::RingParams& params);

struct RingKit {
    // `all`: without used_slots, which place_rings() sets for each frame.
    RingKit(const Kit& all, const RingOptions& options);

    Kit kit;
    shared::RingParams params;
    std::shared_ptr<std::uint32_t> used_slots; // the kit's

    std::uint32_t packets() const; // of 4 x 4 pixels
};

// "rings": where the edges lie in the image.
frame::Stage place_rings(const RingKit& kit);
// "sampling masks", "list offsets" and "list length".
frame::Stage choose_blocks(const RingKit& kit);
// "primary rays", "pixel of slot" (the first one of a slot's block), "spread of slot" (its width)
// and "ray count".
frame::Stage block_rays(const RingKit& kit);
// "block colour" -> "colour".
frame::Stage show_rings(const RingKit& kit);

} // namespace macula::stage
