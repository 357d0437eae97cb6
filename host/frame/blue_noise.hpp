// A mask of spatio-temporal blue noise, made here by the void-and-cluster method (Ulichney 1993)
// with the energy of Wolfe et al. 2022, "Spatiotemporal Blue Noise Masks": texels repel one another
// within their slice by a Gaussian of their distance in the image, and texels at the same place of
// different slices by a Gaussian of their distance in time; nothing else. docs/soft-shadows.md
// shows what comes out.
#pragma once

#include <cstdint>
#include <vector>

namespace macula::frame {

// MACULA_NOISE_SLICES slices of MACULA_NOISE_SIDE^2 ranks, row by row: each slice is a permutation
// of 0 .. MACULA_NOISE_SIDE^2 - 1. Integers decide everything but the Gaussians' values, which are
// the engine's own portable arithmetic: the same ranks on every machine.
std::vector<std::uint16_t> make_blue_noise(std::uint32_t seed);

// Two masks packed as the kernels read them (shared/blue_noise.h). Made when it is first asked for,
// in a fraction of a second, and kept while the process lives.
const std::vector<std::uint32_t>& blue_noise();

} // namespace macula::frame
