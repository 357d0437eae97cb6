// Last frame's support G-buffer as a mesh in this frame's view (Weier et al. 2016, sections 3.2 and
// 3.3).
#pragma once

#include "host/stage/foveated.hpp"

namespace macula::stage {

// Last frame's "support geometry" -> "mesh vertices" (kernels/lib/reprojection.h), moved with their
// objects; "support motion" (uint a support sample: the motion's number,
// kernels/reproject/motion.h) where something can move.
frame::Stage project_mesh(const FoveatedKit& kit);

// Marks the mesh cells that need new samples and draws the mesh at full resolution: "resampling
// info" (one word a support sample, MACULA_RESAMPLE_*), "pixel keys" (rows of the parameters'
// pitch).
frame::Stage draw_mesh(const FoveatedKit& kit);

// "history kept": 1, or 0 after a cut: when less than half of the mesh's cells can be seen.
frame::Stage judge_history(const FoveatedKit& kit);

} // namespace macula::stage
