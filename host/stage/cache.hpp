// The cache of colours and what is known of them (Weier et al. 2016, section 3.4).
#pragma once

#include "host/stage/foveated.hpp"

namespace macula::stage {

// The parts of the list that lie on the support grid -> "support image" (float4: linear RGB
// radiance) and "support geometry" (float4: geometric normal, depth), one entry a support sample.
// Where something can move "support triangle", too (uint: the scene-wide id).
frame::Stage extract_support(const FoveatedKit& kit);

// "history correction": what the support samples agree that the history lags behind.
frame::Stage measure_lag(const FoveatedKit& kit);

// "support change": MACULA_CHANGE_* of the support samples, what they show that their history does
// not although it moved with its object; none where nothing moved. `noise`: of the light,
// MACULA_NOISE of kernels/cache/change.cl.
frame::Stage find_change(const FoveatedKit& kit, std::uint32_t noise);

// The list's samples, last frame's image and the support image -> this frame's image (`kit.image`),
// "cache info" (kernels/lib/cache_info.h) and, with `light_bytes` 4 or 16, the light buffer `light`
// from "sampled light"; below 0 where no sample has been. `catch_up`: histories are corrected by
// "history correction". "reprojected colour", which is not, is for looking at.
frame::Stage merge_cache(const FoveatedKit& kit, bool catch_up, const std::string& light,
                         std::uint32_t light_bytes);

// For what gathers frames: "surface planes" (shared/planes.h), a sample's own or its history's, and
// "fresh pixels" (float a pixel): 1 where it is this frame's sample as it is, else 0.
frame::Stage place_surfaces(const FoveatedKit& kit);

} // namespace macula::stage
