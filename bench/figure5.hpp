// `macula bench figure5`: figure 5 of Weier et al. 2016, the speed of the foveal region
// configurations of section 4.2.1. The paper plots its figures and prints none.
#pragma once

#include <string>
#include <vector>

#include "bench/foveation.hpp"

namespace macula::bench {

// small, medium, large, full.
std::vector<Region> figure5_regions();
// sponza_crytek where it is found, else atrium.
std::vector<std::string> figure5_scenes(const std::vector<std::string>& scene_path);

std::string figure5_heading();
std::string figure5_line(const FoveationRow& row);

} // namespace macula::bench
