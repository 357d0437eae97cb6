// The build over any set of boxes: triangles, or instances for the upper level.
#pragma once

#include "bvh/bvh.hpp"
#include "bvh/geometry.hpp"

namespace macula::bvh {

Tree build_tree(ReferenceSet references, const BuildOptions& options);

} // namespace macula::bvh
